// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "scene/OrganizedCloud.h"

#include <optional>

namespace meam
{
/// Where the sensor of an organized cloud is in the cloud's frame, such as a robot's.
struct ResectedSensor
{
  Eigen::Isometry3d T_sensor_scan = Eigen::Isometry3d::Identity(); ///< mm, to its frame: columns go along x, z forward
  bool isMirrored = false;                                         ///< rows go against y
};

/// By the projection that takes the points to their pixels best (direct linear transformation; Hartley and Zisserman,
/// Multiple View Geometry, Section 7.1). None of points in a plane, of an orthographic sensor, and where pixels are off
/// by more than lenses make them.
std::optional<ResectedSensor> resectSensor(const OrganizedCloud& cloud);
}
