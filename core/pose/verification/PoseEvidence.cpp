// SPDX-License-Identifier: BSD-3-Clause
#include "pose/verification/PoseEvidence.h"

#include "base/Error.h"

#include <algorithm>
#include <iterator>
#include <utility>

namespace meam
{
namespace
{
constexpr double SurfaceReachShare = 0.04; // of the diameter: a little over the spacing of judged points
constexpr float OnSurface = 0.7f;          // tolerances within which a scene edge lies on the part

constexpr std::size_t EdgeStride = 2; // of the visible edge points: neighbours tell the same
constexpr int GlanceStride = 3; // of the judged points

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
    throw Error("The weights of edges, surface and explained scene edges must be 0 or more, and one of them more than 0.");
  }
}

double PoseEvidence::support(const EvidenceSettings& settings) const
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

EvidenceCollector::EvidenceCollector(const SceneIndex& index, double tolerance, const EvidenceSettings& settings)
  : Index(index)
  , Tolerance(tolerance)
  , FreeSpace(settings.freeSpace)
{
  const std::vector<int>& judged = index.model.judged;
  for (std::size_t k = 0; k < judged.size(); k += GlanceStride)
  {
    this->Glanced.add(index.model.surface.points[judged[k]], index.model.surface.normals[judged[k]]);
  }
}

PoseEvidence EvidenceCollector::collect(const Eigen::Isometry3d& T_scene_model, std::size_t stride) const
{
  const Eigen::Isometry3f T = T_scene_model.cast<float>();
  const TrainedModel& model = this->Index.model;
  const DepthMap& depth = this->Index.depth;
  const auto visible = this->Index.view.visible(T_scene_model, this->Index.scene.sensor);
  const float tolerance = static_cast<float>(this->Tolerance);
  PoseEvidence evidence;
  for (std::size_t k = 0; k < visible->edges.size(); k += stride * EdgeStride)
  {
    const int i = visible->edges[k];
    const Eigen::Vector3f point = T * model.edges.points[i];
    const Eigen::Vector3f tangent = T.linear() * model.edges.tangents[i];
    const bool matched = this->Index.lines.nearest(point, tangent, tolerance).edge >= 0;
    // Also where no surface was measured: beside parts on no ground nothing else speaks against a pose.
    const PointState state = matched ? PointState::Matched
      : depth.relation(point, tolerance) == DepthMap::Relation::Hidden ? PointState::Hidden
                                                                             : PointState::Violated;
    evidence.edges.push_back(point);
    evidence.edgeStates.push_back(state);
  }
  if (!this->Index.hasSurfaces())
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
      return relation == DepthMap::Relation::OnSurface                  ? PointState::Matched
        : relation == DepthMap::Relation::Hidden                        ? PointState::Hidden
        : relation == DepthMap::Relation::NoSurface || !this->FreeSpace ? PointState::Unknown
                                                                        : PointState::Violated;
    });
  // Scene edges on the part's surface: those that no edge of the part explains speak against the pose.
  const Eigen::Isometry3f toModel = T.inverse();
  const PointGrid& sceneEdges = this->Index.edges;
  const Eigen::Vector3f middle = T * model.surfaceDistance.middle();
  const float radius = model.surfaceDistance.radius();
  const float reach = static_cast<float>(TrainedModel::DistanceReach * model.diameter); // distances beyond are not told
  const float onSurface = std::min(OnSurface * tolerance, reach), onEdge = std::min(tolerance, reach);
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

double EvidenceCollector::glance(const Eigen::Isometry3d& T_scene_model) const
{
  const Eigen::Isometry3f T = T_scene_model.cast<float>();
  const Eigen::Vector3f towards = this->Index.view.towards(T_scene_model, this->Index.scene.sensor);
  const auto& [x, y, z] = this->Glanced.directions;
  const int size = static_cast<int>(this->Glanced.size());
  DepthMap::Relation relations[SoABlock];
  int matched = 0, violated = 0, unknown = 0;
  for (int begin = 0; begin < size; begin += SoABlock)
  {
    const int count = std::min(SoABlock, size - begin);
    this->Index.depth.relations(
      T, this->Glanced.points, begin, count, static_cast<float>(this->Tolerance), relations);
    for (int k = 0; k < count; ++k)
    {
      const bool isFacing =
        x[begin + k] * towards.x() + y[begin + k] * towards.y() + z[begin + k] * towards.z() > 0.0f;
      const DepthMap::Relation relation = relations[k];
      matched += isFacing & (relation == DepthMap::Relation::OnSurface);
      violated += isFacing & (relation == DepthMap::Relation::InFront);
      unknown += isFacing & (relation == DepthMap::Relation::NoSurface);
    }
  }
  if (!this->FreeSpace)
  {
    unknown += std::exchange(violated, 0);
  }
  const int inSight = matched + violated + unknown;
  return inSight > 0 ? (matched + 0.5 * unknown) / inSight : 0.0;
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
