// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/PointGrid.h"
#include "scene/Sensor.h"

namespace meam
{
/// Unit normals, towards the sensor, of the planes that fit a measured surface best about some of its points (PCL:
/// principal components of the neighbourhood; Rusu 2010); zero where too little was measured. `surface`: grid of all
/// points of the surface, `points`. The same for any number of threads.
Points estimateNormals(const Points& points, const PointGrid& surface, const std::vector<int>& indices,
  const Sensor& sensor, double partDiameter, int threads = 0);
}
