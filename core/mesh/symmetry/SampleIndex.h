// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/PointGrid.h"
#include "base/SoAPoints.h"

namespace meam
{
/// Samples of a surface for look-ups of the nearest one that faces the same way: several at a time with the widest
/// vectors the processor has. Calls may run in parallel.
class SampleIndex
{
public:
  /// `surface` has normals; samples that are not finite are left out. `cellSize` in mm, that of the grid: look-ups are
  /// fastest at radii near it. `sameSide`: cosine between normals above which two samples are on the same side.
  SampleIndex(const PointCloud& surface, double cellSize, double sameSide);

  const PointGrid& grid() const { return this->Grid; }

  /// Index of the nearest sample within `radius` (mm) that is on the same side as `normal`, or -1; of several that are
  /// equally near the first in the grid's order.
  int nearest(const Eigen::Vector3f& point, const Eigen::Vector3f& normal, double radius) const;

private:
  PointGrid Grid;
  SoAOrientedPoints Samples; ///< with normals, in the grid's order, and room for whole groups of lanes at the end
  float SameSide;
};
}
