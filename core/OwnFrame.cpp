// SPDX-License-Identifier: BSD-3-Clause
#include "OwnFrame.h"

#include "Parallel.h"

#include <algorithm>

namespace meam
{
namespace
{
template <typename Scalar>
FramedPoints finiteInOwnFrame(const Scalar* xyz, std::size_t count, int threads)
{
  FramedPoints result;
  result.frame = principalFrame(xyz, count);
  result.points.resize(count);
  parallelFor(static_cast<int>(count), threads, {},
    [&](int begin, int end, int)
    {
      for (int i = begin; i < end; ++i)
      {
        const Eigen::Matrix<Scalar, 3, 1> point(xyz + 3 * static_cast<std::ptrdiff_t>(i));
        result.points[i] = (result.frame * point.template cast<double>()).template cast<float>();
      }
    });
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

PointCloud inFrame(const PreciseCloud& cloud, const Eigen::Isometry3d& frame)
{
  PointCloud result;
  result.points.reserve(cloud.points.size());
  for (const Eigen::Vector3d& point : cloud.points)
  {
    result.points.push_back((frame * point).cast<float>());
  }
  result.tangents.reserve(cloud.tangents.size());
  for (const Eigen::Vector3d& tangent : cloud.tangents)
  {
    result.tangents.push_back((frame.linear() * tangent).cast<float>());
  }
  result.weights = cloud.weights;
  return result;
}

FramedCloud inOwnFrame(const PreciseCloud& cloud)
{
  const Eigen::Isometry3d frame = principalFrame(cloud.points);
  return { frame, inFrame(cloud, frame) };
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
