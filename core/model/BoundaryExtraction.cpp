// SPDX-License-Identifier: BSD-3-Clause
#include "model/BoundaryExtraction.h"

#include "base/Bounds.h"
#include "base/Frames.h"
#include "features/PCLConversion.h"
#include "base/PointGrid.h"
#include "base/sequences/Quantiles.h"
#include "mesh/FeatureEdges.h"
#include "mesh/TriangleMesh.h"
#include "model/AppearanceModel.h"
#include "model/edges/Silhouette.h"
#include "model/edges/VisibleEdges.h"

#include <pcl/features/boundary.h>
#include <pcl/kdtree/kdtree_flann.h>

#include <algorithm>
#include <cmath>

namespace meam
{
namespace
{
constexpr double RadiusSpacings = 2.5; // times the spacing of the points
// Surface that is seen flatter (7 degrees) is no more than a line in an image: for the wall of a hole that is seen
// along its axis, the hole's rim is where the surface ends.
constexpr double EdgeOnCosine = 0.12;

std::vector<int> boundaryPoints(const PointCloud& cloud, double radius, double angle)
{
  const auto points = toPCL(cloud.points);
  const PointGrid grid(cloud.points, radius);
  pcl::BoundaryEstimation<pcl::PointXYZ, pcl::Normal, pcl::Boundary> estimation;
  std::vector<int> boundary;
  for (std::size_t i = 0; i < cloud.size(); ++i)
  {
    pcl::Indices neighbours;
    grid.forEachWithin(cloud.points[i], radius, [&](int index, float) { neighbours.push_back(index); });
    const Eigen::Matrix3f frame = frameAround(cloud.normals[i]);
    Eigen::Vector4f u = Eigen::Vector4f::Zero();
    Eigen::Vector4f v = Eigen::Vector4f::Zero();
    u.head<3>() = frame.col(1);
    v.head<3>() = frame.col(2);
    if (estimation.isBoundaryPoint(*points, (*points)[i], neighbours, u, v, static_cast<float>(angle * M_PI / 180.0)))
    {
      boundary.push_back(static_cast<int>(i));
    }
  }
  return boundary;
}

Eigen::Vector3d viewpointOf(const AppearanceModel& model)
{
  constexpr float farAway = 1000.0f; // extents of the part, a viewpoint that is not known
  const Eigen::AlignedBox3f box = bounds(model.cloud.points);
  const Eigen::Vector3f viewpoint = model.viewpoint.allFinite()
                                      ? model.viewpoint
                                      : (box.center() + farAway * box.diagonal().norm() * model.direction).eval();
  return viewpoint.cast<double>();
}

/// The middles of the gaps between directions that are wider than `angle`; all in radians.
std::vector<double> gapsBetween(std::vector<double> directions, double angle)
{
  if (directions.empty())
  {
    return { 0.0 };
  }
  std::sort(directions.begin(), directions.end());
  std::vector<double> middles;
  for (std::size_t i = 0; i < directions.size(); ++i)
  {
    const double end = i + 1 < directions.size() ? directions[i + 1] : directions.front() + 2.0 * M_PI;
    if (end - directions[i] > angle)
    {
      middles.push_back(0.5 * (directions[i] + end));
    }
  }
  return middles;
}

/// The same criterion as for the boundary, but in the image: where the neighbours, of all faces that are
/// plainly seen, leave a gap, the visible surface ends.
std::vector<EdgeType> boundaryTypes(const PointCloud& cloud, const std::vector<int>& boundary, double radius,
  double angle, const Eigen::Vector3d& viewpoint, const Silhouette& silhouette)
{
  const PointGrid grid(cloud.points, radius);
  std::vector<EdgeType> types;
  types.reserve(boundary.size());
  std::vector<double> directions;
  const auto isGrazing = [&](int index, const Eigen::Vector3d& towards)
  { return std::abs(cloud.normals[index].cast<double>().dot(towards)) < EdgeOnCosine; };
  for (const int i : boundary)
  {
    const Eigen::Vector3d point = cloud.points[i].cast<double>();
    const Eigen::Matrix3d frame = frameAround((viewpoint - point).normalized().cast<float>()).cast<double>();
    const bool grazing = isGrazing(i, frame.col(0));
    directions.clear();
    grid.forEachWithin(cloud.points[i], radius,
      [&](int index, float distance)
      {
        if (distance > 0.0f && (grazing || !isGrazing(index, frame.col(0))))
        {
          const Eigen::Vector3d offset = cloud.points[index].cast<double>() - point;
          directions.push_back(std::atan2(frame.col(2).dot(offset), frame.col(1).dot(offset)));
        }
      });
    const std::vector<double> gaps = gapsBetween(directions, angle * M_PI / 180.0);
    const bool showsEnclosed = std::any_of(gaps.begin(), gaps.end(),
      [&](double gap)
      {
        const Eigen::Vector3d outward = std::cos(gap) * frame.col(1) + std::sin(gap) * frame.col(2);
        return silhouette.beyond(point, outward) == Silhouette::Cell::Enclosed;
      });
    types.push_back(gaps.empty() ? EdgeType::Crease : showsEnclosed ? EdgeType::HoleBorder : EdgeType::Contour);
  }
  return types;
}

/// Ids of the nearest points of the cloud, where it has ids.
std::vector<int> nearestIds(const Points& points, const PointCloud& cloud, double spacing)
{
  std::vector<int> ids;
  if (cloud.pointIds.empty())
  {
    return ids;
  }
  const PointGrid grid(cloud.points, spacing);
  ids.reserve(points.size());
  for (const auto& point : points)
  {
    int nearest = -1;
    for (double reach = spacing; nearest < 0; reach *= 2.0)
    {
      nearest = grid.nearest(point, reach);
    }
    ids.push_back(cloud.pointIds[nearest]);
  }
  return ids;
}

/// Null for the method that does without the mesh.
std::unique_ptr<const VisibleEdges> meshEdgesOf(const std::vector<AppearanceModel>& models,
  const BoundaryExtractionSettings& settings, const TriangleMesh* mesh, double spacing)
{
  if (settings.method == BoundaryMethod::PointBoundary)
  {
    return nullptr;
  }
  if (!mesh)
  {
    throw Error("Mesh edges need the mesh: connect the prepared mesh that the appearance models are of, or use the "
                "boundary of the points.");
  }
  if (!(settings.sharpAngle > 0.0 && settings.sharpAngle < 180.0))
  {
    throw Error("The angle of sharp edges must be between 0 and 180 degrees.");
  }
  requireMesh(*mesh);
  for (const AppearanceModel& model : models)
  {
    requireSamplesOf(*mesh, model.cloud.points);
  }
  return std::make_unique<const VisibleEdges>(*mesh, settings.sharpAngle, spacing, EdgeOnCosine);
}
}

double pointSpacing(const Points& points)
{
  if (points.size() < 2)
  {
    return 0.0;
  }
  const auto cloud = toPCL(points);
  constexpr int most = 6; // points at one place, or nearly so
  pcl::KdTreeFLANN<pcl::PointXYZ> tree;
  tree.setInputCloud(cloud);
  std::vector<float> distances;
  distances.reserve(points.size());
  pcl::Indices nearest;
  std::vector<float> squared;
  for (const auto& point : *cloud)
  {
    // A point may be there several times: the first at a distance counts.
    tree.nearestKSearch(point, most, nearest, squared);
    const auto other = std::find_if(squared.begin(), squared.end(), [](float distance) { return distance > 0.0f; });
    if (other != squared.end())
    {
      distances.push_back(*other);
    }
  }
  return std::sqrt(medianOf(distances));
}

std::vector<AppearanceModel> extractBoundary(const std::vector<AppearanceModel>& models,
  const BoundaryExtractionSettings& settings, const TriangleMesh* mesh, const Progress& progress)
{
  Points part;          // what the views know of it together: hidden point removal leaves gaps in each
  double spacing = 0.0; // of the view that shows the most
  std::size_t most = 0;
  std::vector<double> spacings;
  for (const AppearanceModel& model : models)
  {
    requirePoints(model.cloud.points, "Appearance model " + model.name);
    if (model.cloud.normals.size() != model.cloud.size())
    {
      throw Error("Appearance model " + model.name + " has no normals: sample the surface of a mesh first.");
    }
    spacings.push_back(pointSpacing(model.cloud.points));
    if (!(spacings.back() > 0.0))
    {
      throw Error("Appearance model " + model.name +
                  " has a single place: sample the surface with a spacing that is small against the part.");
    }
    part.insert(part.end(), model.cloud.points.begin(), model.cloud.points.end());
    if (model.cloud.size() > most)
    {
      most = model.cloud.size();
      spacing = spacings.back();
    }
  }
  const std::unique_ptr<const VisibleEdges> meshEdges = meshEdgesOf(models, settings, mesh, spacing);
  std::vector<AppearanceModel> edges = models;
  for (std::size_t view = 0; view < models.size(); ++view)
  {
    const double share = 1.0 / static_cast<double>(models.size());
    report(progress, share * view);
    const PointCloud& cloud = models[view].cloud;
    if (meshEdges && models[view].wholePart)
    {
      edges[view].cloud = extractFeatureEdges(
        *mesh, { settings.sharpAngle, spacing }, subProgress(progress, share * view, share * (view + 1)));
      edges[view].cloud.pointIds = nearestIds(edges[view].cloud.points, cloud, spacing);
      continue;
    }
    const Eigen::Vector3d viewpoint = viewpointOf(models[view]);
    const Silhouette silhouette(part, viewpoint, spacing);
    if (meshEdges)
    {
      edges[view].cloud =
        meshEdges->seenFrom(viewpoint, silhouette, subProgress(progress, share * view, share * (view + 1)));
      edges[view].cloud.pointIds = nearestIds(edges[view].cloud.points, cloud, spacing);
      continue;
    }
    const double radius = settings.radius > 0.0 ? settings.radius : RadiusSpacings * spacings[view];
    const std::vector<int> boundary = boundaryPoints(cloud, radius, settings.angle);
    edges[view].cloud = cloud.subset(boundary);
    edges[view].cloud.edgeTypes = models[view].wholePart
                                    ? std::vector<EdgeType>(boundary.size(), EdgeType::Crease)
                                    : boundaryTypes(cloud, boundary, radius, settings.angle, viewpoint, silhouette);
  }
  report(progress, 1.0);
  return edges;
}
}
