// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>

#include <limits>
#include <string>
#include <vector>

namespace meam
{
/// What the robot held, or looked at, at one place.
struct HandEyePair
{
  Eigen::Isometry3d T_base_gripper = Eigen::Isometry3d::Identity(); ///< mm, as the robot tells it
  Eigen::Isometry3d T_camera_target =
    Eigen::Isometry3d::Identity(); ///< mm, of a calibration target, or of a part found
};

enum class CameraMount
{
  Beside, ///< the camera stands beside the robot, the target is in the gripper (eye-to-hand)
  Hand    ///< the camera is on the gripper, the target stands still (eye-in-hand)
};

struct HandEyeCalibration
{
  /// Takes the camera's points to the robot's: to its base of a camera beside it, to its gripper of one on it; mm.
  Eigen::Isometry3d T_robot_camera = Eigen::Isometry3d::Identity();
  /// Where the target is by the mean of all pairs: in the gripper, or in the base of a camera on the gripper; mm.
  Eigen::Isometry3d T_holder_target = Eigen::Isometry3d::Identity();
  std::vector<double> shifts; ///< mm, of the target at each pair from that mean
  std::vector<double> turns;  ///< degrees, the same of its orientation
  double shift = 0.0;         ///< mm, root mean square of these: the residual, which few pairs make too small
  double turn = 0.0;          ///< degrees
  std::string method;         ///< whose it is: the one with the smallest residual
  CameraMount mount = CameraMount::Beside;
  /// The target's size over what its poses say, where the pairs fit much better for it; else 1.
  double targetScale = 1.0;
  /// mm, of a point where the targets were seen, by what changes when some pairs are left out (the jackknife); NaN of
  /// fewer than five places of the gripper, which do not tell it.
  double uncertainty = std::numeric_limits<double>::quiet_NaN();
};

/// The camera's place from pairs of poses: solves A X = X B by cv::calibrateHandEye with the methods of Park and Martin
/// (1994), Horaud and Dornaika (1995), Daniilidis (1999) and Tsai and Lenz (1989), and takes that under which the
/// target moves least. Throws Error for fewer than three places of the gripper, poses that are not rigid, and motions
/// that turn too little or about parallel axes alone, which leave the camera's place open; for a residual of more than
/// 20 mm or 5 degrees, with what the pairs look like: inverse, in other units, of another mount, of a target of another
/// size, shifted, or which stand out; for a place that is unsure by 50 mm and more; and for a camera so near or far
/// that all lengths are in another unit.
HandEyeCalibration calibrateHandEye(const std::vector<HandEyePair>& pairs, CameraMount mount = CameraMount::Beside);

/// The residual, how sure the place is, and what may be wrong, in a sentence each.
std::string describe(const HandEyeCalibration& calibration);
}
