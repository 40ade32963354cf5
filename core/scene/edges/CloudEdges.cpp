// SPDX-License-Identifier: BSD-3-Clause
#include "scene/edges/CloudEdges.h"

#include "base/Parallel.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace meam
{
namespace
{
constexpr int WidestShadow = 20;   // grid steps
constexpr int FewestOfSurface = 3; // of the eight neighbours: a point that flies alone is no edge
constexpr int DirectionWindow = 2; // grid steps: where the surface goes on tells how its border runs
constexpr double NoiseDeviations = 4.0;
constexpr double BendWithin = 0.35;      // of the angle between two pieces: a piece that bends more is round
constexpr double MeetingDistance = 0.75; // grid steps from the point to where the two pieces meet
const std::array<std::pair<int, int>, 4> Across{ { { 1, 0 }, { 0, 1 }, { 1, 1 }, { 1, -1 } } }; // columns, rows

using GridEdges = std::vector<GridEdge>;

/// Tests every point of the grid, rows shared among threads: test(row, column, edge) says whether it is an edge.
template <typename Test>
GridEdges collect(const OrganizedCloud& cloud, int threads, const Progress& progress, const Test& test)
{
  std::vector<GridEdges> ofRow(cloud.height);
  parallelFor(cloud.height, threads, progress,
    [&](int begin, int end, int)
    {
      for (int row = begin; row < end; ++row)
      {
        for (int column = 0; column < cloud.width; ++column)
        {
          GridEdge edge;
          edge.point = row * cloud.width + column;
          if (cloud.points[edge.point].allFinite() && test(row, column, edge))
          {
            ofRow[row].push_back(edge);
          }
        }
      }
    });
  GridEdges all;
  for (const GridEdges& edges : ofRow)
  {
    all.insert(all.end(), edges.begin(), edges.end());
  }
  return all;
}

/// The point in a direction, or null outside the grid.
const Eigen::Vector3f* pointAt(const OrganizedCloud& cloud, int row, int column)
{
  const bool inside = row >= 0 && column >= 0 && row < cloud.height && column < cloud.width;
  return inside ? &cloud.points[static_cast<std::size_t>(row) * cloud.width + column] : nullptr;
}

/// Whether the surface ends at a point in a direction, in front of another one: farther away than its slope leads.
bool endsInFront(const OrganizedCloud& cloud, int row, int column, int down, int right, float jump)
{
  const float z = pointAt(cloud, row, column)->z();
  const Eigen::Vector3f* before = pointAt(cloud, row - down, column - right);
  const float slope = before && before->allFinite() ? std::max(0.0f, z - before->z()) : 0.0f;
  for (int step = 1; step <= WidestShadow; ++step)
  {
    const Eigen::Vector3f* next = pointAt(cloud, row + step * down, column + step * right);
    if (!next)
    {
      return false;
    }
    if (next->allFinite())
    {
      return next->z() - z > (jump + slope) * static_cast<float>(step);
    }
  }
  return false;
}

/// Along the border of the surface that a point is on; zero when it has none nearby.
Eigen::Vector2f borderDirection(const OrganizedCloud& cloud, int row, int column, float jump)
{
  const float z = pointAt(cloud, row, column)->z();
  Eigen::Vector2f inwards = Eigen::Vector2f::Zero();
  for (int v = -DirectionWindow; v <= DirectionWindow; ++v)
  {
    for (int u = -DirectionWindow; u <= DirectionWindow; ++u)
    {
      const Eigen::Vector3f* other = pointAt(cloud, row + v, column + u);
      const bool cut = !pointAt(cloud, row - v, column - u); // the window is even on all sides, also beside the grid
      if (other && !cut && std::abs(other->z() - z) <= jump)
      {
        inwards += Eigen::Vector2f(u, v);
      }
    }
  }
  return inwards.isZero() ? inwards : Eigen::Vector2f(-inwards.y(), inwards.x()).normalized();
}

/// The angle in radians between two planes, as their normals' cross and dot products have it.
float angleBetween(const GridPlane& a, const GridPlane& b)
{
  const Eigen::Vector3f n = a.alongColumn.cross(a.alongRow);
  const Eigen::Vector3f m = b.alongColumn.cross(b.alongRow);
  return std::atan2(n.cross(m).norm(), n.dot(m));
}
}

std::vector<GridEdge> findDepthEdges(const OrganizedCloud& cloud, double jump, int threads, const Progress& progress)
{
  const float limit = static_cast<float>(jump);
  return collect(cloud, threads, progress,
    [&](int row, int column, GridEdge& edge)
    {
      if (!endsInFront(cloud, row, column, 0, 1, limit) && !endsInFront(cloud, row, column, 0, -1, limit) &&
          !endsInFront(cloud, row, column, 1, 0, limit) && !endsInFront(cloud, row, column, -1, 0, limit))
      {
        return false;
      }
      int sameSurface = -1; // itself
      for (int k = 0; k < 9; ++k)
      {
        const Eigen::Vector3f* other = pointAt(cloud, row + k / 3 - 1, column + k % 3 - 1);
        sameSurface += other && std::abs(other->z() - cloud.points[edge.point].z()) <= limit;
      }
      edge.direction = borderDirection(cloud, row, column, limit);
      return sameSurface >= FewestOfSurface && !edge.direction.isZero();
    });
}

std::vector<GridEdge> findCreases(
  const OrganizedCloud& cloud, const GridScale& scale, double angle, int threads, const Progress& progress)
{
  const int radius = scale.windowRadius();
  const double jump = scale.depthJump();
  std::vector<GridPlane> planes(cloud.size());
  parallelFor(cloud.height, threads, subProgress(progress, 0.0, 0.8),
    [&](int begin, int end, int)
    {
      for (int row = begin; row < end; ++row)
      {
        for (int column = 0; column < cloud.width; ++column)
        {
          planes[static_cast<std::size_t>(row) * cloud.width + column] = fitPlane(cloud, row, column, { radius, radius }, jump);
        }
      }
    });
  const int reach = radius + 1; // a window whose middle is so far away ends beside the point
  const auto planeAt = [&](int row, int column)
  {
    const bool inside = row >= 0 && column >= 0 && row < cloud.height && column < cloud.width;
    return inside ? &planes[static_cast<std::size_t>(row) * cloud.width + column] : nullptr;
  };
  const float limit =
    static_cast<float>(std::max(angle * M_PI / 180.0, NoiseDeviations * std::sqrt(2.0) * scale.slopeError(radius)));
  return collect(cloud, threads, subProgress(progress, 0.8, 1.0),
    [&](int row, int column, GridEdge& edge)
    {
      float best = 0.0f;
      for (const auto& [right, down] : Across)
      {
        const GridPlane* before = planeAt(row - reach * down, column - reach * right);
        const GridPlane* after = planeAt(row + reach * down, column + reach * right);
        if (!before || !after || !before->valid() || !after->valid())
        {
          continue;
        }
        const float bend = angleBetween(*before, *after);
        if (!(bend >= limit) || bend <= best)
        {
          continue;
        }
        // Both planes as depths over columns and rows around the point: they meet where the depths agree.
        const Eigen::Vector2f slope(
          after->alongColumn.z() - before->alongColumn.z(), after->alongRow.z() - before->alongRow.z());
        const Eigen::Vector2f step(right, down);
        const float depthBefore =
          before->middle.z() + reach * (right * before->alongColumn.z() + down * before->alongRow.z());
        const float depthAfter =
          after->middle.z() - reach * (right * after->alongColumn.z() + down * after->alongRow.z());
        const float rate = slope.dot(step);
        if (!(std::abs(depthAfter - depthBefore) <= MeetingDistance * std::abs(rate)) ||
            !(std::abs(depthAfter - cloud.points[edge.point].z()) <= jump))
        {
          continue;
        }
        // A piece that bends on behind its window is round; one that ends there is not, but for the end of the grid.
        const auto round = [&](const GridPlane& near, int side)
        {
          const GridPlane* far = planeAt(row + 2 * side * reach * down, column + 2 * side * reach * right);
          const float expected =
            near.middle.z() + side * reach * (right * near.alongColumn.z() + down * near.alongRow.z());
          return !far || (far->valid() && std::abs(far->middle.z() - expected) <= jump &&
                           angleBetween(*far, near) > BendWithin * bend);
        };
        if (round(*before, -1) || round(*after, 1))
        {
          continue;
        }
        best = bend;
        edge.direction = Eigen::Vector2f(-slope.y(), slope.x()).normalized();
      }
      return best > 0.0f;
    });
}
}
