// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "io/PoseFile.h"

#include <Eigen/Geometry>

#include <optional>
#include <string>

namespace meam
{
/// How large the part is, in the model's frame, mm.
struct PartExtent
{
  Eigen::AlignedBox3d box;                          ///< around it, along the model's axes
  Eigen::Vector3d middle = Eigen::Vector3d::Zero(); ///< of its surface, which covariances are about
};

/// What the header of such an array says.
struct DetectionArrayHeader
{
  std::string frame = "camera"; ///< the scan's frame, by its name in the robot's software
  double stamp = 0.0;           ///< seconds since 1970 at which the scan was taken; 0: not known
};

/// Writes JSON in the shape of ROS 2's vision_msgs/Detection3DArray: `header` (`stamp`, `frame_id`) and `detections`,
/// each with `results` (one, with `hypothesis.class_id`, the number of the part, `hypothesis.score`, and `pose`),
/// `bbox` and `id` (the rank). Lengths are METRES there, quaternions x y z w; `pose.covariance` is of x, y, z (m) and
/// turns about x, y and z (radians), row by row, about the part's origin, and 0 where it is not known; `bbox.size` is 0
/// where the extent is not known. Throws Error for a pose that is not finite, a stamp that is no time, or a file that
/// cannot be written, and leaves no partial file.
void writeDetections(const std::string& path, const std::vector<PoseRow>& poses,
  const std::optional<PartExtent>& part = {}, const DetectionArrayHeader& header = {});
}
