// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/Error.h"
#include "scene/edges/GridSurface.h"

namespace meam
{
/// A point of an organized cloud that lies on an edge.
struct GridEdge
{
  int point = 0;                                        ///< row * width + column
  Eigen::Vector2f direction = Eigen::Vector2f::UnitX(); ///< unit, along the edge, in columns and rows
};

/// Points beside which the surface ends in front of another one that lies farther away by `jump` (mm) or
/// more. Where the sensor's shadow leaves points without depth between the two, the jump has to be as many
/// times deeper as the shadow is wide. In the order of the grid; a point without neighbours is none.
std::vector<GridEdge> findDepthEdges(
  const OrganizedCloud& cloud, double jump, int threads = 0, const Progress& progress = {});

/// Points in which two flat pieces of the surface meet at `angle` degrees or more, and at clearly more
/// than noise makes. Each piece is a window of the grid (GridScale::windowRadius) on its side of the point;
/// round surfaces, which bend on in both windows, have no creases. In the order of the grid.
std::vector<GridEdge> findCreases(
  const OrganizedCloud& cloud, const GridScale& scale, double angle, int threads = 0, const Progress& progress = {});
}
