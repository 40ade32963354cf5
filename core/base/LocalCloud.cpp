// SPDX-License-Identifier: BSD-3-Clause
#include "base/LocalCloud.h"

#include "base/AllVectors.h"
#include "base/Frames.h"
#include "base/Parallel.h"
#include "base/sequences/Sequences.h"

#include <algorithm>
#include <atomic>
#include <limits>
#include <numeric>
#include <utility>

namespace meam
{
namespace
{
/// Rounds what at(i) gives, in double precision, of each of `count` points.
template <typename At>
Points rounded(std::size_t count, int threads, At&& at)
{
  Points points(count);
  parallelForEach(static_cast<int>(count), threads, {},
    [&](int i) { points[i] = at(static_cast<std::size_t>(i)).template cast<float>(); });
  return points;
}

constexpr int ScanBlock = 512; // points that are taken to a frame together

/// How many of a block's points are finite and not blanked.
template <typename Scalar>
inline __attribute__((always_inline)) int countEach(
  const Scalar* xyz, const std::uint8_t* flags, std::uint8_t blanked, int count)
{
  constexpr Scalar infinity = std::numeric_limits<Scalar>::infinity();
  int number = 0;
#pragma omp simd reduction(+ : number)
  for (int k = 0; k < count; ++k)
  {
    const bool isFinite =
      (std::abs(xyz[3 * k]) < infinity) & (std::abs(xyz[3 * k + 1]) < infinity) & (std::abs(xyz[3 * k + 2]) < infinity);
    number += isFinite & ((flags[k] & blanked) == 0) ? 1 : 0;
  }
  return number;
}

/// A block's points after a transform, rounded.
struct Transformed
{
  float x[ScanBlock], y[ScanBlock], z[ScanBlock];
  int stays[ScanBlock]; ///< 1, or 0 for those that are not finite or are blanked
};

template <typename Scalar>
inline __attribute__((always_inline)) void transformEach(const Eigen::Matrix<double, 3, 4>& m, const Scalar* xyz,
  const std::uint8_t* flags, std::uint8_t blanked, int count, Transformed& to)
{
  constexpr float infinity = std::numeric_limits<float>::infinity();
  const double ux = m(0, 0), uy = m(0, 1), uz = m(0, 2), u0 = m(0, 3);
  const double vx = m(1, 0), vy = m(1, 1), vz = m(1, 2), v0 = m(1, 3);
  const double wx = m(2, 0), wy = m(2, 1), wz = m(2, 2), w0 = m(2, 3);
#pragma omp simd
  for (int k = 0; k < count; ++k)
  {
    const double x = xyz[3 * k], y = xyz[3 * k + 1], z = xyz[3 * k + 2];
    to.x[k] = static_cast<float>(ux * x + uy * y + uz * z + u0);
    to.y[k] = static_cast<float>(vx * x + vy * y + vz * z + v0);
    to.z[k] = static_cast<float>(wx * x + wy * y + wz * z + w0);
  }
#pragma omp simd
  for (int k = 0; k < count; ++k)
  {
    const bool isFinite =
      (std::abs(to.x[k]) < infinity) & (std::abs(to.y[k]) < infinity) & (std::abs(to.z[k]) < infinity);
    to.stays[k] = isFinite & ((flags[k] & blanked) == 0) ? 1 : 0;
  }
}

MEAM_ALL_VECTORS
int count(const float* xyz, const std::uint8_t* flags, std::uint8_t blanked, int size)
{
  return countEach(xyz, flags, blanked, size);
}

MEAM_ALL_VECTORS
int count(const double* xyz, const std::uint8_t* flags, std::uint8_t blanked, int size)
{
  return countEach(xyz, flags, blanked, size);
}

MEAM_ALL_VECTORS
void transform(const Eigen::Matrix<double, 3, 4>& m, const float* xyz, const std::uint8_t* flags, std::uint8_t blanked,
  int size, Transformed& to)
{
  transformEach(m, xyz, flags, blanked, size, to);
}

MEAM_ALL_VECTORS
void transform(const Eigen::Matrix<double, 3, 4>& m, const double* xyz, const std::uint8_t* flags, std::uint8_t blanked,
  int size, Transformed& to)
{
  transformEach(m, xyz, flags, blanked, size, to);
}

template <typename Scalar>
Points chosenInFrame(const ScanPoints<Scalar>& scan, const Eigen::Isometry3d& frame, int threads)
{
  static const std::uint8_t noFlags[ScanBlock] = {};
  const int blocks = static_cast<int>((scan.count + ScanBlock - 1) / ScanBlock);
  /// Calls work(block, coordinates, flags, number of points).
  const auto forEachBlock = [&](const auto& work)
  {
    parallelForEach(blocks, threads, {},
      [&](int block)
      {
        const std::size_t first = static_cast<std::size_t>(block) * ScanBlock;
        work(block, scan.xyz + 3 * first, scan.flags ? scan.flags + first : noFlags,
          static_cast<int>(std::min<std::size_t>(ScanBlock, scan.count - first)));
      });
  };
  std::vector<std::size_t> places(blocks + 1); // of each block's first point
  forEachBlock([&](int block, const Scalar* xyz, const std::uint8_t* flags, int size)
    { places[block + 1] = count(xyz, flags, scan.blanked, size); });
  std::partial_sum(places.begin(), places.end(), places.begin());
  const Eigen::Matrix<double, 3, 4> m = frame.matrix().topRows<3>();
  Points points(places.back());
  std::atomic<bool> isAnyLost{ false }; // beyond what single precision can tell
  forEachBlock(
    [&](int block, const Scalar* xyz, const std::uint8_t* flags, int size)
    {
      Transformed to;
      transform(m, xyz, flags, scan.blanked, size, to);
      Eigen::Vector3f staying[ScanBlock];
      std::size_t number = 0;
      for (int k = 0; k < size; ++k)
      {
        staying[number] = { to.x[k], to.y[k], to.z[k] };
        number += to.stays[k];
      }
      const std::size_t expected = places[block + 1] - places[block];
      std::fill(
        staying + number, staying + expected, Eigen::Vector3f::Constant(std::numeric_limits<float>::quiet_NaN()));
      std::copy_n(staying, expected, points.begin() + static_cast<std::ptrdiff_t>(places[block]));
      if (number < expected)
      {
        isAnyLost = true;
      }
    });
  if (isAnyLost)
  {
    const auto isLost = [](const Eigen::Vector3f& point) { return !point.allFinite(); };
    eraseIf(points, isLost);
  }
  return points;
}

PrecisePoints precise(const Points& points)
{
  return mapped<Eigen::Vector3d>(
    points, [&](const Eigen::Vector3f& point) -> Eigen::Vector3d { return point.cast<double>(); });
}
}

LocalCloud toLocalCloud(const PrecisePoints& points, const PrecisePoints& tangents, std::vector<float> weights,
  const Eigen::Isometry3d& T_local_scene, int threads)
{
  LocalCloud local;
  local.T_local_scene = T_local_scene;
  local.cloud.points =
    rounded(points.size(), threads, [&](std::size_t i) -> Eigen::Vector3d { return T_local_scene * points[i]; });
  local.cloud.tangents = rounded(
    tangents.size(), threads, [&](std::size_t i) -> Eigen::Vector3d { return T_local_scene.linear() * tangents[i]; });
  local.cloud.weights = std::move(weights);
  return local;
}

LocalCloud toLocalCloud(const PointCloud& cloud, int threads)
{
  const PrecisePoints points = precise(cloud.points);
  return toLocalCloud(points, precise(cloud.tangents), cloud.weights, principalFrame(points), threads);
}

Points toLocalPoints(const ScanPoints<float>& scan, const Eigen::Isometry3d& T_local_scene, int threads)
{
  return chosenInFrame(scan, T_local_scene, threads);
}

Points toLocalPoints(const ScanPoints<double>& scan, const Eigen::Isometry3d& T_local_scene, int threads)
{
  return chosenInFrame(scan, T_local_scene, threads);
}
}
