// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "scene/edges/CloudEdges.h"

namespace meam
{
/// Of each two by two points the mean; of points that are farther behind the nearest of the four than `jump` (mm) none
/// counts. Not a number where none was measured. A last odd row or column is left out.
OrganizedCloud halved(const OrganizedCloud& cloud, double jump, int threads = 0);

/// The point of the halved grid that stands for one of the grid.
int placeInHalf(int point, const OrganizedCloud& halved, const OrganizedCloud& cloud);

/// Edges of the halved grid as those of the grid: each at the point of its four that lies the nearest to their mean. In
/// the order of the halved grid.
std::vector<GridEdge> onFullGrid(
  const std::vector<GridEdge>& edges, const OrganizedCloud& halved, const OrganizedCloud& cloud);
}
