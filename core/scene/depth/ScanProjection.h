// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/PointCloud.h"
#include "scene/Sensor.h"

#include <Eigen/Geometry>

#include <cstdint>
#include <vector>

namespace meam
{
/// What a sensor measured, along its lines of sight: what every depth map of a scan has to know of it.
class ScanProjection
{
public:
  /// `scan` has to outlive the projection. The same for any number of threads.
  ScanProjection(const Points& scan, const Sensor& sensor, int threads = 1);

  static constexpr int RunLength = 64; ///< points looked at together; a longer run comes to more cells of a map
  /// Points of the scan that follow each other, and the rectangle across the lines of sight that they come to; not
  /// ordered, of a run of which nothing is seen.
  struct Run
  {
    int begin, end;
    Eigen::Array2f low, high;
  };
  const std::vector<Run>& runs() const { return this->Runs; }

  /// Coordinates on the axes of a run's points, divided by the depth when the sensor is perspective. Not numbers where
  /// it cannot have seen anything.
  struct RunPoints
  {
    float u[RunLength], v[RunLength], depth[RunLength];
  };
  void project(const Run& run, RunPoints& points) const;
  const Points& scan() const { return this->Scan; }
  bool isPerspective() const { return this->IsPerspective; }
  const Eigen::Vector3f& eye() const { return this->Eye; }   ///< the sensor's position, or anywhere
  const Eigen::Matrix3f& axes() const { return this->Axes; } ///< rows: right, down, depth

  std::int64_t count() const { return this->Count; }           ///< of the points seen
  double depths() const { return this->Depths; }               ///< of these, their sum, mm
  const Eigen::AlignedBox3f& box() const { return this->Box; } ///< of these, on the axes
  /// All points on the axes.
  Points projected() const;

private:
  const Points& Scan;
  bool IsPerspective;
  Eigen::Vector3f Eye;
  Eigen::Matrix3f Axes;
  std::vector<Run> Runs;
  Eigen::AlignedBox3f Box;
  double Depths = 0.0;
  std::int64_t Count = 0;
};
}
