// SPDX-License-Identifier: BSD-3-Clause
#include "pose/diagnosis/PlaceEvidence.h"

#include <algorithm>
#include <cmath>

namespace meam
{
namespace
{
constexpr double AlignedAngle = 10.0; // degrees, between tangents of the scene and of the part that are alike
}

int PlaceEvidence::surface(PointState state) const
{
  const std::vector<PointState>& states = this->points.surfaceStates;
  return static_cast<int>(std::count(states.begin(), states.end(), state));
}

double PlaceEvidence::edgeShare() const
{
  return this->edges > 0 ? static_cast<double>(this->edgesMatched) / this->edges : 0.0;
}

double PlaceEvidence::surfaceShare(PointState state) const
{
  const int unhidden = static_cast<int>(this->points.surface.size()) - this->surface(PointState::Hidden);
  return unhidden > 0 ? static_cast<double>(this->surface(state)) / unhidden : 0.0;
}

PlaceEvidence evidenceAt(const Eigen::Isometry3d& T_scene_model, const Scene& scene, const TrainedModel& model,
  const EvidenceSettings& settings)
{
  EvidenceSettings everyEdge = settings;
  everyEdge.edgeStride = 1; // the edges that are predicted below
  const EvidenceCollector collector(scene, model, everyEdge);
  PlaceEvidence found;
  found.points = collector.collect(T_scene_model);
  found.behind = collector.shareBehind(T_scene_model);
  const auto visible = model.visibility->visible(T_scene_model, scene.sensor, scene.depth.pitch());
  const Eigen::Matrix3f turn = T_scene_model.linear().cast<float>();
  const double aligned = std::cos(AlignedAngle * M_PI / 180.0);
  for (std::size_t k = 0; k < found.points.edges.size(); ++k)
  {
    const PointState state = found.points.edgeStates[k];
    if (state == PointState::Hidden)
    {
      continue;
    }
    const Eigen::Vector3f& point = found.points.edges[k];
    const Eigen::Vector3f tangent = turn * visible->edges.directions[k];
    bool isAligned = false;
    scene.edgeGrid().forEachWithin(point, collector.tolerance(),
      [&](int edge, float) { isAligned |= std::abs(scene.edgePoints().tangents[edge].dot(tangent)) >= aligned; });
    ++found.edges;
    found.edgesNear += collector.nearEdge(point) ? 1 : 0;
    found.edgesMatched += state == PointState::Matched ? 1 : 0;
    found.edgesAligned += isAligned ? 1 : 0;
  }
  return found;
}
}
