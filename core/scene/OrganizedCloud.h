// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/PointCloud.h"
#include "scene/Image.h"

namespace meam
{
/// A sensor's depth grid: width x height points, row by row from the top left, NaN where there is no
/// depth. Millimetres in the sensor's frame: x right, y down, z the way it looks.
struct OrganizedCloud
{
  int width = 0;
  int height = 0;
  Points points;

  std::size_t size() const { return this->points.size(); }
};
}
