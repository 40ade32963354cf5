// SPDX-License-Identifier: BSD-3-Clause
// Cameras, and organized clouds of simple surfaces.
#pragma once

#include "base/Random.h"
#include "scene/Camera.h"
#include "scene/OrganizedCloud.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>

namespace grids
{
/// Without a lens, with pixels that are square.
inline meam::Camera camera(int width, int height, double focal, double cx, double cy)
{
  meam::Camera result;
  result.width = width;
  result.height = height;
  result.fx = result.fy = focal;
  result.cx = cx;
  result.cy = cy;
  return result;
}

/// The point at(column, row) in each pixel; NaN where one of its coordinates is.
inline meam::OrganizedCloud grid(int width, int height, const std::function<Eigen::Vector3d(int, int)>& at)
{
  meam::OrganizedCloud cloud{ width, height, {} };
  for (int row = 0; row < height; ++row)
  {
    for (int column = 0; column < width; ++column)
    {
      const Eigen::Vector3f point = at(column, row).cast<float>();
      cloud.points.push_back(
        point.array().isNaN().any() ? Eigen::Vector3f::Constant(std::numeric_limits<float>::quiet_NaN()) : point);
    }
  }
  return cloud;
}

/// x = column, y = row, 1 mm apart; z by a function of them.
inline meam::OrganizedCloud surface(int width, int height, const std::function<double(int, int)>& z, double noise = 0.0)
{
  meam::Random random(3);
  return grid(width, height,
    [&](int column, int row)
    { return Eigen::Vector3d(column, row, z(column, row) + (noise > 0.0 ? noise * random.normal() : 0.0)); });
}

/// 1 mm apart about the z axis; z by a function of x and y.
inline meam::OrganizedCloud centered(int width, int height, const std::function<double(double, double)>& z)
{
  return grid(width, height,
    [&](int column, int row)
    {
      const double x = column - 0.5 * (width - 1), y = row - 0.5 * (height - 1);
      return Eigen::Vector3d(x, y, z(x, y));
    });
}

/// What a sensor measures of a depth that is known in each of its pixels.
inline meam::OrganizedCloud measured(const meam::Camera& sensor, const std::function<double(int, int)>& depth)
{
  return grid(sensor.width, sensor.height,
    [&](int column, int row) { return meam::unproject(sensor, Eigen::Vector2d(column, row), depth(column, row)); });
}
}
