// SPDX-License-Identifier: BSD-3-Clause
#include "model/VisibilityExtraction.h"

#include "mesh/ConvexHull.h"
#include "model/Viewpoints.h"

#include <algorithm>
#include <cmath>

namespace meam
{
std::vector<int> visiblePoints(const Points& points, const Eigen::Vector3d& viewpoint, double radiusFactor)
{
  double farthest = 0.0;
  for (const auto& point : points)
  {
    farthest = std::max(farthest, (point.cast<double>() - viewpoint).norm());
  }
  const double radius = radiusFactor * farthest;
  std::vector<Eigen::Vector3d> flipped;
  flipped.reserve(points.size() + 1);
  for (const auto& point : points)
  {
    const Eigen::Vector3d ray = point.cast<double>() - viewpoint;
    const double length = ray.norm();
    flipped.push_back(length > 0.0 ? (ray + 2.0 * (radius - length) / length * ray).eval() : ray);
  }
  flipped.push_back(Eigen::Vector3d::Zero()); // the viewpoint itself
  std::vector<int> corners = convexHullCorners(flipped);
  if (!corners.empty() && corners.back() == static_cast<int>(points.size()))
  {
    corners.pop_back();
  }
  return corners;
}

std::vector<AppearanceModel> extractVisibility(
  const PointCloud& surface, const VisibilityExtractionSettings& settings, const Progress& progress)
{
  requirePoints(surface.points, "The part's surface");
  const Points directions = viewDirections(settings.viewpoints);
  const Eigen::Vector3d middle = bounds(surface.points).center().cast<double>();
  const double distance = settings.viewpointDistance * diameter(surface.points);
  const int views = static_cast<int>(directions.size());
  std::vector<AppearanceModel> models(views);
  for (int view = 0; view < views; ++view)
  {
    report(progress, static_cast<double>(view) / views);
    const Eigen::Vector3d viewpoint = middle + distance * directions[view].cast<double>();
    models[view].name = "View " + std::to_string(view);
    models[view].direction = directions[view];
    models[view].cloud = surface.subset(visiblePoints(surface.points, viewpoint, settings.radiusFactor));
  }
  report(progress, 1.0);
  return models;
}
}
