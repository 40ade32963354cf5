// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "pose/Pose.h"
#include "pose/refinement/PoseFitter.h"

#include <string>

namespace meam
{
/// Of the diameter: what a part that is thinner along an axis shows of that is too narrow to be measured.
inline constexpr double LeastLength = 0.25;

/// How long the parts of a scan are along the axes of the CAD file, by what its lengths there are.
struct PartSize
{
  Eigen::Vector3d factors = Eigen::Vector3d::Ones(); ///< NaN along an axis that the part is too thin for
  Eigen::Vector3d deviations; ///< standard deviations, by what the poses differ in and a pixel of the scan
};

/// Least squares over all poses together, of what their edges and surface are off: the motion of each, and the three
/// lengths. `poses`: two at least, aligned, in the local frame.
PartSize measurePartSize(const Poses& poses, const Scene& scene, const TrainedModel& model, int threads);

/// The length that is off the most, for users: "0.89 times as long along z as in the CAD file".
std::string sizeWords(const Eigen::Vector3d& factors);
/// All of them, "0.89 along x, 1.00 along y, not told along z"; empty when none is known.
std::string sizesWords(const Eigen::Vector3d& factors);
/// What such lengths leave open: "How long the parts are along z cannot be checked ..."; empty where all are
/// known, or none is. `parts`: "the parts", or those of one type.
std::string untoldWords(const Eigen::Vector3d& factors, const std::string& parts = "the parts");
}
