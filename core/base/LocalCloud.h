// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/PointCloud.h"

#include <cstdint>

namespace meam
{
/// A cloud with an origin of its own: single precision in a local frame that moves with the points, so that a scene in
/// a robot's coordinates loses nothing, and a scene that is moved in double precision is the same scene there.
struct LocalCloud
{
  Eigen::Isometry3d T_local_scene = Eigen::Isometry3d::Identity(); ///< takes the scene's coordinates to the cloud's
  PointCloud cloud;                                                ///< mm; invalid points are not finite
  /// Edge points: found in a scan, by its image or its depth, not an exact boundary from elsewhere. Many are of no part
  /// then, and some are displaced.
  bool fromScan = false;
};

/// Edge points in double precision (mm) in a frame, with `tangents` (unit) and `weights`, which are empty or as many.
/// The same for any number of threads; 0: one for each processor.
LocalCloud toLocalCloud(const PrecisePoints& points, const PrecisePoints& tangents, std::vector<float> weights,
  const Eigen::Isometry3d& T_local_scene, int threads = 1);

/// The cloud in its principal frame, with its tangents and weights.
LocalCloud toLocalCloud(const PointCloud& cloud, int threads = 1);

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
Points toLocalPoints(const ScanPoints<float>& scan, const Eigen::Isometry3d& T_local_scene, int threads = 1);
Points toLocalPoints(const ScanPoints<double>& scan, const Eigen::Isometry3d& T_local_scene, int threads = 1);
inline Points toLocalPoints(const Points& points, const Eigen::Isometry3d& T_local_scene, int threads = 1)
{
  return toLocalPoints(
    ScanPoints<float>{ points.empty() ? nullptr : points.front().data(), points.size() }, T_local_scene, threads);
}
}
