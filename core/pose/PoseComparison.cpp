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

double PoseComparison::explained(const Eigen::Isometry3d& T_scene_model) const
{
  const DistanceField& surface = this->Index.model.surfaceDistance;
  const float far = static_cast<float>(FarShare * this->Index.model.diameter);
  const Eigen::Isometry3f T = T_scene_model.cast<float>();
  const Eigen::Isometry3f toModel = T_scene_model.inverse().cast<float>();
  const Points& measured = this->Index.depth.means();
  double explained = 0.0;
  this->Index.surface.forEachWithin(T * surface.middle(), surface.radius(),
    [&](int k, float) { explained += std::max(0.0f, 1.0f - surface.at(toModel * measured[k]) / far); });
  return explained;
}

PoseComparison::Contender PoseComparison::contender(const Eigen::Isometry3d& T_scene_model) const
{
  return { T_scene_model, this->explained(T_scene_model),
    this->Index.view.visible(T_scene_model, this->Index.scene.sensor) };
}

double PoseComparison::contradicted(const Contender& one, const Contender& other) const
{
  const TrainedModel& model = this->Index.model;
  const float far = static_cast<float>(FarShare * model.diameter);
  const Eigen::Isometry3f T = one.T_scene_model.cast<float>();
  const Eigen::Isometry3f toOther = (other.T_scene_model.inverse() * one.T_scene_model).cast<float>(); // part to part
  double sum = 0.0;
  for (const int i : one.visible.surface)
  {
    const Eigen::Vector3f& point = model.surface.points[i];
    sum += model.surfaceDistance.at(toOther * point) >= far &&
        this->Index.depth.relation(T * point, far) == DepthMap::Relation::InFront
      ? PastWeight
      : 0.0;
  }
  for (const int i : one.visible.edges)
  {
    const Eigen::Vector3f& point = model.edges.points[i];
    sum += model.edgeDistance.at(toOther * point) >= far &&
        this->Index.depth.relation(T * point, far) == DepthMap::Relation::OnSurface &&
        this->Index.edges.nearest(T * point, far) < 0
      ? MissingWeight
      : 0.0;
  }
  return sum;
}

double PoseComparison::advantage(const Contender& one, const Contender& other) const
{
  return this->advantageAtMost(one, other) - this->contradicted(one, other);
}

double PoseComparison::advantage(const Eigen::Isometry3d& T_scene_model, const Contender& other, double enough) const
{
  Contender one{ T_scene_model, this->explained(T_scene_model), {} };
  const double most = this->advantageAtMost(one, other);
  if (most < enough)
  {
    return most;
  }
  this->Index.view.update(one.visible, T_scene_model, this->Index.scene.sensor);
  return most - this->contradicted(one, other);
}

double PoseComparison::advantageAtMost(const Contender& one, const Contender& other) const
{
  const TrainedModel& model = this->Index.model;
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
  // Every edge near one of the two, once.
  const auto forEachNear = [&](auto&& visit)
  {
    this->Index.edges.forEachWithin(middleA, whole.radius(), [&](int k, float) { visit(k); });
    this->Index.edges.forEachWithin(middleB, whole.radius(),
      [&](int k, float)
      {
        if ((sceneEdges[k] - middleA).squaredNorm() > whole.radius() * whole.radius())
        {
          visit(k);
        }
      });
  };
  double sum = one.explained - other.explained + this->contradicted(other, one);
  forEachNear(
    [&](int k)
    {
      const Eigen::Vector3f inA = toA * sceneEdges[k];
      const Eigen::Vector3f inB = toB * sceneEdges[k];
      const float ofA = edges.at(inA);
      const float ofB = edges.at(inB);
      const double weight = ofA < near && ofB >= far ? EdgeWeight : ofB < near && ofA >= far ? -EdgeWeight : 0.0;
      if (weight != 0.0 && (model.surface.empty() || surface.at(inA) < far || surface.at(inB) < far)) // else another object's
      {
        sum += weight;
      }
    });
  return sum;
}
}
