// SPDX-License-Identifier: BSD-3-Clause
#include "pose/PoseEvidence.h"

#include <algorithm>
#include <cmath>

namespace meam
{
namespace
{
constexpr double SurfaceReachShare = 0.04; // of the diameter: a little over the spacing of judged points
constexpr float OnSurface = 0.7f;          // tolerances within which a scene edge lies on the part

constexpr std::size_t EdgeStride = 2; // of the visible edge points: neighbours tell the same
constexpr int GlanceStride = 3; // of the judged points

// What each kind of evidence counts in the score.
constexpr double EdgeWeight = 0.4;
constexpr double SurfaceWeight = 0.4;
constexpr double ExplainedWeight = 0.2;

int count(const std::vector<PointState>& states, PointState state)
{
  return static_cast<int>(std::count(states.begin(), states.end(), state));
}

/// matched / (matched + violated), 0 when all is hidden.
double share(const std::vector<PointState>& states)
{
  const int matched = count(states, PointState::Matched);
  const int violated = count(states, PointState::Violated);
  return matched > 0 ? static_cast<double>(matched) / (matched + violated) : 0.0;
}
}

double PoseEvidence::support() const
{
  const int near = this->explained + this->unexplained;
  const double clean = near > 0 ? static_cast<double>(this->explained) / near : 0.0;
  if (this->surface.empty())
  {
    return share(this->edgeStates);
  }
  return EdgeWeight * share(this->edgeStates) + SurfaceWeight * share(this->surfaceStates) + ExplainedWeight * clean;
}

double PoseEvidence::visibleFraction() const
{
  const auto& states = this->surface.empty() ? this->edgeStates : this->surfaceStates;
  return states.empty() ? 0.0 : 1.0 - static_cast<double>(count(states, PointState::Hidden)) / states.size();
}

EvidenceCollector::EvidenceCollector(const SceneIndex& index, double tolerance)
  : Index(index)
  , Tolerance(tolerance)
{
}

PoseEvidence EvidenceCollector::collect(const Eigen::Isometry3d& T_scene_model, std::size_t stride) const
{
  const Eigen::Isometry3f T = T_scene_model.cast<float>();
  const TrainedModel& model = this->Index.model;
  const PointCloud& sceneEdges = this->Index.scene.edges;
  const DepthMap& depth = this->Index.depth;
  const PartView::Visible visible = this->Index.view.visible(T_scene_model, this->Index.scene.sensor);
  const float tolerance = static_cast<float>(this->Tolerance);
  PoseEvidence evidence;
  for (std::size_t k = 0; k < visible.edges.size(); k += stride * EdgeStride)
  {
    const int i = visible.edges[k];
    const Eigen::Vector3f point = T * model.edges.points[i];
    const Eigen::Vector3f tangent = T.linear() * model.edges.tangents[i];
    const bool matched = this->Index.lines.nearest(point, tangent, tolerance).edge >= 0;
    const PointState state = matched ? PointState::Matched
      : depth.relation(point, tolerance) == DepthMap::Relation::Hidden ? PointState::Hidden
                                                                             : PointState::Violated;
    evidence.edges.push_back(point);
    evidence.edgeStates.push_back(state);
  }
  if (this->Index.scene.surface.empty())
  {
    return evidence;
  }
  for (std::size_t k = 0; k < visible.surface.size(); k += stride)
  {
    const Eigen::Vector3f point = T * model.surface.points[visible.surface[k]];
    const DepthMap::Relation relation = depth.relation(point, tolerance);
    evidence.surface.push_back(point);
    evidence.surfaceStates.push_back(relation == DepthMap::Relation::OnSurface ? PointState::Matched
        : relation == DepthMap::Relation::Hidden                               ? PointState::Hidden
                                                                               : PointState::Violated);
  }
  // Scene edges on the part's surface: those that no edge of the part explains speak against the pose.
  const Eigen::Isometry3f toModel = T.inverse();
  this->Index.edges.forEachWithin(T * model.surfaceDistance.middle(), model.surfaceDistance.radius(),
    [&](int k, float)
    {
      const Eigen::Vector3f point = toModel * sceneEdges.points[k];
      if (model.surfaceDistance.at(point) < OnSurface * tolerance)
      {
        ++(model.edgeDistance.at(point) < tolerance ? evidence.explained : evidence.unexplained);
      }
    });
  return evidence;
}

double EvidenceCollector::glance(const Eigen::Isometry3d& T_scene_model) const
{
  const Eigen::Isometry3f T = T_scene_model.cast<float>();
  const float tolerance = static_cast<float>(this->Tolerance);
  int matched = 0;
  int violated = 0;
  this->Index.view.forEachFacing(T_scene_model, this->Index.scene.sensor, GlanceStride,
    [&](int i)
    {
      const DepthMap::Relation relation = this->Index.depth.relation(T * this->Index.model.surface.points[i], tolerance);
      matched += relation == DepthMap::Relation::OnSurface ? 1 : 0;
      violated += relation == DepthMap::Relation::InFront || relation == DepthMap::Relation::NoSurface ? 1 : 0;
    });
  return matched > 0 ? static_cast<double>(matched) / (matched + violated) : 0.0;
}

double EvidenceCollector::shared(const PoseEvidence& a, const PoseEvidence& b) const
{
  const auto matched = [](const PoseEvidence& evidence)
  {
    const bool bySurface = !evidence.surface.empty();
    const Points& points = bySurface ? evidence.surface : evidence.edges;
    const std::vector<PointState>& states = bySurface ? evidence.surfaceStates : evidence.edgeStates;
    Points result;
    for (std::size_t i = 0; i < points.size(); ++i)
    {
      if (states[i] == PointState::Matched)
      {
        result.push_back(points[i]);
      }
    }
    return result;
  };
  const double reach = SurfaceReachShare * this->Index.model.diameter;
  const Points ofA = matched(a);
  const PointGrid ofB(matched(b), reach);
  const auto near =
    std::count_if(ofA.begin(), ofA.end(), [&](const auto& point) { return ofB.nearest(point, reach) >= 0; });
  return ofA.empty() ? 0.0 : static_cast<double>(near) / ofA.size();
}
}
