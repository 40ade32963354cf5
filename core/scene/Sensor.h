// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Geometry.h"

namespace meam
{
/// Where the scene is seen from, in scene coordinates (mm).
struct Sensor
{
  bool perspective = true;
  Eigen::Vector3f position = Eigen::Vector3f::Zero();   ///< of the sensor, perspective only
  Eigen::Vector3f direction = Eigen::Vector3f::UnitZ(); ///< unit, the way it looks

  /// Unit vector from `point` towards the sensor.
  Eigen::Vector3f towards(const Eigen::Vector3f& point) const
  {
    return this->perspective ? (this->position - point).normalized() : Eigen::Vector3f(-this->direction);
  }
};
}
