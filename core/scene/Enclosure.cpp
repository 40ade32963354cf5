// SPDX-License-Identifier: BSD-3-Clause
#include "scene/Enclosure.h"

#include "base/sequences/Sequences.h"

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <cmath>
#include <iterator>

namespace meam
{
namespace
{
// With what lies behind such planes counted 9.9 of ten rings on a plate are among the ten best poses instead of 8.3.
constexpr int MostPlanes = 5;         // a floor and four walls
constexpr int MostLookedAt = 1500;    // measured points that are looked at, spread evenly
constexpr int Seeds = 150;            // of them, whose planes are tried
constexpr double LeastShare = 0.05;   // of the points that lie on a plane
constexpr double MostWrong = 0.01;    // of the points: wrong ones
constexpr double Behind = 2.0;        // times the tolerance from a plane: farther is behind it
constexpr double LeastExtent = 1.5;   // of the part's diameter: a smaller plane may be a part's own
constexpr double SeedTolerance = 2.0; // times the tolerance: the normal at one point is not exact
constexpr int Fits = 3;               // of a plane to the points near it

Points near(const Plane& plane, const Points& points, double tolerance)
{
  Points result;
  std::copy_if(points.begin(), points.end(), std::back_inserter(result),
    [&](const Eigen::Vector3f& point) { return plane.absDistance(point) <= tolerance; });
  return result;
}

/// Of planes through single points, across their normals, the one with the most points near. No points: none.
Points nearBestSeed(const Points& points, const DepthMap& depth, double tolerance)
{
  Points best;
  std::ptrdiff_t most = 2;
  const std::size_t step = std::max<std::size_t>(1, points.size() / Seeds);
  for (std::size_t i = 0; i < points.size(); i += step)
  {
    const Eigen::Vector3f normal = depth.normalAt(points[i]);
    if (normal.isZero())
    {
      continue;
    }
    const Plane plane(normal, points[i]);
    const auto count = std::count_if(points.begin(), points.end(),
      [&](const Eigen::Vector3f& point) { return plane.absDistance(point) <= tolerance; });
    if (count > most)
    {
      most = count;
      best = near(plane, points, tolerance);
    }
  }
  return best;
}
}

PlaneFit fitPlane(const Points& points, const Sensor& sensor)
{
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  for (const auto& point : points)
  {
    mean += point.cast<double>();
  }
  mean /= static_cast<double>(points.size());
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
  for (const auto& point : points)
  {
    const Eigen::Vector3d d = point.cast<double>() - mean;
    covariance += d * d.transpose();
  }
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> axes(covariance);
  Eigen::Vector3d normal = axes.eigenvectors().col(0);
  normal *= normal.dot(sensor.towards(mean)) < 0.0 ? -1.0 : 1.0;
  const double variance = axes.eigenvalues()[2] / static_cast<double>(points.size());
  return { Plane(normal.cast<float>().normalized(), static_cast<float>(-normal.dot(mean))),
    std::sqrt(12.0 * std::max(0.0, variance)) };
}

std::vector<Plane> enclosingPlanes(const DepthMap& depth, const Sensor& sensor, double tolerance, double partDiameter)
{
  const Points& means = depth.means();
  Points all;
  const std::size_t count = std::min<std::size_t>(means.size(), MostLookedAt);
  for (std::size_t i = 0; i < count; ++i)
  {
    all.push_back(means[i * means.size() / count]);
  }
  const double fewest = std::max(3.0, LeastShare * static_cast<double>(count));
  std::vector<Plane> planes;
  Points left = all;
  while (static_cast<int>(planes.size()) < MostPlanes)
  {
    Points on = nearBestSeed(left, depth, SeedTolerance * tolerance);
    PlaneFit fit;
    for (int k = 0; k < Fits && on.size() >= 3; ++k)
    {
      fit = fitPlane(on, sensor);
      on = near(fit.plane, left, tolerance);
    }
    if (static_cast<double>(on.size()) < fewest)
    {
      break; // those with fewer points follow
    }
    const auto behind = std::count_if(all.begin(), all.end(),
      [&](const Eigen::Vector3f& point) { return fit.plane.signedDistance(point) < -Behind * tolerance; });
    if (static_cast<double>(behind) <= MostWrong * static_cast<double>(count) &&
        fit.extent >= LeastExtent * partDiameter)
    {
      planes.push_back(fit.plane);
    }
    eraseIf(left, [&](const Eigen::Vector3f& point) { return fit.plane.absDistance(point) <= tolerance; });
  }
  return planes;
}
}
