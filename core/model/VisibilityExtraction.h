// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Error.h"
#include "Geometry.h"

namespace meam
{
struct VisibilityExtractionSettings
{
  int viewpoints = 6;             ///< 1, 2, 6 (the paper), 14, 26, or N on a Fibonacci sphere
  double radiusFactor = 1000.0;   ///< gamma: radius of the inversion sphere over the farthest distance
  double viewpointDistance = 10.0; ///< from the middle of the part, in part diameters
};

/// Indices, ascending, of the points that are visible from `viewpoint`: hidden point removal of Katz,
/// Tal and Basri (SIGGRAPH 2007) by inversion in a sphere around the viewpoint and a convex hull.
std::vector<int> visiblePoints(const Points& points, const Eigen::Vector3d& viewpoint, double radiusFactor);

/// One appearance model for each viewpoint (paper, Section 4): the points of `surface` (mm) that are
/// visible from it. Throws Error for an empty surface or one of NaN.
std::vector<AppearanceModel> extractVisibility(
  const PointCloud& surface, const VisibilityExtractionSettings& settings = {}, const Progress& progress = {});
}
