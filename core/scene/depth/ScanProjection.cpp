// SPDX-License-Identifier: BSD-3-Clause
#include "scene/depth/ScanProjection.h"

#include "base/AllVectors.h"
#include "base/Frames.h"
#include "base/Parallel.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace meam
{
namespace
{
constexpr int RunLength = ScanProjection::RunLength; // a name for it
using RunPoints = ScanProjection::RunPoints;

RunPoints nothingSeen()
{
  RunPoints points;
  for (float* values : { points.u, points.v, points.depth })
  {
    std::fill_n(values, RunLength, std::numeric_limits<float>::quiet_NaN());
  }
  return points;
}

MEAM_ALL_VECTORS
void projectPoints(const Eigen::Matrix3f& m, const Eigen::Vector3f& eye, bool perspective, const float* xyz, int count,
  RunPoints& points)
{
  constexpr float infinity = std::numeric_limits<float>::infinity(), none = std::numeric_limits<float>::quiet_NaN();
  const float ux = m(0, 0), uy = m(0, 1), uz = m(0, 2);
  const float vx = m(1, 0), vy = m(1, 1), vz = m(1, 2);
  const float wx = m(2, 0), wy = m(2, 1), wz = m(2, 2);
  const float eyeX = eye.x(), eyeY = eye.y(), eyeZ = eye.z();
  const float slope = perspective ? 1.0f : 0.0f, parallel = 1.0f - slope;
#pragma omp simd
  for (int k = 0; k < count; ++k)
  {
    const float x = xyz[3 * k] - eyeX, y = xyz[3 * k + 1] - eyeY, z = xyz[3 * k + 2] - eyeZ;
    const float depth = wx * x + (wy * y + wz * z);
    const float ahead = slope * depth + parallel;
    const float u = (ux * x + (uy * y + uz * z)) / ahead;
    const float v = (vx * x + (vy * y + vz * z)) / ahead;
    const bool isSeen =
      (std::abs(u) < infinity) & (std::abs(v) < infinity) & (std::abs(depth) < infinity) & (ahead > 0.0f);
    points.u[k] = isSeen ? u : none;
    points.v[k] = isSeen ? v : none;
    points.depth[k] = isSeen ? depth : none;
  }
}

/// What is known of points on the axes, lane by lane.
struct Extent
{
  float low[3][PointLanes], high[3][PointLanes];
  double depths[PointLanes]; ///< their sum
  double counts[PointLanes];
};

Extent nowhere()
{
  Extent extent{};
  std::fill_n(extent.low[0], 3 * PointLanes, std::numeric_limits<float>::infinity());
  std::fill_n(extent.high[0], 3 * PointLanes, -std::numeric_limits<float>::infinity());
  return extent;
}

inline __attribute__((always_inline)) void extend(const float* values, float* low, float* high)
{
#pragma omp simd
  for (int k = 0; k < PointLanes; ++k)
  {
    low[k] = values[k] < low[k] ? values[k] : low[k]; // false for no numbers
    high[k] = values[k] > high[k] ? values[k] : high[k];
  }
}

MEAM_ALL_VECTORS
void extend(const RunPoints& points, int count, Extent& extent)
{
  Extent result = extent;
  for (int begin = 0; begin < count; begin += PointLanes)
  {
    extend(points.u + begin, result.low[0], result.high[0]);
    extend(points.v + begin, result.low[1], result.high[1]);
    extend(points.depth + begin, result.low[2], result.high[2]);
#pragma omp simd
    for (int k = 0; k < PointLanes; ++k)
    {
      const float depth = points.depth[begin + k];
      const bool isSeen = depth == depth;
      result.depths[k] += isSeen ? static_cast<double>(depth) : 0.0;
      result.counts[k] += isSeen ? 1.0 : 0.0;
    }
  }
  extent = result;
}
}

ScanProjection::ScanProjection(const Points& scan, const Sensor& sensor, int threads)
  : Scan(scan)
  , IsPerspective(sensor.perspective)
  , Eye(sensor.perspective ? sensor.position.cast<float>().eval() : Eigen::Vector3f::Zero().eval())
{
  const Eigen::Vector3f direction = sensor.direction.cast<float>();
  const Eigen::Vector3f across = Eigen::Vector3f::UnitX() - direction.x() * direction;
  const Eigen::Matrix3f frame = frameAround(direction);
  const Eigen::Vector3f right = across.norm() > 1e-3f ? across.normalized() : Eigen::Vector3f(frame.col(1));
  this->Axes.row(0) = right;
  this->Axes.row(1) = direction.cross(right);
  this->Axes.row(2) = direction;
  const int size = static_cast<int>(scan.size());
  this->Runs.resize((size + RunLength - 1) / RunLength);
  struct Summary // of what comes together to one sum, whatever the number of threads
  {
    Eigen::AlignedBox3f box;
    double depths = 0.0;
    std::int64_t count = 0;
  };
  std::vector<Summary> summaries(this->Runs.size());
  parallelForEach(static_cast<int>(this->Runs.size()), threads, {},
    [&](int i)
    {
      Run& run = this->Runs[i];
      run.begin = i * RunLength;
      run.end = std::min(size, run.begin + RunLength);
      RunPoints points;
      if (run.end - run.begin < RunLength)
      {
        points = nothingSeen();
      }
      this->project(run, points);
      Extent extent = nowhere();
      extend(points, RunLength, extent);
      Summary& summary = summaries[i];
      for (int axis = 0; axis < 3; ++axis)
      {
        summary.box.min()[axis] = *std::min_element(extent.low[axis], extent.low[axis] + PointLanes);
        summary.box.max()[axis] = *std::max_element(extent.high[axis], extent.high[axis] + PointLanes);
      }
      summary.depths = std::accumulate(extent.depths, extent.depths + PointLanes, 0.0);
      summary.count = static_cast<std::int64_t>(std::accumulate(extent.counts, extent.counts + PointLanes, 0.0));
      run.low = summary.box.min().head<2>();
      run.high = summary.box.max().head<2>();
    });
  for (const Summary& summary : summaries)
  {
    if (summary.count > 0)
    {
      this->Box.extend(summary.box);
    }
    this->Depths += summary.depths;
    this->Count += summary.count;
  }
}

void ScanProjection::project(const Run& run, RunPoints& points) const
{
  projectPoints(this->Axes, this->Eye, this->IsPerspective, this->Scan[run.begin].data(), run.end - run.begin, points);
}

Points ScanProjection::projected() const
{
  Points points;
  points.reserve(this->Scan.size());
  for (const Run& run : this->Runs)
  {
    RunPoints some;
    this->project(run, some);
    for (int k = 0; k < run.end - run.begin; ++k)
    {
      points.emplace_back(some.u[k], some.v[k], some.depth[k]);
    }
  }
  return points;
}
}
