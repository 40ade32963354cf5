// SPDX-License-Identifier: BSD-3-Clause
#include "base/Bounds.h"

#include "base/AllVectors.h"
#include "base/sequences/Quantiles.h"

#include <algorithm>
#include <limits>

namespace meam
{
namespace
{
static_assert(sizeof(Eigen::Vector3f) == 3 * sizeof(float), "points are plain coordinates");

/// Extends the bounds of each lane by the finite points.
MEAM_ALL_VECTORS
void extend(const float* xyz, std::size_t count, float (*low)[PointLanes], float (*high)[PointLanes])
{
  constexpr float infinity = std::numeric_limits<float>::infinity();
  for (std::size_t begin = 0; begin < count; begin += PointLanes)
  {
    const float* from = xyz + 3 * begin;
#pragma omp simd
    for (int k = 0; k < PointLanes; ++k)
    {
      const float x = from[3 * k], y = from[3 * k + 1], z = from[3 * k + 2];
      const bool isFinite = (std::abs(x) < infinity) & (std::abs(y) < infinity) & (std::abs(z) < infinity);
      low[0][k] = std::min(low[0][k], isFinite ? x : infinity);
      low[1][k] = std::min(low[1][k], isFinite ? y : infinity);
      low[2][k] = std::min(low[2][k], isFinite ? z : infinity);
      high[0][k] = std::max(high[0][k], isFinite ? x : -infinity);
      high[1][k] = std::max(high[1][k], isFinite ? y : -infinity);
      high[2][k] = std::max(high[2][k], isFinite ? z : -infinity);
    }
  }
}
}

Eigen::AlignedBox3f bounds(const Points& points)
{
  constexpr float infinity = std::numeric_limits<float>::infinity();
  float low[3][PointLanes], high[3][PointLanes];
  std::fill_n(low[0], 3 * PointLanes, infinity);
  std::fill_n(high[0], 3 * PointLanes, -infinity);
  if (!points.empty())
  {
    inLanes(points.front().data(), points.size(),
      [&](const float* xyz, std::size_t count) { extend(xyz, count, low, high); });
  }
  Eigen::AlignedBox3f box;
  for (int axis = 0; axis < 3; ++axis)
  {
    const float least = *std::min_element(low[axis], low[axis] + PointLanes);
    if (least < infinity)
    {
      box.min()[axis] = least;
      box.max()[axis] = *std::max_element(high[axis], high[axis] + PointLanes);
    }
  }
  return box;
}

Eigen::AlignedBox3f innerBounds(const Points& points, double share)
{
  Eigen::AlignedBox3f box;
  std::vector<float> values;
  Eigen::Vector3f low;
  Eigen::Vector3f high;
  for (int axis = 0; axis < 3; ++axis)
  {
    values.clear();
    for (const auto& point : points)
    {
      if (point.allFinite())
      {
        values.push_back(point[axis]);
      }
    }
    if (values.empty())
    {
      return box;
    }
    const auto left = static_cast<std::size_t>(share * values.size());
    low[axis] = nthOf(values, left);
    high[axis] = nthOf(values, values.size() - 1 - left);
  }
  return { low, high };
}
}
