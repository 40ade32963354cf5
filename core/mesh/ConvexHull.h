// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/PointCloud.h"

namespace meam
{
/// Indices of the corners of the convex hull, ascending (CGAL). Flat and collinear sets are fine; of
/// equal points one index is returned.
std::vector<int> convexHullCorners(const std::vector<Eigen::Vector3d>& points);

/// d_max (paper, Section 5.1): the longest distance between two of the finite points, in mm.
double diameter(const Points& points);
}
