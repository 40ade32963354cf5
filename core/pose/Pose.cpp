// SPDX-License-Identifier: BSD-3-Clause
#include "pose/Pose.h"

#include <cmath>

namespace meam
{
Pose moved(const Pose& pose, const Eigen::Isometry3d& motion)
{
  Pose result = pose;
  result.T_scene_model = motion * pose.T_scene_model;
  Eigen::Matrix<double, 6, 6> turn = Eigen::Matrix<double, 6, 6>::Zero();
  turn.topLeftCorner<3, 3>() = motion.linear();
  turn.bottomRightCorner<3, 3>() = motion.linear();
  result.fit.covariance = turn * pose.fit.covariance * turn.transpose();
  return result;
}

double rotationError(const Eigen::Isometry3d& a, const Eigen::Isometry3d& b)
{
  return Eigen::AngleAxisd(a.linear().transpose() * b.linear()).angle() * 180.0 / M_PI;
}

double translationError(const Eigen::Isometry3d& a, const Eigen::Isometry3d& b, const Eigen::Vector3d& point)
{
  return (a * point - b * point).norm();
}
}
