// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/PointCloud.h"

#include <cstdint>

namespace meam
{
// A scene's points are worked on in single precision, in a frame of their own that moves with them. Those that come in
// double precision are taken there before they are rounded, so that a scene that is moved is the same scene there.

/// Edge points of a scene in double precision, mm; an array is empty or as long as `points`.
struct PreciseCloud
{
  PreciseCloud() = default;
  PreciseCloud(const PointCloud& cloud); ///< its points, tangents and weights

  PrecisePoints points;
  PrecisePoints tangents; ///< unit; the sign carries no meaning
  std::vector<float> weights;
};

/// Points in a frame of their own, to which `frame` takes the scene's coordinates.
struct FramedPoints
{
  Eigen::Isometry3d frame = Eigen::Isometry3d::Identity();
  Points points;
};

/// The same of edge points.
struct FramedCloud
{
  Eigen::Isometry3d frame = Eigen::Isometry3d::Identity();
  PointCloud cloud;
};

/// The points of a scan as they lie in memory: x, y and z of each, mm.
template <typename Scalar>
struct ScanPoints
{
  const Scalar* xyz = nullptr;
  std::size_t count = 0;
  const std::uint8_t* flags = nullptr; ///< of each point; null: none has any
  std::uint8_t blanked = 0;            ///< flags of points that are left out
};

/// The points that are finite and not blanked, in their order, in a frame. The same for any number of threads.
Points toFrame(const ScanPoints<float>& scan, const Eigen::Isometry3d& frame, int threads = 1);
Points toFrame(const ScanPoints<double>& scan, const Eigen::Isometry3d& frame, int threads = 1);

/// The cloud in a frame; points that are not finite stay so.
PointCloud inFrame(const PreciseCloud& cloud, const Eigen::Isometry3d& frame, int threads = 1);

/// The cloud in its principal frame.
FramedCloud inOwnFrame(const PreciseCloud& cloud, int threads = 1);

/// Those of `count` points, x y z each, that are finite, in their principal frame. The same for any number of threads.
FramedPoints inOwnFrame(const float* xyz, std::size_t count, int threads = 1);
FramedPoints inOwnFrame(const double* xyz, std::size_t count, int threads = 1);
inline FramedPoints inOwnFrame(const Points& points, int threads = 1)
{
  return inOwnFrame(points.empty() ? nullptr : points.front().data(), points.size(), threads);
}
}
