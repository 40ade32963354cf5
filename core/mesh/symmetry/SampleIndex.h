// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/PointGrid.h"

namespace meam
{
/// Samples of a surface for look-ups of the nearest one that faces the same way: several at a time with the widest
/// vectors the processor has. Calls may run in parallel.
class SampleIndex
{
public:
  /// `cellSize` in mm, that of the grid; look-ups are fastest at radii near it. `sameSide`: cosine between normals from
  /// which on two samples are on the same side of the surface.
  SampleIndex(const PointCloud& surface, double cellSize, double sameSide);

  const PointGrid& grid() const { return this->Grid; }

  /// The nearest sample within `radius` (mm) whose normal is on the side of `normal`, or -1. Of several that are
  /// equally near the first in the grid's order.
  int nearest(const Eigen::Vector3f& point, const Eigen::Vector3f& normal, double radius) const;

private:
  PointGrid Grid;
  SoAOrientedPoints Samples; ///< with normals, in the grid's order, and room at the end
  float SameSide;
};
}
