// SPDX-License-Identifier: BSD-3-Clause
#include "scene/preparation/CloudOrganization.h"

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

/// For each pixel the point of the nearest pixel that has one, counted in steps to the four neighbours.
std::vector<int> nearestPoints(std::vector<int> seen, int width)
{
  const int height = static_cast<int>(seen.size()) / width;
  std::vector<int> front;
  for (int pixel = 0; pixel < static_cast<int>(seen.size()); ++pixel)
  {
    if (seen[pixel] >= 0)
    {
      front.push_back(pixel);
    }
  }
  for (std::size_t i = 0; i < front.size(); ++i)
  {
    const int pixel = front[i];
    const int column = pixel % width;
    const int row = pixel / width;
    const std::pair<bool, int> neighbours[] = { { column > 0, pixel - 1 }, { column + 1 < width, pixel + 1 },
      { row > 0, pixel - width }, { row + 1 < height, pixel + width } };
    for (const auto& [inside, neighbour] : neighbours)
    {
      if (inside && seen[neighbour] < 0)
      {
        seen[neighbour] = seen[pixel];
        front.push_back(neighbour);
      }
    }
  }
  return seen;
}
}

MeasuredCloud organizeCloud(const MeasuredCloud& points, const Camera& camera, const Progress& progress)
{
  requireCamera(camera);
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
