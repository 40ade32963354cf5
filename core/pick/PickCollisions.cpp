// SPDX-License-Identifier: BSD-3-Clause
#include "pick/PickCollisions.h"

#include "base/PointCloud.h"
#include "base/sequences/Sequences.h"

#include <fcl/fcl.h>
#include <octomap/octomap.h>

#include <algorithm>
#include <cmath>
#include <map>

namespace meam
{
namespace
{
using Geometry = std::shared_ptr<fcl::CollisionGeometryd>;

Geometry geometryOf(const TriangleMesh& mesh)
{
  const auto vertices = mapped<fcl::Vector3d>(
    mesh.vertices, [&](const Eigen::Vector3f& vertex) -> fcl::Vector3d { return vertex.cast<double>(); });
  const auto triangles = mapped<fcl::Triangle>(
    mesh.triangles, [&](const auto& triangle) { return fcl::Triangle(triangle.x(), triangle.y(), triangle.z()); });
  auto model = std::make_shared<fcl::BVHModel<fcl::OBBRSSd>>();
  model->beginModel(static_cast<int>(triangles.size()), static_cast<int>(vertices.size()));
  model->addSubModel(vertices, triangles);
  model->endModel();
  model->computeLocalAABB();
  return model;
}

Geometry geometryOf(const GripperPiece& piece)
{
  Geometry geometry;
  if (piece.round)
  {
    geometry = std::make_shared<fcl::Cylinderd>(0.5 * piece.size.x(), piece.size.z());
  }
  else
  {
    geometry = std::make_shared<fcl::Boxd>(piece.size);
  }
  geometry->computeLocalAABB();
  return geometry;
}

struct Placed
{
  Geometry geometry;
  Eigen::Isometry3d pose;
  Obstacle kind;
  int instance;
  /// A ball around it, scene coordinates, mm.
  Eigen::Vector3d middle() const { return this->pose * this->geometry->aabb_center; }
  double radius() const { return this->geometry->aabb_radius; }
};

bool collide(const Placed& a, const Placed& b)
{
  const fcl::CollisionRequestd request;
  fcl::CollisionResultd result;
  return fcl::collide(a.geometry.get(), a.pose, b.geometry.get(), b.pose, request, result) > 0;
}

/// Their distance, mm, at most `most`; 0 when they collide.
double distance(const Placed& a, const Placed& b, double most)
{
  if ((a.middle() - b.middle()).norm() - a.radius() - b.radius() >= most)
  {
    return most;
  }
  if (collide(a, b))
  {
    return 0.0;
  }
  const fcl::DistanceRequestd request;
  fcl::DistanceResultd result;
  result.min_distance = most; // nothing farther is looked at
  fcl::distance(a.geometry.get(), a.pose, b.geometry.get(), b.pose, request, result);
  return std::clamp(result.min_distance, 0.0, most);
}

/// The gripper at its grasp with its way in: pieces made longer, or a mesh at every step, the grasp itself first.
std::vector<Placed> placedGripper(const Gripper& gripper, const Geometry& mesh, const Grasp& grasp,
  const Eigen::Isometry3d& T_scene_grasp, double wayIn, double step)
{
  std::vector<Placed> result;
  if (mesh)
  {
    const int steps = static_cast<int>(std::ceil(wayIn / step));
    for (int k = 0; k <= steps; ++k)
    {
      const Eigen::Isometry3d place = T_scene_grasp * Eigen::Translation3d(0.0, 0.0, steps ? -wayIn * k / steps : 0.0);
      result.push_back({ mesh, place, Obstacle::None, -1 });
    }
  }
  for (const GripperPiece& piece : piecesOf(gripper, grasp, wayIn))
  {
    result.push_back({ geometryOf(piece), T_scene_grasp * Eigen::Translation3d(piece.middle), Obstacle::None, -1 });
  }
  return result;
}
}

struct PickCollisions::World
{
  Gripper gripper;
  Geometry gripperMesh; ///< null for a gripper by its lengths
  Geometry part;
  std::vector<Placed> bin;
  std::vector<Placed> instances;
  std::vector<Placed> measured; ///< one or none
};

PickCollisions::PickCollisions(const TriangleMesh& part, const Gripper& gripper)
{
  requireMesh(part);
  requireGripper(gripper);
  this->Objects = std::make_unique<World>();
  this->Objects->gripper = gripper;
  this->Objects->gripperMesh = gripper.mesh.triangles.empty() ? nullptr : geometryOf(gripper.mesh);
  this->Objects->part = geometryOf(part);
}

PickCollisions::~PickCollisions() = default;

void PickCollisions::setBin(const Bin* bin)
{
  this->Objects->bin.clear();
  if (bin)
  {
    requireBin(*bin);
    for (const PlacedBox& box : boxesOf(*bin))
    {
      auto geometry = std::make_shared<fcl::Boxd>(box.size);
      geometry->computeLocalAABB();
      this->Objects->bin.push_back({ geometry, box.T_scene_box, Obstacle::Bin, -1 });
    }
  }
}

void PickCollisions::setInstances(const std::vector<Eigen::Isometry3d>& poses)
{
  this->setInstances(poses, std::vector<const PickCollisions*>(poses.size(), this));
}

void PickCollisions::setInstances(
  const std::vector<Eigen::Isometry3d>& poses, const std::vector<const PickCollisions*>& parts)
{
  this->Objects->instances.clear();
  for (std::size_t k = 0; k < poses.size(); ++k)
  {
    this->Objects->instances.push_back(
      { parts.at(k)->Objects->part, poses[k], Obstacle::Instance, static_cast<int>(k) });
  }
}

void PickCollisions::setMeasured(const Points& points, double voxelSize, int fewest)
{
  this->Objects->measured.clear();
  auto tree = std::make_shared<octomap::OcTree>(voxelSize);
  std::map<std::array<unsigned, 3>, int> counts;
  bool any = false;
  for (const auto& point : points)
  {
    octomap::OcTreeKey key;
    if (!point.allFinite() || !tree->coordToKeyChecked(octomap::point3d(point.x(), point.y(), point.z()), key))
    {
      continue;
    }
    if (++counts[{ key[0], key[1], key[2] }] == fewest)
    {
      tree->updateNode(key, true, true);
      any = true;
    }
  }
  if (any)
  {
    tree->updateInnerOccupancy();
    auto geometry = std::make_shared<fcl::OcTreed>(std::shared_ptr<const octomap::OcTree>(tree));
    geometry->computeLocalAABB();
    this->Objects->measured.push_back({ geometry, Eigen::Isometry3d::Identity(), Obstacle::Measured, -1 });
  }
}

Clearance PickCollisions::clearance(
  const Grasp& grasp, const Eigen::Isometry3d& T_scene_grasp, int held, double wayIn, double most, double step) const
{
  const World& world = *this->Objects;
  const std::vector<Placed> moving = placedGripper(world.gripper, world.gripperMesh, grasp, T_scene_grasp, wayIn, step);
  const auto between = mapped<Placed>(betweenJaws(world.gripper, grasp),
    [&](const GripperPiece& piece) {
      return Placed{ geometryOf(piece), T_scene_grasp * Eigen::Translation3d(piece.middle), Obstacle::None, -1 };
    });
  Clearance nearest{ most, Obstacle::None, -1 };
  for (const auto* obstacles : { &world.bin, &world.instances, &world.measured })
  {
    for (const Placed& obstacle : *obstacles)
    {
      if (obstacle.kind == Obstacle::Instance && obstacle.instance == held)
      {
        continue;
      }
      for (const Placed& piece : moving)
      {
        const double found = distance(piece, obstacle, nearest.distance);
        if (found < nearest.distance)
        {
          nearest = { found, obstacle.kind, obstacle.instance };
        }
      }
      for (const Placed& piece : between) // is pressed together
      {
        if (nearest.distance > 0.0 && distance(piece, obstacle, nearest.distance) <= 0.0)
        {
          nearest = { 0.0, obstacle.kind, obstacle.instance };
        }
      }
      if (nearest.distance <= 0.0)
      {
        return nearest;
      }
    }
  }
  return nearest;
}

bool PickCollisions::touchesHeld(const Grasp& grasp, double wayIn, double step) const
{
  const World& world = *this->Objects;
  const Placed part{ world.part, Eigen::Isometry3d::Identity(), Obstacle::Instance, 0 };
  const std::vector<Placed> moving =
    placedGripper(world.gripper, world.gripperMesh, grasp, grasp.T_model_grasp, wayIn, step);
  return std::any_of(moving.begin(), moving.end(), [&](const Placed& piece) { return collide(piece, part); });
}

std::vector<int> PickCollisions::heldBy(const Grasp& grasp, const Eigen::Isometry3d& T_scene_grasp, double slack) const
{
  const World& world = *this->Objects;
  std::vector<GripperPiece> pieces = betweenJaws(world.gripper, grasp);
  if (pieces.empty())
  {
    const double diameter = world.gripper.cupDiameter;
    pieces.push_back({ true, Eigen::Vector3d::Zero(), { diameter, diameter, 2.0 * slack } });
  }
  std::vector<int> held;
  for (const Placed& instance : world.instances)
  {
    const auto touches = [&](const GripperPiece& piece)
    {
      return collide(
        { geometryOf(piece), T_scene_grasp * Eigen::Translation3d(piece.middle), Obstacle::None, -1 }, instance);
    };
    if (std::any_of(pieces.begin(), pieces.end(), touches))
    {
      held.push_back(instance.instance);
    }
  }
  return held;
}
}
