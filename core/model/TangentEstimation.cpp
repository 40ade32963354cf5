// SPDX-License-Identifier: BSD-3-Clause
#include "model/TangentEstimation.h"

#include "Parallel.h"
#include "PointGrid.h"

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <cmath>
#include <map>

namespace meam
{
namespace
{
constexpr std::size_t MostPerTile = 4000;  // the work grows with its cube
constexpr std::size_t FewestInliers = 4; // a line through three points of a band of edge points is chance

float squaredDistanceToLine(const Eigen::Vector3f& offset, const Eigen::Vector3f& direction)
{
  return offset.cross(direction).squaredNorm();
}

/// Principal axis of the offsets, zero when they have no extent.
Eigen::Vector3f principalAxis(const Points& offsets)
{
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  for (const auto& offset : offsets)
  {
    mean += offset.cast<double>();
  }
  mean /= static_cast<double>(offsets.size());
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
  for (const auto& offset : offsets)
  {
    const Eigen::Vector3d d = offset.cast<double>() - mean;
    covariance += d * d.transpose();
  }
  Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver;
  solver.computeDirect(covariance);
  return solver.eigenvalues()[2] > 0.0 ? solver.eigenvectors().col(2).cast<float>().eval() : Eigen::Vector3f::Zero();
}

/// Tangent at a point from its neighbours' offsets; zero when no line is supported. Lines through the
/// point and each neighbour are tried, as in Algorithm 2; the sphere makes the neighbourhood the same
/// wherever the point lies, and the inliers' axis uses all of them instead of one far point.
Eigen::Vector3f robustLine(const Points& offsets, double inlierDistance)
{
  const float limit = static_cast<float>(inlierDistance * inlierDistance);
  std::size_t best = 0;
  Eigen::Vector3f direction = Eigen::Vector3f::Zero();
  for (const auto& candidate : offsets)
  {
    const float length = candidate.norm();
    if (length <= static_cast<float>(inlierDistance))
    {
      continue;
    }
    const Eigen::Vector3f line = candidate / length;
    const std::size_t support = std::count_if(offsets.begin(), offsets.end(),
      [&](const auto& offset) { return squaredDistanceToLine(offset, line) <= limit; });
    if (support > best)
    {
      best = support;
      direction = line;
    }
  }
  if (best < FewestInliers)
  {
    return Eigen::Vector3f::Zero();
  }
  Points inliers;
  for (const auto& offset : offsets)
  {
    if (squaredDistanceToLine(offset, direction) <= limit)
    {
      inliers.push_back(offset);
    }
  }
  return principalAxis(inliers);
}

Points robustTangents(const Points& edges, const std::vector<int>& kept, double radius, double inlierDistance,
  int threads, const Progress& progress)
{
  const PointGrid grid(edges, radius);
  Points tangents(kept.size());
  parallelFor(static_cast<int>(kept.size()), threads, progress,
    [&](int begin, int end, int)
    {
      for (int i = begin; i < end; ++i)
      {
        const Eigen::Vector3f& centre = edges[kept[i]];
        Points offsets;
        grid.forEachWithin(centre, radius, [&](int index, float) { offsets.push_back(edges[index] - centre); });
        tangents[i] = robustLine(offsets, inlierDistance);
      }
    });
  return tangents;
}

/// Algorithms 1 and 2 of the paper, on the points that are kept.
Points tileTangents(const Points& points, const Eigen::Vector3f& viewDirection, const TangentEstimationSettings& settings,
  const Progress& progress)
{
  // The projection plane: that of x and y for a view along z, as in the paper.
  const bool alongZ = std::abs(viewDirection.z()) > 0.999f;
  const Eigen::Matrix3f frame = frameAround(viewDirection);
  const Eigen::Vector3f right = alongZ ? Eigen::Vector3f::UnitX().eval() : frame.col(1).eval();
  const Eigen::Vector3f down = alongZ ? Eigen::Vector3f::UnitY().eval() : frame.col(2).eval();
  const double tile = settings.tilePixels * settings.pixelSize;
  std::map<std::pair<std::int64_t, std::int64_t>, std::vector<int>> tiles;
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    tiles[{ static_cast<std::int64_t>(std::floor(points[i].dot(right) / tile)),
            static_cast<std::int64_t>(std::floor(points[i].dot(down) / tile)) }]
      .push_back(static_cast<int>(i));
  }
  Points tangents(points.size(), Eigen::Vector3f::Zero());
  const float limit = static_cast<float>(settings.lineDistance * settings.lineDistance);
  std::size_t done = 0;
  for (const auto& [place, members] : tiles)
  {
    if (members.size() > MostPerTile)
    {
      throw Error("A tile holds " + std::to_string(members.size()) +
        " edge points, each pair of which makes a line to try: use smaller tiles or a larger leaf size.");
    }
    for (const int j : members)
    {
      report(progress, static_cast<double>(done++) / points.size());
      std::size_t best = 0;
      Eigen::Vector3f direction = Eigen::Vector3f::Zero();
      for (const int k : members)
      {
        const Eigen::Vector3f line = (points[k] - points[j]).normalized();
        if (k == j || !line.allFinite() || line.isZero())
        {
          continue;
        }
        const std::size_t score = std::count_if(members.begin(), members.end(),
          [&](int m) { return squaredDistanceToLine(points[m] - points[j], line) < limit; });
        if (score > best)
        {
          best = score;
          direction = line;
        }
      }
      if (best > settings.lineSupport * members.size())
      {
        tangents[j] = direction;
      }
    }
  }
  return tangents;
}
}

TangentEstimationSettings paperTangentSettings()
{
  TangentEstimationSettings settings;
  settings.method = TangentMethod::Tiles;
  settings.leafSize = 1.0;
  return settings;
}

PointCloud estimateTangents(const PointCloud& edges, double partDiameter, const Eigen::Vector3f& viewDirection,
  const TangentEstimationSettings& settings, const Progress& progress)
{
  requirePoints(edges.points, "The edge cloud");
  const PointCloud cloud = finitePoints(edges);
  const bool robust = settings.method == TangentMethod::RobustLine;
  const auto length = [&](double value, double share)
  {
    if (value != 0.0)
    {
      return value;
    }
    if (!(partDiameter > 0.0))
    {
      throw Error("The part's diameter is not known, so lengths cannot follow it: connect the part's model, or give "
                  "the leaf size, radius and inlier distance in mm.");
    }
    return share * partDiameter;
  };
  const std::vector<int> kept = thinPoints(cloud.points, length(settings.leafSize, 0.03));
  PointCloud result = cloud.subset(kept);
  if (result.tangents.empty())
  {
    result.tangents = robust
      ? robustTangents(cloud.points, kept, length(settings.radius, 0.06), length(settings.inlierDistance, 0.012),
          settings.threads, progress)
      : tileTangents(result.points, viewDirection, settings, progress);
  }
  std::vector<int> found;
  for (std::size_t i = 0; i < result.size(); ++i)
  {
    if (!result.tangents[i].isZero())
    {
      found.push_back(static_cast<int>(i));
    }
  }
  report(progress, 1.0);
  return result.subset(found);
}
}
