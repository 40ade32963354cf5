// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/PointCloud.h"

namespace meam
{
/// A right-handed frame whose first column is `axis`; a continuous function of it almost everywhere.
Eigen::Matrix3f frameAround(const Eigen::Vector3f& axis);

/// Takes points to their own principal frame (mean, axes of most and second most extent, signs by their skewness):
/// what is cut into cells and steps there does not depend on how the scene lies in its coordinates. Of `count` points,
/// x y z each, those that are finite and no strays far beyond all measure.
Eigen::Isometry3d principalFrame(const float* xyz, std::size_t count);
Eigen::Isometry3d principalFrame(const double* xyz, std::size_t count);
template <typename Scalar>
Eigen::Isometry3d principalFrame(const std::vector<Eigen::Matrix<Scalar, 3, 1>>& points)
{
  return principalFrame(points.empty() ? nullptr : points.front().data(), points.size());
}
}
