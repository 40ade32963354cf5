// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>

namespace meam
{
/// Where the scene is seen from, in scene coordinates (mm).
struct Sensor
{
  bool perspective = true;
  Eigen::Vector3d position = Eigen::Vector3d::Zero();   ///< of the sensor, perspective only
  Eigen::Vector3d direction = Eigen::Vector3d::UnitZ(); ///< unit, the way it looks

  /// Unit vector from `point` towards the sensor.
  Eigen::Vector3d towards(const Eigen::Vector3d& point) const
  {
    return this->perspective ? (this->position - point).normalized() : Eigen::Vector3d(-this->direction);
  }
};
}
