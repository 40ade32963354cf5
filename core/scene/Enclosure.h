// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "scene/DepthMap.h"

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

struct EnclosureSettings
{
  int mostPlanes = 5;         ///< a floor and four walls
  int samples = 1500;         ///< measured points that are looked at, spread evenly
  int seeds = 150;            ///< of them, whose planes are tried
  double leastShare = 0.05;   ///< of the points that lie on a plane
  double mostBehind = 0.01;   ///< of the points: wrong ones
  double behind = 2.0;        ///< times the tolerance from a plane: farther is behind it
  double leastExtent = 1.5;   ///< of the part's diameter: a smaller plane may be a part's own
  double seedTolerance = 2.0; ///< times the tolerance: the normal at one point is not exact
  int fits = 3;               ///< of a plane to the points near it
};

/// The bin's floor and walls: large planes behind which next to nothing was measured, the one with the most points
/// first. A part cannot be there. `tolerance` in mm from a plane. Empty where none is in sight.
std::vector<Plane> enclosingPlanes(const DepthMap& depth, const Sensor& sensor, double tolerance, double partDiameter,
  const EnclosureSettings& settings = {});
}
