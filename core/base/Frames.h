// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/PointCloud.h"

#include <optional>

namespace meam
{
/// Whether a matrix is a rotation and a translation, up to the rounding of entries that were printed with few digits.
bool isRigid(const Eigen::Matrix4d& matrix);

/// That rotation and translation, exactly where the matrix was printed with few digits; none of another matrix.
std::optional<Eigen::Isometry3d> rigidOf(const Eigen::Matrix4d& matrix);

/// The rotation nearest to a matrix.
Eigen::Matrix3d nearestRotation(const Eigen::Matrix3d& matrix);

/// The transform of 16 numbers, row by row.
Eigen::Isometry3d transformOf(const double* numbers);
/// Puts these of a transform behind others.
void appendNumbersOf(const Eigen::Isometry3d& T, std::vector<double>& numbers);

/// A right-handed frame whose first column is `axis`; a continuous function of it almost everywhere.
Eigen::Matrix3f frameAround(const Eigen::Vector3f& axis);

/// Takes points to their own principal frame (mean, axes of most and second most extent, signs by their skewness):
/// what is cut into cells and steps there does not depend on how the scene lies in its coordinates. Of all points
/// those that are finite and no strays far beyond all measure.
Eigen::Isometry3d principalFrame(const PrecisePoints& points);
}
