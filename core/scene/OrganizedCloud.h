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

/// The points of every `step`th row and column that have depth.
inline Points everyNth(const OrganizedCloud& cloud, int step)
{
  Points points;
  for (int row = 0; row < cloud.height; row += step)
  {
    for (int column = 0; column < cloud.width; column += step)
    {
      const Eigen::Vector3f& point = cloud.points[static_cast<std::size_t>(row) * cloud.width + column];
      if (point.allFinite())
      {
        points.push_back(point);
      }
    }
  }
  return points;
}
}
