// SPDX-License-Identifier: BSD-3-Clause
#include "pose/PartView.h"

#include "PointGrid.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace meam
{
namespace
{
constexpr double JudgedLeafShare = 0.03;   // of the diameter: distance of the surface points judged
constexpr double CellShare = 0.025;        // of the diameter: cells of the depth buffer
constexpr double ToleranceShare = 0.01;    // of the diameter: depth a point may lie behind the nearest
constexpr float GrazingCosine = 0.15f;     // a surface seen at a flatter angle is not judged
constexpr float EdgeSlope = 1.5f;          // slope allowed for at an edge, whose surface is not known

Eigen::Vector3f meanOf(const Points& points)
{
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (const auto& point : points)
  {
    sum += point.cast<double>();
  }
  return (sum / static_cast<double>(points.size())).cast<float>();
}

Eigen::Vector3f directionTo(const Sensor& sensor, const Eigen::Isometry3d& T_scene_model, const Eigen::Vector3f& middle)
{
  const Eigen::Isometry3f T = T_scene_model.cast<float>();
  return T.linear().transpose() * sensor.towards(T * middle);
}
}

PartView::PartView(const TrainedModel& model)
  : Model(model)
  , Judged(thinPoints(model.surface.points, JudgedLeafShare * model.diameter))
  , Middle(meanOf(model.surface.empty() ? model.edges.points : model.surface.points))
{
}

int PartView::view(const Eigen::Isometry3d& T_scene_model, const Sensor& sensor) const
{
  const Eigen::Vector3f towards = directionTo(sensor, T_scene_model, this->Middle);
  const Points& views = this->Model.viewDirections;
  const auto nearer = [&](const auto& a, const auto& b) { return a.dot(towards) < b.dot(towards); };
  return static_cast<int>(std::max_element(views.begin(), views.end(), nearer) - views.begin());
}

PartView::Visible PartView::visible(const Eigen::Isometry3d& T_scene_model, const Sensor& sensor) const
{
  // The part is small against its distance: lines of sight are taken as parallel.
  const Eigen::Vector3f towards = directionTo(sensor, T_scene_model, this->Middle);
  const Eigen::Matrix3f frame = frameAround(towards);
  const float cell = static_cast<float>(CellShare * this->Model.diameter);
  const float tolerance = static_cast<float>(ToleranceShare * this->Model.diameter);
  const float half = static_cast<float>(this->Model.diameter); // a point is never farther from the middle
  const int side = static_cast<int>(std::ceil(2.0f * half / cell)) + 1;
  std::vector<float> nearest(static_cast<std::size_t>(side) * side, -std::numeric_limits<float>::infinity());
  const auto cellOf = [&](const Eigen::Vector3f& offset)
  {
    const int u = std::clamp(static_cast<int>((frame.col(1).dot(offset) + half) / cell), 0, side - 1);
    const int v = std::clamp(static_cast<int>((frame.col(2).dot(offset) + half) / cell), 0, side - 1);
    return v * side + u;
  };
  for (const auto& point : this->Model.surface.points)
  {
    const Eigen::Vector3f offset = point - this->Middle;
    float& height = nearest[cellOf(offset)];
    height = std::max(height, towards.dot(offset));
  }
  const auto inSight = [&](const Eigen::Vector3f& point, float slope)
  {
    const Eigen::Vector3f offset = point - this->Middle;
    return towards.dot(offset) >= nearest[cellOf(offset)] - tolerance - slope * cell;
  };
  Visible visible;
  for (std::size_t i = 0; i < this->Model.edges.size(); ++i)
  {
    if (inSight(this->Model.edges.points[i], EdgeSlope))
    {
      visible.edges.push_back(static_cast<int>(i));
    }
  }
  for (const int i : this->Judged)
  {
    const float cosine = this->Model.surface.normals[i].dot(towards);
    if (cosine > GrazingCosine && inSight(this->Model.surface.points[i], std::sqrt(1.0f - std::min(1.0f, cosine * cosine)) / cosine))
    {
      visible.surface.push_back(i);
    }
  }
  return visible;
}

PointCloud PartView::viewEdges(int view) const
{
  std::vector<int> members;
  for (std::size_t i = 0; i < this->Model.edges.size(); ++i)
  {
    if (this->Model.edgeViews[i] >> view & 1u)
    {
      members.push_back(static_cast<int>(i));
    }
  }
  return this->Model.edges.subset(members);
}
}
