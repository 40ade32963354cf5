// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/PointGrid.h"

namespace meam
{
/// Tangent lines of a scene's edge points, for look-ups of the one that an edge of a part may lie on: several at a time
/// with the widest vectors the processor has. Calls may run in parallel.
class EdgeIndex
{
public:
  /// No edges.
  EdgeIndex() = default;
  /// `cellSize` in mm, that of the grid of the edges' points.
  EdgeIndex(const PointCloud& edges, double cellSize);

  /// Of the edges' points.
  const PointGrid& grid() const { return this->Grid; }

  struct Match
  {
    int edge = -1;                ///< -1: none
    float squaredDistance = 0.0f; ///< of the point to its line, mm^2
  };
  /// Of the edge points within `radius` (mm) of a point whose tangent is parallel to `tangent` the one whose line
  /// is nearest to the point.
  Match nearest(const Eigen::Vector3f& point, const Eigen::Vector3f& tangent, double radius) const;

  /// For each of several points the lines of the edge points about it.
  struct Neighbours
  {
    std::vector<int> starts;    ///< of each point's lines, and the end of the last one's
    SoAOrientedPoints lines;    ///< and room at the end for as many as are looked at together
    std::vector<float> weights; ///< of these
  };
  /// Those that `meansAround` looks at for points with unit tangents, until one has moved by `margin` (mm) or turned by
  /// 5 degrees. `radius` and `across` as there.
  Neighbours neighbours(const SoAOrientedPoints& points, double radius, double across, double margin) const;

  struct Means
  {
    SoAPoints offsets;          ///< mm, at right angles to the tangents
    std::vector<float> weights; ///< its own for each edge point at the same place; 0: there is none that counts
  };
  /// How far points with unit tangents, those with these neighbours, are from the edge points about them, on average,
  /// across the tangents. Their weights fall to 0 at `radius` (mm) from the point, at `across` (mm) across the tangent
  /// and where the tangents are as far apart as they may be, so that the mean changes steadily with point and tangent:
  /// no edge point comes in or goes out at once.
  static Means meansAround(const Neighbours& neighbours, const SoAOrientedPoints& points, double radius, double across);

private:
  /// Calls visit(ranges, count) with ranges of the columns, several at once, that hold all within `radius` of the
  /// point.
  template <typename Visitor>
  void forEachGroupOfRanges(const Eigen::Vector3f& point, double radius, Visitor&& visit) const;

  PointGrid Grid;
  SoAOrientedPoints Lines;    ///< the points and their tangents, in the order of the grid, and room at the end
  std::vector<float> Weights; ///< of these
};
}
