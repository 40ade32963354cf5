// SPDX-License-Identifier: BSD-3-Clause
#include "pose/PoseComparison.h"

#include <algorithm>
#include <cmath>

namespace meam
{
namespace
{
// Shares of the diameter.
constexpr double FarShare = 0.02;        // a point this far from the part is not explained
constexpr double NearShare = 0.01;       // an edge this near is
constexpr double PastWeight = 2.25;       // of a predicted point: they are so much sparser than measured ones
constexpr double MissingWeight = 1.0;        // of a predicted edge point: images lose edges
constexpr double EdgeWeight = 3.0;        // of an edge point against a surface point
}

PoseComparison::Contender PoseComparison::contender(const Eigen::Isometry3d& T_scene_model) const
{
  return { T_scene_model, this->Index.view.visible(T_scene_model, this->Index.scene.sensor) };
}

double PoseComparison::contradicted(const Contender& one, const Eigen::Isometry3f& toOther) const
{
  const TrainedModel& model = this->Index.model;
  const float far = static_cast<float>(FarShare * model.diameter);
  const Eigen::Isometry3f T = one.T_scene_model.cast<float>();
  double sum = 0.0;
  for (const int i : one.visible.surface)
  {
    const Eigen::Vector3f point = T * model.surface.points[i];
    sum += model.surfaceDistance.at(toOther * point) >= far &&
        this->Index.depth.relation(point, far) == DepthMap::Relation::InFront
      ? PastWeight
      : 0.0;
  }
  for (const int i : one.visible.edges)
  {
    const Eigen::Vector3f point = T * model.edges.points[i];
    sum += model.edgeDistance.at(toOther * point) >= far &&
        this->Index.depth.relation(point, far) == DepthMap::Relation::OnSurface &&
        this->Index.edges.nearest(point, far) < 0
      ? MissingWeight
      : 0.0;
  }
  return sum;
}

double PoseComparison::advantage(const Contender& one, const Contender& other) const
{
  const TrainedModel& model = this->Index.model;
  const Points& sceneSurface = this->Index.depth.means();
  const Points& sceneEdges = this->Index.scene.edges.points;
  const float far = static_cast<float>(FarShare * model.diameter);
  const float near = static_cast<float>(NearShare * model.diameter);
  const Eigen::Isometry3d& a = one.T_scene_model;
  const Eigen::Isometry3d& b = other.T_scene_model;
  const Eigen::Isometry3f toA = a.inverse().cast<float>();
  const Eigen::Isometry3f toB = b.inverse().cast<float>();
  const DistanceField& surface = model.surfaceDistance;
  const DistanceField& edges = model.edgeDistance;
  const DistanceField& whole = model.surface.empty() ? edges : surface;
  const Eigen::Vector3f middleA = a.cast<float>() * whole.middle();
  const Eigen::Vector3f middleB = b.cast<float>() * whole.middle();
  // Every point near one of the two, once.
  const auto forEachNear = [&](const PointGrid& grid, const Points& points, auto&& visit)
  {
    grid.forEachWithin(middleA, whole.radius(), [&](int k, float) { visit(k); });
    grid.forEachWithin(middleB, whole.radius(),
      [&](int k, float)
      {
        if ((points[k] - middleA).squaredNorm() > whole.radius() * whole.radius())
        {
          visit(k);
        }
      });
  };
  double sum = this->contradicted(other, toA) - this->contradicted(one, toB);
  forEachNear(this->Index.surface, sceneSurface,
    [&](int k)
    {
      const Eigen::Vector3f& point = sceneSurface[k];
      sum += (std::min(surface.at(toB * point), far) - std::min(surface.at(toA * point), far)) / far;
    });
  forEachNear(this->Index.edges, sceneEdges,
    [&](int k)
    {
      const Eigen::Vector3f& point = sceneEdges[k];
      if (!model.surface.empty() && surface.at(toA * point) >= far && surface.at(toB * point) >= far)
      {
        return; // of another object
      }
      const float ofA = edges.at(toA * point);
      const float ofB = edges.at(toB * point);
      sum += ofA < near && ofB >= far ? EdgeWeight : ofB < near && ofA >= far ? -EdgeWeight : 0.0;
    });
  return sum;
}
}
