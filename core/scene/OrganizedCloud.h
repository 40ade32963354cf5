// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/PointCloud.h"

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

/// An 8 bit image, row by row from the top left; 1 channel (grey) or 3 (red, green, blue).
struct Image
{
  int width = 0;
  int height = 0;
  int channels = 1;
  std::vector<std::uint8_t> pixels;
};
}
