// SPDX-License-Identifier: BSD-3-Clause
#include "base/LocalFrame.h"

#include "base/Parallel.h"
#include "base/Frames.h"

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
FramedPoints finiteInOwnFrame(const Scalar* xyz, std::size_t count, int threads)
{
  FramedPoints result;
  result.frame = principalFrame(xyz, count);
  result.points = rounded(count, threads,
    [&](std::size_t i) -> Eigen::Vector3d
    { return result.frame * Eigen::Matrix<Scalar, 3, 1>(xyz + 3 * i).template cast<double>(); });
  const auto isNone = [](const Eigen::Vector3f& point) { return !point.allFinite(); };
  result.points.erase(std::remove_if(result.points.begin(), result.points.end(), isNone), result.points.end());
  return result;
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

PreciseCloud::PreciseCloud(const PointCloud& cloud)
  : points(precise(cloud.points))
  , tangents(precise(cloud.tangents))
  , weights(cloud.weights)
{
}

PointCloud inFrame(const PreciseCloud& cloud, const Eigen::Isometry3d& frame, int threads)
{
  PointCloud result;
  result.points = rounded(cloud.points.size(), threads,
    [&](std::size_t i) -> Eigen::Vector3d { return frame * cloud.points[i]; });
  result.tangents = rounded(cloud.tangents.size(), threads,
    [&](std::size_t i) -> Eigen::Vector3d { return frame.linear() * cloud.tangents[i]; });
  result.weights = cloud.weights;
  return result;
}

FramedCloud inOwnFrame(const PreciseCloud& cloud, int threads)
{
  const Eigen::Isometry3d frame = principalFrame(cloud.points);
  return { frame, inFrame(cloud, frame, threads) };
}

FramedPoints inOwnFrame(const float* xyz, std::size_t count, int threads)
{
  return finiteInOwnFrame(xyz, count, threads);
}

FramedPoints inOwnFrame(const double* xyz, std::size_t count, int threads)
{
  return finiteInOwnFrame(xyz, count, threads);
}
}
