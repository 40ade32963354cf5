// SPDX-License-Identifier: BSD-3-Clause
#include "pose/Pose.h"

#include <cmath>

namespace meam
{
double rotationError(const Eigen::Isometry3d& a, const Eigen::Isometry3d& b)
{
  return Eigen::AngleAxisd(a.linear().transpose() * b.linear()).angle() * 180.0 / M_PI;
}

double translationError(const Eigen::Isometry3d& a, const Eigen::Isometry3d& b, const Eigen::Vector3d& point)
{
  return (a * point - b * point).norm();
}
}
