// SPDX-License-Identifier: BSD-3-Clause
#include "scene/preparation/CloudOrganization.h"

#include "scene/preparation/PointRaster.h"

#include <cmath>

namespace meam
{
namespace
{
constexpr std::int64_t MostPixels = 1 << 26; // of a sensor, a limit of memory

/// For each pixel the point that it sees, or -1.
std::vector<int> seenPoints(const Points& points, const Camera& camera, const Progress& progress)
{
  std::vector<int> seen(static_cast<std::size_t>(camera.width) * camera.height, -1);
  const auto depth = [&](int point) { return (camera.T_camera_scene * points[point].cast<double>()).z(); };
  bool any = false;
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    const Eigen::Vector2d pixel = project(camera, points[i].cast<double>());
    const double column = std::round(pixel.x());
    const double row = std::round(pixel.y());
    if (column >= 0.0 && column < camera.width && row >= 0.0 && row < camera.height)
    {
      int& best = seen[static_cast<std::size_t>(row) * camera.width + static_cast<std::size_t>(column)];
      if (best < 0 || depth(static_cast<int>(i)) < depth(best))
      {
        best = static_cast<int>(i);
        any = true;
      }
    }
    reportStep(progress, i, 0.8 * static_cast<double>(i) / static_cast<double>(points.size()));
  }
  if (!any)
  {
    throw Error("The camera sees no point of the cloud: its focal lengths, size or place, or the cloud's unit or frame "
                "are others than those of the scan.");
  }
  return seen;
}
}

MeasuredCloud organizeCloud(const MeasuredCloud& points, const Camera& camera, const Progress& progress)
{
  requireCamera(camera);
  if (points.cloud.height > 1)
  {
    throw Error("The scan is a grid of " + std::to_string(points.cloud.width) + " x " +
                std::to_string(points.cloud.height) +
                " points already: leave the camera away, which brings points that are not organized onto its pixels.");
  }
  if (camera.width < 1 || camera.height < 1 || static_cast<std::int64_t>(camera.width) * camera.height > MostPixels)
  {
    throw Error("The camera's width and height in pixels have to be given to organize a cloud: no more than 67 million "
                "pixels.");
  }
  report(progress, 0.0);
  const std::vector<int> seen = seenPoints(points.cloud.points, camera, progress);
  const Eigen::Isometry3f T_camera_scene = camera.T_camera_scene.cast<float>();
  MeasuredCloud result;
  result.cloud.width = camera.width;
  result.cloud.height = camera.height;
  result.cloud.points.assign(seen.size(), Eigen::Vector3f::Constant(NAN));
  result.normals.assign(points.normals.empty() ? 0 : seen.size(), Eigen::Vector3f::Constant(NAN));
  for (std::size_t pixel = 0; pixel < seen.size(); ++pixel)
  {
    if (seen[pixel] >= 0)
    {
      result.cloud.points[pixel] = T_camera_scene * points.cloud.points[seen[pixel]];
      if (!points.normals.empty())
      {
        result.normals[pixel] = T_camera_scene.linear() * points.normals[seen[pixel]];
      }
    }
  }
  report(progress, 0.9);
  if (!points.intensities.empty() || !points.colors.empty())
  {
    for (const int point : nearestPoints(seen, camera.width))
    {
      if (!points.intensities.empty())
      {
        result.intensities.push_back(points.intensities[point]);
      }
      if (!points.colors.empty())
      {
        const auto color = points.colors.begin() + 3 * static_cast<std::ptrdiff_t>(point);
        result.colors.insert(result.colors.end(), color, color + 3);
      }
    }
  }
  report(progress, 1.0);
  return result;
}
}
