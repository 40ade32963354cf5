// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>

#include <string>

namespace meam
{
/// Reads T_robot_camera (mm), which takes points of the scan's frame to the robot's, in any of these forms:
/// - `T_robot_camera`, 4x4, row by row, in OpenCV's YAML, XML or JSON, or in plain JSON; mm, or metres in JSON whose
///   `units` are "m";
/// - a transform of ROS, in YAML or JSON: `translation` x y z and `rotation` x y z w, or, as easy_handeye writes
///   it, x y z qx qy qz qw in one list of entries; METRES. The parent frame is the robot's, the child frame the scan's;
/// - 16 numbers alone, row by row; mm.
/// Throws Error, naming the file, for none, several, and what is not a rotation and a translation.
Eigen::Isometry3d readRobotFrame(const std::string& path);

/// Writes JSON with `format` "meam-robot-frame", `version` 1, `units` "mm" and `T_robot_camera`; or, when the name ends
/// in .yaml or .yml, a `TransformStamped` of ROS with `translation` and `rotation` in metres from `robotFrame` to
/// `cameraFrame`. Throws Error for a transform that is not finite and a file that cannot be written.
void writeRobotFrame(const std::string& path, const Eigen::Isometry3d& T_robot_camera,
  const std::string& robotFrame = "base", const std::string& cameraFrame = "camera");
}
