// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Error.h"
#include "Geometry.h"

namespace meam
{
struct BoundaryExtractionSettings
{
  double radius = 0.0; ///< mm, neighbourhood of a point; 0: 2.5 times the spacing of the points
  double angle = 90.0; ///< degrees: a point with a wider gap between its neighbours is on the boundary
};

/// Reduces each appearance model to its boundary points (paper, Section 4) with PCL's boundary
/// estimation. The models need normals. Throws Error when a model has none.
std::vector<AppearanceModel> extractBoundary(const std::vector<AppearanceModel>& models,
  const BoundaryExtractionSettings& settings = {}, const Progress& progress = {});

/// The median distance of a point to its nearest neighbour, in mm; 0 for less than two places.
double pointSpacing(const Points& points);
}
