// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "scene/OrganizedCloud.h"

#include <optional>
#include <vector>

namespace meam
{
/// A point of an organized cloud with its place on the grid.
struct GridSample
{
  Eigen::Vector3d point;
  Eigen::Vector2d pixel; ///< in widths of the grid, from its middle
};

/// Some points, spread evenly. Those that several pixels share are left out: they stand for none.
std::vector<GridSample> samplesOf(const OrganizedCloud& cloud);

/// Where the sensor of an organized cloud is in the cloud's frame, such as a robot's.
struct ResectedSensor
{
  Eigen::Isometry3d T_sensor_scan = Eigen::Isometry3d::Identity(); ///< mm, to its frame: columns go along x, z forward
  bool perspective = true;
  bool isMirrored = false; ///< rows go against y; which way an orthographic sensor looks is chosen so that they do not
  double off = 0.0;        ///< widths of the grid that points are off their pixels, root mean square
};

/// By the projection that takes the points to their pixels best: that of a pinhole camera (direct linear
/// transformation; Hartley and Zisserman, Multiple View Geometry, Section 7.1), or an orthographic one where it fits as
/// well. None of points in a plane, and where pixels are off by more than lenses make them.
std::optional<ResectedSensor> resectSensor(const std::vector<GridSample>& samples, int width);
}
