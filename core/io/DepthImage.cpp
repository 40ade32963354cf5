// SPDX-License-Identifier: BSD-3-Clause
#include "io/DepthImage.h"

#include "io/ImageFile.h"
#include "scene/Units.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace meam
{
namespace
{
constexpr double FarthestDepth = 50.0 * Metre; // mm; beyond it no sensor for bins measures
}

OrganizedCloud readDepthImage(
  const std::string& path, const Camera& camera, double depthScale, const Progress& progress)
{
  requireCamera(camera);
  if (!(depthScale > 0.0) || !std::isfinite(depthScale))
  {
    throw Error("The depth scale, mm for a value of 1 in the depth image, must be a positive number.");
  }
  report(progress, 0.0);
  const DepthPixels depths = readDepthPixels(path);
  report(progress, 0.5);
  if ((camera.width > 0 && camera.width != depths.width) || (camera.height > 0 && camera.height != depths.height))
  {
    throw Error("The depth image '" + path + "' has " + std::to_string(depths.width) + " x " +
                std::to_string(depths.height) + " pixels, but its camera has " + std::to_string(camera.width) + " x " +
                std::to_string(camera.height) + ": the calibration is of another camera.");
  }

  Camera sensor = camera;
  sensor.T_camera_scene.setIdentity();
  OrganizedCloud cloud;
  cloud.width = depths.width;
  cloud.height = depths.height;
  cloud.points.assign(depths.pixels.size(), Eigen::Vector3f::Constant(NAN));
  double nearest = INFINITY;
  for (int row = 0, i = 0; row < depths.height; ++row)
  {
    for (int column = 0; column < depths.width; ++column, ++i)
    {
      if (std::isfinite(depths.pixels[i]))
      {
        const double depth = depthScale * depths.pixels[i];
        cloud.points[i] = unproject(sensor, Eigen::Vector2d(column, row), depth).cast<float>();
        nearest = std::min(nearest, depth);
      }
    }
    if (row % 64 == 0)
    {
      report(progress, 0.5 + 0.5 * row / depths.height);
    }
  }
  if (nearest > FarthestDepth && std::isfinite(nearest))
  {
    char told[128];
    std::snprintf(
      told, sizeof told, "%.4g m, with a depth scale of %.6g mm for a value of 1", nearest / Metre, depthScale);
    throw Error("The depth image '" + path + "' has nothing nearer than " + told +
                ": correct depth_scale in its calibration, or --depth-scale.");
  }
  report(progress, 1.0);
  return cloud;
}
}
