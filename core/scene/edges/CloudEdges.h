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

struct CloudEdgeSettings
{
  // Depth edges
  int widestShadow = 20;   ///< grid steps from the end of a surface to the one behind, the shadow between them
  int fewestOfSurface = 3; ///< of the eight neighbours, within the jump: a point that flies alone is no edge
  int directionWindow = 2; ///< grid steps: where the surface goes on in it tells how its border runs
  // Creases
  double noises = 4.0;           ///< standard deviations of the angle that noise makes: a crease has no less
  double bendWithin = 0.35;      ///< of the crease's angle: a piece that bends by more behind its window is round
  double meetingDistance = 0.75; ///< grid steps from the point to where the two pieces meet
  double leastSpread = 1e-3;     ///< of points in a window, 1: in both directions alike; less is a line, and no plane
};

/// Points beside which the surface ends in front of another one that lies farther away by `jump` (mm) or
/// more. Where the sensor's shadow leaves points without depth between the two, the jump has to be as many
/// times deeper as the shadow is wide. In the order of the grid; a point without neighbours is none.
std::vector<GridEdge> findDepthEdges(const OrganizedCloud& cloud, double jump, int threads = 0,
  const Progress& progress = {}, const CloudEdgeSettings& settings = {});

/// Points in which two flat pieces of the surface meet at `angle` degrees or more, and at clearly more
/// than noise makes. Each piece is a window of the grid (GridScale::windowRadius) on its side of the point;
/// round surfaces, which bend on in both windows, have no creases. In the order of the grid.
std::vector<GridEdge> findCreases(const OrganizedCloud& cloud, const GridScale& scale, double angle, int threads = 0,
  const Progress& progress = {}, const CloudEdgeSettings& settings = {});
}
