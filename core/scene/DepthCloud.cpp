// SPDX-License-Identifier: BSD-3-Clause
#include "scene/DepthCloud.h"

#include "scene/Units.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>

namespace meam
{
namespace
{
constexpr double FarthestDepth = 50.0 * Metre; // mm; beyond it no sensor for bins measures

std::string sizeOf(int width, int height) { return std::to_string(width) + " x " + std::to_string(height); }
}

OrganizedCloud cloudOfDepths(const std::vector<float>& depths, int width, int height, const Camera& camera,
  double scale, const std::string& what, const Progress& progress)
{
  requireCamera(camera);
  if (!(scale > 0.0) || !std::isfinite(scale))
  {
    throw Error("The depth scale, mm for a value of 1 in the depth image, must be a positive number.");
  }
  if (width < 1 || height < 1 || depths.size() != static_cast<std::size_t>(width) * height)
  {
    throw Error(what + " has " + std::to_string(depths.size()) + " values for " + sizeOf(width, height) + " pixels.");
  }
  if ((camera.width > 0 && camera.width != width) || (camera.height > 0 && camera.height != height))
  {
    throw Error(what + " has " + sizeOf(width, height) + " pixels, but its camera has " +
                sizeOf(camera.width, camera.height) + ": the calibration is of another camera.");
  }
  Camera sensor = camera;
  sensor.T_camera_scene.setIdentity();
  OrganizedCloud cloud;
  cloud.width = width;
  cloud.height = height;
  cloud.points.assign(depths.size(), Eigen::Vector3f::Constant(std::numeric_limits<float>::quiet_NaN()));
  double nearest = std::numeric_limits<double>::infinity();
  for (int row = 0, i = 0; row < height; ++row)
  {
    for (int column = 0; column < width; ++column, ++i)
    {
      if (std::isfinite(depths[i]) && depths[i] > 0.0f)
      {
        const double depth = scale * depths[i];
        cloud.points[i] = unproject(sensor, Eigen::Vector2d(column, row), depth).cast<float>();
        nearest = std::min(nearest, depth);
      }
    }
    if (row % 64 == 0)
    {
      report(progress, static_cast<double>(row) / height);
    }
  }
  if (nearest > FarthestDepth && std::isfinite(nearest))
  {
    char told[128];
    std::snprintf(told, sizeof told, "%.4g m, with a depth scale of %.6g mm for a value of 1", nearest / Metre, scale);
    throw Error(what + " has nothing nearer than " + told +
                ": correct depth_scale in its calibration, or the depth scale that was given (--depth-scale).");
  }
  report(progress, 1.0);
  return cloud;
}
}
