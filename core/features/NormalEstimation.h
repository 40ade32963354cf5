// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/PointGrid.h"
#include "scene/Sensor.h"

namespace meam
{
/// Normals of a measured surface.
struct SurfaceNormals
{
  Points normals;                ///< unit, towards the sensor; zero where too little was measured
  std::vector<float> curvatures; ///< surface variation, [0, 1/3]: smallest eigenvalue over the sum of all; 0 of a plane
};

struct NormalEstimationSettings
{
  double radius = 0.06;     ///< of the neighbourhood, share of the part's diameter
  int fewestNeighbours = 6; ///< with fewer there is no normal
  int threads = 0;          ///< 0: one for each processor
};

/// Normals of the planes that fit the surface about some of its points best (PCL: principal components of the
/// neighbourhood; Rusu 2010). `surface`: grid of all points of the surface, `points`. The same for any number of
/// threads.
SurfaceNormals estimateNormals(const Points& points, const PointGrid& surface, const std::vector<int>& indices,
  const Sensor& sensor, double partDiameter, const NormalEstimationSettings& settings = {});
}
