// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/ConvexHull.h"

#include "base/sequences/Sequences.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Extreme_points_traits_adapter_3.h>
#include <CGAL/convex_hull_3.h>
#include <CGAL/property_map.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace meam
{
std::vector<int> convexHullCorners(const std::vector<Eigen::Vector3d>& points)
{
  using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
  const auto corners = mapped<Kernel::Point_3>(
    points, [&](const auto& point) { return Kernel::Point_3(point.x(), point.y(), point.z()); });
  std::vector<std::size_t> all(points.size());
  std::iota(all.begin(), all.end(), std::size_t{ 0 });
  std::vector<std::size_t> extreme;
  CGAL::extreme_points_3(
    all, std::back_inserter(extreme), CGAL::make_extreme_points_traits_adapter(CGAL::make_property_map(corners)));
  std::vector<int> result(extreme.begin(), extreme.end());
  std::sort(result.begin(), result.end());
  return result;
}

double diameter(const Points& points)
{
  std::vector<Eigen::Vector3d> finite;
  finite.reserve(points.size());
  for (const auto& point : points)
  {
    if (point.allFinite())
    {
      finite.push_back(point.cast<double>());
    }
  }
  if (finite.size() < 2)
  {
    return 0.0;
  }
  // The two points that are farthest apart are corners of the hull.
  const std::vector<int> corners = convexHullCorners(finite);
  double longest = 0.0;
  for (std::size_t i = 0; i < corners.size(); ++i)
  {
    for (std::size_t j = i + 1; j < corners.size(); ++j)
    {
      longest = std::max(longest, (finite[corners[i]] - finite[corners[j]]).squaredNorm());
    }
  }
  return std::sqrt(longest);
}
}
