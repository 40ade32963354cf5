// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/SoAPoints.h"

#include <algorithm>
#include <limits>

namespace meam
{
/// Points sorted into cubic cells, for neighbour queries at one known radius.
class PointGrid
{
public:
  /// No points.
  PointGrid() = default;
  /// `cellSize` in mm; queries are fastest at radii near it. Points that are not finite are left out.
  /// Throws Error when the cell size is not positive or the points' extent is beyond all measure.
  PointGrid(const Points& points, double cellSize);

  /// Calls visit(index, squaredDistance) for every point within `radius` of `centre`, in an order
  /// that depends only on the points.
  template <typename Visitor>
  void forEachWithin(const Eigen::Vector3f& centre, double radius, Visitor&& visit) const
  {
    const float limit = static_cast<float>(radius) * static_cast<float>(radius);
    this->forEachRange(centre, radius,
      [&](int begin, int end)
      {
        for (int k = begin; k < end; ++k)
        {
          const float distance = (this->Sorted[k] - centre).squaredNorm();
          if (distance <= limit)
          {
            visit(this->Order[k], distance);
          }
        }
      });
  }

  /// The finite points' indices cell by cell: the order that forEachRange counts in.
  const std::vector<int>& order() const { return this->Order; }
  /// The points in that order.
  const SoAPoints& sorted() const { return this->Sorted; }

  /// Calls visit(begin, end) with ranges of `order` that together hold all points within `radius`, and others.
  template <typename Visitor>
  void forEachRange(const Eigen::Vector3f& centre, double radius, Visitor&& visit) const
  {
    if (this->Order.empty())
    {
      return;
    }
    const float r = static_cast<float>(radius);
    const Eigen::Vector3i low = this->cellOf(centre.array() - r);
    const Eigen::Vector3i high = this->cellOf(centre.array() + r);
    for (int z = low.z(); z <= high.z(); ++z)
    {
      for (int y = low.y(); y <= high.y(); ++y)
      {
        // Cells along x are neighbours in memory.
        const std::size_t row = (static_cast<std::size_t>(z) * this->Size.y() + y) * this->Size.x();
        visit(this->Starts[row + low.x()], this->Starts[row + high.x() + 1]);
      }
    }
  }

  /// The same by visit(begin, count), with at most SoABlock at a time.
  template <typename Visitor>
  void forEachBlock(const Eigen::Vector3f& centre, double radius, Visitor&& visit) const
  {
    this->forEachRange(centre, radius,
      [&](int begin, int end)
      {
        for (; begin < end; begin += SoABlock)
        {
          visit(begin, std::min(SoABlock, end - begin));
        }
      });
  }

  /// The nearest point within `radius`, or -1.
  int nearest(const Eigen::Vector3f& centre, double radius) const
  {
    int best = -1;
    float least = 0.0f;
    this->forEachWithin(centre, radius,
      [&](int index, float distance)
      {
        if (best < 0 || distance < least)
        {
          best = index;
          least = distance;
        }
      });
    return best;
  }

private:
  Eigen::Vector3i cellOf(const Eigen::Vector3f& point) const
  {
    // What lies outside belongs to the cells of the border; clamped before the cast. Of a number and none the maximum
    // is its first operand.
    return Eigen::Array3f::Zero()
      .max(((point - this->Origin) * this->InverseCell).array())
      .min(this->Size.cast<float>().array() - 1.0f)
      .cast<int>();
  }

  Eigen::Vector3f Origin = Eigen::Vector3f::Zero();
  float InverseCell = 1.0f;
  Eigen::Vector3i Size = Eigen::Vector3i::Zero(); ///< cells along x, y and z
  std::vector<int> Starts;                        ///< of each cell's points in Order and Sorted
  std::vector<int> Order;
  SoAPoints Sorted;
};

/// Of a cell's side: the strip along its border in which points count less.
constexpr double BorderStrip = 0.15;

/// What a point counts in its cell, (0, 1]: 1, and next to the border of the cell less. `place` is in sides of the cell
/// from its corner. So points come into sums slowly as they come over a border.
template <typename Array>
typename Array::Scalar weightInCell(const Array& place)
{
  using Scalar = typename Array::Scalar;
  constexpr Scalar strip = Scalar(BorderStrip);
  const Array inside = Scalar(0.5) - (place - Scalar(0.5)).abs();
  return std::max<Scalar>(std::numeric_limits<float>::min(), (inside / strip).min(Scalar(1)).prod());
}

/// Indices of one point for each occupied cube of side `leafSize` (mm): the point nearest to the
/// mean of the cube's points. Cubes are counted from the origin of the coordinates, so views of one
/// part share them; points that are not finite are left out, and of points more than a million cubes from most of the
/// others one or a few stay. Ordered by cube: along z, then y, then x. A
/// leaf of 0 or less keeps every point.
std::vector<int> thinPoints(const Points& points, double leafSize);
/// The same of points with normals, but in a cube through which a thin sheet goes one of each of its sides.
std::vector<int> thinSurface(const PointCloud& surface, double leafSize);

struct ThinnedPoints
{
  std::vector<int> indices;
  std::vector<float> weights; ///< of each
};
/// A like choice with weights, [0, 1]: 1 of what stands for a point well inside a cube, and less the nearer to their
/// cube's border all points are that it stands for. In the means they count so, too. As points move, one that comes
/// over a border is kept or left out at once, but its weight is next to 0 then. The origin of the coordinates is the
/// middle of a cube, so points in a plane through it are well inside.
ThinnedPoints thinWithWeights(const Points& points, double leafSize);
}
