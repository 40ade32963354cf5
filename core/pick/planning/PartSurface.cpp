// SPDX-License-Identifier: BSD-3-Clause
#include "pick/planning/PartSurface.h"

#include "base/Bounds.h"
#include "base/Error.h"
#include "base/Frames.h"
#include "base/PointGrid.h"
#include "base/sequences/Sequences.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace meam
{
namespace
{
constexpr double MostPoints = 5e6;
constexpr double LeafOfSpacing = 0.7;
constexpr double CellOfReach = 0.2; // of the distances

/// Points of a triangle on a lattice whose steps are at most `spacing`, its corners among them.
void addLattice(
  const Eigen::Vector3f& a, const Eigen::Vector3f& b, const Eigen::Vector3f& c, double spacing, Points& points)
{
  const double longest = std::max({ (b - a).norm(), (c - a).norm(), (c - b).norm() });
  const int steps = std::max(1, static_cast<int>(std::ceil(longest / spacing)));
  if (static_cast<double>(points.size()) + 0.5 * steps * steps > MostPoints)
  {
    throw Error("The part is too large for points " + std::to_string(spacing) +
                " mm from each other: check its unit, or raise the tolerance.");
  }
  for (int i = 0; i <= steps; ++i)
  {
    for (int j = 0; j <= steps - i; ++j)
    {
      const float u = static_cast<float>(i) / static_cast<float>(steps);
      const float v = static_cast<float>(j) / static_cast<float>(steps);
      points.push_back(a + u * (b - a) + v * (c - a));
    }
  }
}
}

PartSurface::PartSurface(const TriangleMesh& part, double spacing, double reach)
  : Reach(reach)
{
  requireMesh(part);
  PointCloud lattice;
  for (const auto& triangle : part.triangles)
  {
    const Eigen::Vector3f& a = part.vertices[triangle.x()];
    const Eigen::Vector3f& b = part.vertices[triangle.y()];
    const Eigen::Vector3f& c = part.vertices[triangle.z()];
    addLattice(a, b, c, spacing, lattice.points);
    lattice.normals.resize(lattice.size(), (b - a).cross(c - a).normalized());
  }
  // Thinned among those that face the same way, so that both sides of a thin wall keep theirs.
  PointCloud samples;
  for (int way = 0; way < 6; ++way)
  {
    Points facing;
    std::vector<int> indices;
    for (std::size_t k = 0; k < lattice.size(); ++k)
    {
      int axis = 0;
      lattice.normals[k].cwiseAbs().maxCoeff(&axis);
      if (2 * axis + (lattice.normals[k][axis] > 0.0f) == way)
      {
        facing.push_back(lattice.points[k]);
        indices.push_back(static_cast<int>(k));
      }
    }
    for (const int kept : thinPoints(facing, LeafOfSpacing * spacing))
    {
      samples.points.push_back(facing[kept]);
      samples.normals.push_back(lattice.normals[indices[kept]]);
    }
  }
  this->Distances = DistanceField::ofSurface(samples, spacing, reach, CellOfReach * reach);
  this->Samples = std::move(samples.points);
  this->Middle = bounds(this->Samples).center().cast<double>();
  for (const auto& point : this->Samples)
  {
    this->Radius = std::max(this->Radius, (point.cast<double>() - this->Middle).norm());
  }
}

std::vector<int> PartSurface::pointsAt(
  const Eigen::Isometry3d& T_scene_model, const Points& points, double tolerance) const
{
  const Eigen::Isometry3f toModel = T_scene_model.inverse().cast<float>();
  const auto near = static_cast<float>(std::min(tolerance, this->Reach));
  return indicesWhere(points.size(), [&](int k) { return this->Distances.at(toModel * points[k]) < near; });
}

double PartSurface::covered(const Eigen::Isometry3d& T_scene_model, const Eigen::Vector3d& up, const Points& points,
  double cell, double tolerance) const
{
  // Two rasters across `up`, of the copy's and of the other points' heights.
  Eigen::Isometry3d T_raster_scene = Eigen::Isometry3d::Identity();
  T_raster_scene.linear() = frameAround(up.cast<float>()).cast<double>().transpose(); // first axis: up
  const Eigen::Vector3d middle = T_raster_scene * (T_scene_model * this->Middle);
  T_raster_scene.pretranslate(-middle);
  const int side = 2 * static_cast<int>(std::ceil(this->Radius / cell)) + 1;
  constexpr float nothing = -std::numeric_limits<float>::infinity();
  std::vector<float> part(static_cast<std::size_t>(side) * side, nothing);
  std::vector<float> others = part;
  const auto raise = [&](const Eigen::Vector3f& place, std::vector<float>& heights)
  {
    const double x = std::floor(place.y() / cell + 0.5 * side);
    const double y = std::floor(place.z() / cell + 0.5 * side);
    if (x >= 0.0 && y >= 0.0 && x < side && y < side)
    {
      float& height = heights[static_cast<std::size_t>(y) * side + static_cast<std::size_t>(x)];
      height = std::max(height, place.x());
    }
  };
  const Eigen::Isometry3f ofPart = (T_raster_scene * T_scene_model).cast<float>();
  for (const auto& sample : this->Samples)
  {
    raise(ofPart * sample, part);
  }
  const Eigen::Isometry3f ofScene = T_raster_scene.cast<float>();
  for (const auto& point : points)
  {
    raise(ofScene * point, others);
  }
  int cells = 0;
  int hidden = 0;
  for (std::size_t k = 0; k < part.size(); ++k)
  {
    cells += part[k] > nothing;
    hidden += part[k] > nothing && others[k] > part[k] + static_cast<float>(tolerance);
  }
  return cells > 0 ? static_cast<double>(hidden) / cells : 0.0;
}
}
