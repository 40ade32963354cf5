// SPDX-License-Identifier: BSD-3-Clause
#include "model/BoundaryExtraction.h"

#include "PCLConversion.h"
#include "PointGrid.h"

#include <pcl/features/boundary.h>
#include <pcl/kdtree/kdtree_flann.h>

#include <algorithm>
#include <cmath>

namespace meam
{
namespace
{
constexpr double SpacingsPerRadius = 2.5;
constexpr int NeighboursOfSpacing = 6;

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
    if (estimation.isBoundaryPoint(
          *points, (*points)[i], neighbours, u, v, static_cast<float>(angle * M_PI / 180.0)))
    {
      boundary.push_back(static_cast<int>(i));
    }
  }
  return boundary;
}
}

double pointSpacing(const Points& points)
{
  if (points.size() < 2)
  {
    return 0.0;
  }
  const auto cloud = toPCL(points);
  pcl::KdTreeFLANN<pcl::PointXYZ> tree;
  tree.setInputCloud(cloud);
  std::vector<float> distances;
  distances.reserve(points.size());
  pcl::Indices nearest;
  std::vector<float> squared;
  for (const auto& point : *cloud)
  {
    // A point may be there several times: the first at a distance counts.
    tree.nearestKSearch(point, NeighboursOfSpacing, nearest, squared);
    const auto other = std::find_if(squared.begin(), squared.end(), [](float distance) { return distance > 0.0f; });
    if (other != squared.end())
    {
      distances.push_back(*other);
    }
  }
  if (distances.empty())
  {
    return 0.0;
  }
  const auto middle = distances.begin() + distances.size() / 2;
  std::nth_element(distances.begin(), middle, distances.end());
  return std::sqrt(*middle);
}

std::vector<AppearanceModel> extractBoundary(const std::vector<AppearanceModel>& models,
  const BoundaryExtractionSettings& settings, const Progress& progress)
{
  std::vector<AppearanceModel> edges = models;
  for (std::size_t view = 0; view < models.size(); ++view)
  {
    report(progress, static_cast<double>(view) / models.size());
    const PointCloud& cloud = models[view].cloud;
    requirePoints(cloud.points, "Appearance model " + models[view].name);
    if (cloud.normals.size() != cloud.size())
    {
      throw Error("Appearance model " + models[view].name + " has no normals: sample the surface of a mesh first.");
    }
    const double radius = settings.radius > 0.0 ? settings.radius : SpacingsPerRadius * pointSpacing(cloud.points);
    if (!(radius > 0.0))
    {
      throw Error("Appearance model " + models[view].name +
        " has a single place: sample the surface with a spacing that is small against the part.");
    }
    edges[view].cloud = cloud.subset(boundaryPoints(cloud, radius, settings.angle));
  }
  report(progress, 1.0);
  return edges;
}
}
