// SPDX-License-Identifier: BSD-3-Clause
#include "pose/verification/SheetSurface.h"

#include "pose/PoseTolerances.h"

#include <algorithm>
#include <cmath>

namespace meam
{
namespace
{
constexpr int FewestPoints = 6;   // of a plane; with less the pose itself counts
constexpr double Slightly = 1e-9; // keeps the equations of points in a row from failing
}

SheetSurface::SheetSurface(const Scene& scene, const TrainedModel& model, const Eigen::Isometry3d& T_scene_model,
  const PredictedVisibility::Visible& visible, float tolerance, std::size_t stride)
{
  const Eigen::Isometry3f T = T_scene_model.cast<float>();
  this->Middle = T * model.visibility->middle();
  this->Towards = T.linear() * model.visibility->towards(T_scene_model, scene.sensor);
  this->Across = this->Towards.unitOrthogonal();
  Eigen::Matrix3d information = Slightly * Eigen::Matrix3d::Identity();
  Eigen::Vector3d right = Eigen::Vector3d::Zero();
  int count = 0;
  for (std::size_t k = 0; k < visible.surface.size(); k += stride)
  {
    const Eigen::Vector3f point = T * model.surface.points[visible.surface[k]];
    const float behind = scene.depth.behind(point);
    if (visible.isInner[k] && std::abs(behind) <= tolerance)
    {
      const Eigen::Vector3d place = this->placeOf(point);
      information += place * place.transpose();
      right += behind * place;
      ++count;
    }
  }
  if (count >= FewestPoints)
  {
    this->Behind = information.ldlt().solve(right);
  }
}

Eigen::Vector3d SheetSurface::placeOf(const Eigen::Vector3f& point) const
{
  const Eigen::Vector3f off = point - this->Middle;
  return { 1.0, off.dot(this->Across), off.dot(this->Towards.cross(this->Across)) };
}

Eigen::Vector3f SheetSurface::onMeasured(const Eigen::Vector3f& point) const
{
  return point - static_cast<float>(this->Behind.dot(this->placeOf(point))) * this->Towards;
}

bool SheetSurface::isOfBin(const Eigen::Vector3f& point, const Scene& scene, const TrainedModel& model)
{
  const int cell = scene.depth.cellAt(point);
  return cell >= 0 && std::any_of(scene.enclosure.begin(), scene.enclosure.end(),
                        [&](const Plane& plane)
                        { return plane.absDistance(scene.depth.meanIn(cell)) < OtherFace * model.thickness; });
}
}
