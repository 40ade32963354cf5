// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/Error.h"
#include "base/PointCloud.h"

#include <limits>
#include <optional>

namespace meam
{
/// One pose as the files know it; what is not known keeps its default and is left out of the JSON.
struct PoseRow
{
  int sceneId = 0;
  int imageId = 0;
  int objectId = 1;
  Eigen::Isometry3d T_scene_model = Eigen::Isometry3d::Identity(); ///< mm
  double score = 0.0;
  double time = -1.0; ///< seconds for the whole image; -1: not known
  int rank = 0;       ///< from 1; 0: the place in the list
  int votes = -1;
  int viewId = -1;
  double visibleFraction = std::numeric_limits<double>::quiet_NaN();
  double placeProbability = std::numeric_limits<double>::quiet_NaN(); ///< that a copy is there
  double probability = std::numeric_limits<double>::quiet_NaN();      ///< that the pose is right
  double certainty = std::numeric_limits<double>::quiet_NaN();        ///< that no near-symmetry turns it
  std::optional<Eigen::Matrix<double, 6, 6>> covariance;              ///< as PoseFit has it; only detections hold it
};

/// Reads poses in any of the forms below, whatever the file's name is. Throws Error, naming the file and what is wrong.
std::vector<PoseRow> readPoses(const std::string& path);

/// Reads blocks of row-major 4x4 matrices T_scene_model; '#' starts a comment, line breaks do not
/// matter. A file without numbers gives no poses. Throws Error, naming the file, for a wrong count,
/// a value that is not a number, or a block that is not a rotation and a translation.
std::vector<Eigen::Isometry3d> readMatrices(const std::string& path);

// The writers print enough digits to read the same numbers back. They throw Error for a pose that
// is not finite or a file that cannot be written, and leave no partial file.

/// Writes blocks of row-major 4x4 matrices.
void writeMatrices(const std::string& path, const std::vector<PoseRow>& poses);

/// Writes the results CSV of the BOP benchmark: scene_id,im_id,obj_id,score,R,t,time.
void writeBOP(const std::string& path, const std::vector<PoseRow>& poses);

/// Writes JSON with `format` "meam-poses" and `version` 1, one pose on a line, with rank, score, translation,
/// quaternion (x y z w) and matrix. Files without these two are read as well, those of a later version are not.
void writeJSON(const std::string& path, const std::vector<PoseRow>& poses);
}
