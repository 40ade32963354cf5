// SPDX-License-Identifier: BSD-3-Clause
// Organized clouds of simple surfaces.
#pragma once

#include "base/Random.h"
#include "scene/OrganizedCloud.h"

#include <cmath>
#include <functional>
#include <limits>

namespace grids
{
/// x = column, y = row, 1 mm apart; z by a function of them, NaN where it is NaN.
inline meam::OrganizedCloud surface(int width, int height, const std::function<double(int, int)>& z, double noise = 0.0)
{
  meam::OrganizedCloud cloud;
  cloud.width = width;
  cloud.height = height;
  meam::Random random(3);
  for (int row = 0; row < height; ++row)
  {
    for (int column = 0; column < width; ++column)
    {
      const double depth = z(column, row) + (noise > 0.0 ? noise * random.normal() : 0.0);
      cloud.points.emplace_back(column, row, depth);
      if (std::isnan(depth))
      {
        cloud.points.back().setConstant(std::numeric_limits<float>::quiet_NaN());
      }
    }
  }
  return cloud;
}
}
