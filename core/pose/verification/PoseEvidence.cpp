// SPDX-License-Identifier: BSD-3-Clause
#include "pose/verification/PoseEvidence.h"

#include "base/Error.h"

#include <algorithm>
#include <iterator>

namespace meam
{
namespace
{
int count(const std::vector<PointState>& states, PointState state)
{
  return static_cast<int>(std::count(states.begin(), states.end(), state));
}

/// matched / (matched + violated), 0 when there is neither.
double share(const std::vector<PointState>& states)
{
  const int matched = count(states, PointState::Matched);
  const int violated = count(states, PointState::Violated);
  return matched > 0 ? static_cast<double>(matched) / (matched + violated) : 0.0;
}
}

void requireWeights(const EvidenceSettings& settings)
{
  const Eigen::Array3d weights(settings.edgeWeight, settings.surfaceWeight, settings.explainedWeight);
  if (!(weights.allFinite() && weights.minCoeff() >= 0.0 && weights.sum() > 0.0))
  {
    throw Error(
      "The weights of edges, surface and explained scene edges must be 0 or more, and one of them more than 0.");
  }
}

double PoseEvidence::score(const EvidenceSettings& settings) const
{
  const int near = this->explained + this->unexplained;
  const double clean = near > 0 ? static_cast<double>(this->explained) / near : 0.0;
  if (this->surface.empty())
  {
    return share(this->edgeStates);
  }
  // The surface has a say as far as it was measured: one point that fits in a gap of the scan is no whole surface.
  const int unknown = count(this->surfaceStates, PointState::Unknown);
  const int inSight = static_cast<int>(this->surfaceStates.size()) - count(this->surfaceStates, PointState::Hidden);
  const double measured = unknown > 0 ? 1.0 - static_cast<double>(unknown) / inSight : 1.0;
  const double surfaceWeight = settings.surfaceWeight * measured;
  const double sum = settings.edgeWeight + surfaceWeight + settings.explainedWeight;
  const double there = settings.edgeWeight * share(this->edgeStates) + surfaceWeight * share(this->surfaceStates) +
                       settings.explainedWeight * clean;
  return sum > 0.0 ? there / sum : 0.0;
}

double PoseEvidence::visibleFraction() const
{
  const auto& states = this->surface.empty() ? this->edgeStates : this->surfaceStates;
  return states.empty() ? 0.0 : 1.0 - static_cast<double>(count(states, PointState::Hidden)) / states.size();
}

Points PoseEvidence::matched() const
{
  const bool bySurface = !this->surface.empty();
  const Points& points = bySurface ? this->surface : this->edges;
  const std::vector<PointState>& states = bySurface ? this->surfaceStates : this->edgeStates;
  Points result;
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    if (states[i] == PointState::Matched)
    {
      result.push_back(points[i]);
    }
  }
  return result;
}

EvidenceCollector::EvidenceCollector(const Scene& scene, const TrainedModel& model, const EvidenceSettings& settings)
  : InScene(scene)
  , Model(model)
  , Settings(settings)
  , Tolerance(
      static_cast<float>(settings.tolerance > 0.0 ? settings.tolerance : settings.lengths.fits * model.diameter))
{
  requireWeights(settings);
}

bool EvidenceCollector::nearEdge(const Eigen::Vector3f& point) const
{
  return this->InScene.edgeGrid().nearest(point, this->Tolerance) >= 0;
}

PoseEvidence EvidenceCollector::collect(const Eigen::Isometry3d& T_scene_model, std::size_t stride) const
{
  const Eigen::Isometry3f T = T_scene_model.cast<float>();
  const TrainedModel& model = this->Model;
  const DepthMap& depth = this->InScene.depth;
  const auto visible = model.visibility->visible(T_scene_model, this->InScene.sensor);
  const float tolerance = this->Tolerance;
  PoseEvidence evidence;
  for (std::size_t k = 0; k < visible->edges.size(); k += stride * this->Settings.edgeStride)
  {
    const int i = visible->edges[k];
    const Eigen::Vector3f point = T * model.edges.points[i];
    const Eigen::Vector3f tangent = T.linear() * model.edges.tangents[i];
    const bool matched = this->InScene.edgeIndex.nearest(point, tangent, tolerance).edge >= 0;
    // Also where no surface was measured: beside parts on no ground nothing else speaks against a pose.
    const PointState state = matched                                                          ? PointState::Matched
                             : depth.relation(point, tolerance) == DepthMap::Relation::Hidden ? PointState::Hidden
                                                                                              : PointState::Violated;
    evidence.edges.push_back(point);
    evidence.edgeStates.push_back(state);
  }
  if (!haveSurfaces(this->InScene, model))
  {
    return evidence;
  }
  SoAPoints surface;
  surface.resize((visible->surface.size() + stride - 1) / stride);
  evidence.surface.reserve(surface.size());
  evidence.surfaceStates.reserve(surface.size());
  for (std::size_t k = 0; k < surface.size(); ++k)
  {
    const Eigen::Vector3f& point = model.surface.points[visible->surface[k * stride]];
    surface.set(k, point);
    evidence.surface.push_back(T * point);
  }
  std::vector<DepthMap::Relation> relations(surface.size());
  depth.relations(T, surface, 0, static_cast<int>(surface.size()), tolerance, relations.data());
  std::transform(relations.begin(), relations.end(), std::back_inserter(evidence.surfaceStates),
    [this](DepthMap::Relation relation)
    {
      return relation == DepthMap::Relation::OnSurface                                ? PointState::Matched
             : relation == DepthMap::Relation::Hidden                                 ? PointState::Hidden
             : relation == DepthMap::Relation::NoSurface || !this->Settings.freeSpace ? PointState::Unknown
                                                                                      : PointState::Violated;
    });
  // Scene edges on the part's surface: those that no edge of the part explains speak against the pose.
  const Eigen::Isometry3f toModel = T.inverse();
  const PointGrid& sceneEdges = this->InScene.edgeGrid();
  const Eigen::Vector3f middle = T * model.surfaceDistance.middle();
  const float radius = model.surfaceDistance.radius();
  // Distances beyond the truncation are not told.
  const float truncation = static_cast<float>(TrainedModel::TruncationDistance * model.diameter);
  const float onSurface = std::min(static_cast<float>(this->Settings.onSurface) * tolerance, truncation);
  const float onEdge = std::min(tolerance, truncation);
  sceneEdges.forEachBlock(middle, radius,
    [&](int begin, int count)
    {
      float fromSurface[SoABlock], fromEdges[SoABlock];
      model.surfaceDistance.at(toModel, sceneEdges.sorted(), begin, count, fromSurface);
      model.edgeDistance.at(toModel, sceneEdges.sorted(), begin, count, fromEdges);
      for (int k = 0; k < count; ++k)
      {
        // Blocks reach beyond the ball about the part.
        if (fromSurface[k] < onSurface && (sceneEdges.sorted()[begin + k] - middle).norm() <= radius)
        {
          ++(fromEdges[k] < onEdge ? evidence.explained : evidence.unexplained);
        }
      }
    });
  return evidence;
}
}
