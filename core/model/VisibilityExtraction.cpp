// SPDX-License-Identifier: BSD-3-Clause
#include "model/VisibilityExtraction.h"

#include "base/Bounds.h"
#include "base/Parallel.h"
#include "base/sequences/Sequences.h"
#include "mesh/ConvexHull.h"
#include "mesh/LineOfSight.h"
#include "mesh/TriangleMesh.h"
#include "mesh/Viewpoints.h"
#include "model/AppearanceModel.h"

#include <algorithm>

namespace meam
{
namespace
{
/// What MeshVisibility asks; null for the method that does without.
std::unique_ptr<const LineOfSight> sightOf(
  const PointCloud& surface, const VisibilityExtractionSettings& settings, const TriangleMesh* mesh)
{
  if (settings.method == VisibilityMethod::HiddenPointRemoval)
  {
    return nullptr;
  }
  if (!mesh)
  {
    throw Error("Mesh visibility needs the mesh: connect the prepared mesh that the surface was sampled from, or use "
                "hidden point removal.");
  }
  if (surface.normals.size() != surface.size())
  {
    throw Error("The part's surface has no normals: sample the surface of a mesh first.");
  }
  auto sight = std::make_unique<const LineOfSight>(*mesh);
  requireSamplesOf(*mesh, surface.points);
  return sight;
}

/// The model of the paper's comparison "without MEAM" (Table 6).
AppearanceModel wholePart(const PointCloud& surface)
{
  AppearanceModel model;
  model.name = "Whole part";
  model.cloud = surface;
  model.wholePart = true;
  return model;
}

void turnTowards(PointCloud& cloud, const Eigen::Vector3f& viewpoint)
{
  for (std::size_t i = 0; i < cloud.size(); ++i)
  {
    if (cloud.normals[i].dot(viewpoint - cloud.points[i]) < 0.0f)
    {
      cloud.normals[i] = -cloud.normals[i];
    }
  }
}
}

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

std::vector<int> visiblePoints(
  const PointCloud& surface, const Eigen::Vector3d& viewpoint, const LineOfSight& sight, const Progress& progress)
{
  const int count = static_cast<int>(surface.size());
  std::vector<char> seen(surface.size());
  parallelForEach(count, 0, progress,
    [&](int i)
    { seen[i] = sight.isSeen(surface.points[i].cast<double>(), surface.normals[i].cast<double>(), viewpoint); });
  return indicesWhere(count, [&](int i) { return seen[i]; });
}

std::vector<AppearanceModel> extractVisibility(const PointCloud& surface, const VisibilityExtractionSettings& settings,
  const TriangleMesh* mesh, const Progress& progress)
{
  requirePoints(surface.points, "The part's surface");
  if (settings.viewpoints == 0)
  {
    return { wholePart(surface) };
  }
  const Points directions = viewDirections(settings.viewpoints, settings.coneDirection, settings.coneAngle);
  const Eigen::Vector3d middle = bounds(surface.points).center().cast<double>();
  const double distance = settings.viewpointDistance * diameter(surface.points);
  const std::unique_ptr<const LineOfSight> sight = sightOf(surface, settings, mesh);
  const int views = static_cast<int>(directions.size());
  std::vector<AppearanceModel> models;
  for (int view = 0; view < views; ++view)
  {
    report(progress, static_cast<double>(view) / views);
    const Eigen::Vector3d viewpoint = middle + distance * directions[view].cast<double>();
    AppearanceModel model;
    model.name = "View " + std::to_string(view);
    model.direction = directions[view];
    model.viewpoint = viewpoint.cast<float>();
    model.cloud = surface.subset(
      sight ? visiblePoints(surface, viewpoint, *sight,
                subProgress(progress, static_cast<double>(view) / views, static_cast<double>(view + 1) / views))
            : visiblePoints(surface.points, viewpoint, settings.radiusFactor));
    if (sight)
    {
      turnTowards(model.cloud, model.viewpoint);
    }
    if (!model.cloud.empty())
    {
      models.push_back(std::move(model));
    }
  }
  if (models.empty())
  {
    throw Error("No viewpoint sees anything of the part: check that the surface was sampled from this mesh, and give "
                "other viewpoints.");
  }
  report(progress, 1.0);
  return models;
}
}
