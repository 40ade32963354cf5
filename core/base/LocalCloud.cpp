// SPDX-License-Identifier: BSD-3-Clause
#include "base/LocalCloud.h"

#include "base/Frames.h"
#include "base/Parallel.h"

#include <algorithm>

namespace meam
{
namespace
{
/// Rounds what at(i) gives, in double precision, of each of `count` points.
template <typename At>
Points rounded(std::size_t count, int threads, At&& at)
{
  Points points(count);
  parallelFor(static_cast<int>(count), threads, {},
    [&](int begin, int end, int)
    {
      for (int i = begin; i < end; ++i)
      {
        points[i] = at(static_cast<std::size_t>(i)).template cast<float>();
      }
    });
  return points;
}

template <typename Scalar>
Points finiteInFrame(const Scalar* xyz, std::size_t count, const Eigen::Isometry3d& T_local_scene, int threads)
{
  Points points = rounded(count, threads,
    [&](std::size_t i) -> Eigen::Vector3d
    { return T_local_scene * Eigen::Matrix<Scalar, 3, 1>(xyz + 3 * i).template cast<double>(); });
  const auto isInvalid = [](const Eigen::Vector3f& point) { return !point.allFinite(); };
  points.erase(std::remove_if(points.begin(), points.end(), isInvalid), points.end());
  return points;
}

PrecisePoints precise(const Points& points)
{
  PrecisePoints result;
  result.reserve(points.size());
  for (const Eigen::Vector3f& point : points)
  {
    result.push_back(point.cast<double>());
  }
  return result;
}
}

LocalCloud toLocalCloud(const PrecisePoints& points, const PrecisePoints& tangents, std::vector<float> weights,
  const Eigen::Isometry3d& T_local_scene, int threads)
{
  LocalCloud local;
  local.T_local_scene = T_local_scene;
  local.cloud.points =
    rounded(points.size(), threads, [&](std::size_t i) -> Eigen::Vector3d { return T_local_scene * points[i]; });
  local.cloud.tangents = rounded(tangents.size(), threads,
    [&](std::size_t i) -> Eigen::Vector3d { return T_local_scene.linear() * tangents[i]; });
  local.cloud.weights = std::move(weights);
  return local;
}

LocalCloud toLocalCloud(const PointCloud& cloud, int threads)
{
  const PrecisePoints points = precise(cloud.points);
  return toLocalCloud(points, precise(cloud.tangents), cloud.weights, principalFrame(points), threads);
}

Points toLocalPoints(const float* xyz, std::size_t count, const Eigen::Isometry3d& T_local_scene, int threads)
{
  return finiteInFrame(xyz, count, T_local_scene, threads);
}

Points toLocalPoints(const double* xyz, std::size_t count, const Eigen::Isometry3d& T_local_scene, int threads)
{
  return finiteInFrame(xyz, count, T_local_scene, threads);
}
}
