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
constexpr double AlongSurface = 0.018;   // a little over the spacing of the part's surface points
constexpr double AlongEdge = 0.04;       // and of its edge points
constexpr double SceneLeafShare = 0.015; // spacing of the scene's points used
constexpr double CellShare = 0.05;
constexpr float ParallelTangents = 0.85f; // cosine
constexpr double EdgeWeight = 3.0;        // of an edge point against a surface point
}

PoseComparison::PoseComparison(const TrainedModel& model, const Scene& scene)
  : Model(model)
  , InScene(scene)
  , Surface(PointCloud{ scene.surface, {}, {}, {} }.subset(thinPoints(scene.surface, SceneLeafShare * model.diameter)).points)
  , SceneSurface(this->Surface, CellShare * model.diameter)
  , SceneEdges(scene.edges.points, CellShare * model.diameter)
  , PartSurface(model.surface.points, FarShare * model.diameter)
  , PartEdges(model.edges.points, AlongEdge * model.diameter)
{
  const Eigen::AlignedBox3f box = bounds(model.surface.empty() ? model.edges.points : model.surface.points);
  this->Middle = box.center();
  this->Radius = 0.5f * box.diagonal().norm();
}

double PoseComparison::toSurface(const Eigen::Vector3f& point) const
{
  const double far = FarShare * this->Model.diameter;
  const int k = this->PartSurface.nearest(point, 1.5 * far);
  if (k < 0)
  {
    return far;
  }
  const Eigen::Vector3f offset = point - this->Model.surface.points[k];
  const double across = this->Model.surface.normals[k].dot(offset);
  const double along = std::sqrt(std::max(0.0, offset.squaredNorm() - across * across));
  return std::min(far, std::hypot(across, std::max(0.0, along - AlongSurface * this->Model.diameter)));
}

double PoseComparison::toEdges(const Eigen::Vector3f& point, const Eigen::Vector3f& tangent) const
{
  const PointCloud& edges = this->Model.edges;
  double least = FarShare * this->Model.diameter;
  this->PartEdges.forEachWithin(point, AlongEdge * this->Model.diameter,
    [&](int k, float)
    {
      if (std::abs(edges.tangents[k].dot(tangent)) > ParallelTangents)
      {
        least = std::min<double>(least, edges.tangents[k].cross(point - edges.points[k]).norm());
      }
    });
  return least;
}

double PoseComparison::advantage(const Eigen::Isometry3d& a, const Eigen::Isometry3d& b) const
{
  const double far = FarShare * this->Model.diameter;
  const double near = NearShare * this->Model.diameter;
  const Eigen::Isometry3f toA = a.inverse().cast<float>();
  const Eigen::Isometry3f toB = b.inverse().cast<float>();
  const Eigen::Vector3f middle = a.cast<float>() * this->Middle;
  double sum = 0.0;
  this->SceneSurface.forEachWithin(middle, this->Radius,
    [&](int k, float)
    { sum += (this->toSurface(toB * this->Surface[k]) - this->toSurface(toA * this->Surface[k])) / far; });
  this->SceneEdges.forEachWithin(middle, this->Radius,
    [&](int k, float)
    {
      const Eigen::Vector3f& point = this->InScene.edges.points[k];
      const Eigen::Vector3f& tangent = this->InScene.edges.tangents[k];
      if (!this->Model.surface.empty() && this->toSurface(toA * point) >= far && this->toSurface(toB * point) >= far)
      {
        return; // of another object
      }
      const double ofA = this->toEdges(toA * point, toA.linear() * tangent);
      const double ofB = this->toEdges(toB * point, toB.linear() * tangent);
      sum += ofA < near && ofB >= far ? EdgeWeight : ofB < near && ofA >= far ? -EdgeWeight : 0.0;
    });
  return sum;
}
}
