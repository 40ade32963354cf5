// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "scene/depth/DepthMap.h"

#include <Eigen/Geometry>

#include <vector>

namespace meam
{
using Plane = Eigen::Hyperplane<float, 3>;

struct PlaneFit
{
  Plane plane;         ///< its normal towards the sensor
  double extent = 0.0; ///< mm, of the points along the plane, when they are spread evenly
};

/// The plane with the least sum of squared distances from three points or more, mm.
PlaneFit fitPlane(const Points& points, const Sensor& sensor);

/// The bin's floor and walls: large planes behind which next to nothing was measured, the one with the most points
/// first. A part cannot be there. `tolerance` in mm from a plane. Empty where none is in sight.
std::vector<Plane> enclosingPlanes(const DepthMap& depth, const Sensor& sensor, double tolerance, double partDiameter);
}
