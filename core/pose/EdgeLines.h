// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "PointGrid.h"

namespace meam
{
/// Tangent lines of a scene's edge points, for look-ups of the one that an edge of a part may lie on: several at a time
/// with the widest vectors the processor has. Calls may run in parallel.
class EdgeLines
{
public:
  /// `grid` is of the edges' points.
  EdgeLines(const PointCloud& edges, const PointGrid& grid);

  struct Match
  {
    int edge = -1;                ///< -1: none
    float squaredDistance = 0.0f; ///< of the point to its line, mm^2
  };
  /// Of the edge points within `radius` (mm) of a point whose tangent is within 32 degrees of `tangent` the one whose
  /// line is nearest to the point.
  Match nearest(const Eigen::Vector3f& point, const Eigen::Vector3f& tangent, double radius) const;

private:
  const PointGrid& Grid;
  std::vector<float> X, Y, Z, TangentX, TangentY, TangentZ; ///< in the order of the grid
};
}
