// SPDX-License-Identifier: BSD-3-Clause
#include "pose/verification/PoseEvidence.h"

#include "base/Error.h"
#include "pose/PoseTolerances.h"
#include "pose/verification/ProbabilityCalibration.h"
#include "pose/verification/SheetSurface.h"

#include <algorithm>

namespace meam
{
namespace
{
constexpr double Noises = 1.5;        // of the scan: the tolerance is no less
constexpr double FarBehind = 0.1;     // of the diameter: what the sensor saw so far behind the part is far
constexpr double CloselyBefore = 0.1; // of the diameter: a surface that hides the part from nearer is close before it
constexpr float Flattest = 0.3f;      // cosine: the tolerance along the line of sight grows up to surfaces so flat
constexpr float Behind = 3.0f;        // tolerances: so far behind the bin's floor or a wall a part cannot reach
constexpr float BehindOfFlat = 0.4f;  // of the thickness of a flat part, the same, but no less than the tolerance
constexpr float Thinnest = 1.4f;      // tolerances: of thinner parts the floor does not tell
constexpr double Shown = 0.25;        // of its whole surface a body shows, on average over directions (Cauchy)
/// Sides of outline that a patch of surface has at most: those of a strip half a patch wide, as a thin sheet seen from
/// its edge. Where the sensor sees past one side of a narrower one it sees past the other, and such strips are
/// everywhere, as the rims and edges of other things.
constexpr double OutlineOfPatch = 4.0;
constexpr float OutlineTolerance = 1.5f; // tolerances: a surface beyond the outline that goes on,
constexpr float OutlineThickness = 0.6f; // and no more than so much of a thin part, which may lie on it,
constexpr double OutlineNoises = 3.0;    // but no less than so much noise of the scan,
constexpr double OutlineOfPose = 0.003;  // nor than so much of the diameter: poses are not exact

int count(const std::vector<PointState>& states, PointState state)
{
  return static_cast<int>(std::count(states.begin(), states.end(), state));
}
}

double PoseEvidence::score() const
{
  const auto& states = this->surface.empty() ? this->edgeStates : this->surfaceStates;
  const int inSight = static_cast<int>(states.size()) - count(states, PointState::Hidden);
  return inSight > 0 ? static_cast<double>(count(states, PointState::Matched)) / inSight : 0.0;
}

double PoseEvidence::visibleFraction() const
{
  const auto& states = this->surface.empty() ? this->edgeStates : this->surfaceStates;
  return states.empty() ? 0.0 : 1.0 - static_cast<double>(count(states, PointState::Hidden)) / states.size();
}

EvidenceCollector::EvidenceCollector(const Scene& scene, const TrainedModel& model, const EvidenceSettings& settings)
  : InScene(scene)
  , Model(model)
  , Settings(settings)
  , Tolerance(static_cast<float>(
      settings.tolerance > 0.0
        ? settings.tolerance
        : std::max(FitDistance * model.diameter, settings.followsNoise ? Noises * scene.quality.noise : 0.0)))
  , Beside(std::min(OutlineTolerance * Tolerance,
      std::max(OutlineThickness * model.thickness,
        static_cast<float>(std::max(OutlineNoises * scene.quality.noise, OutlineOfPose * model.diameter)))))
  , IsSheet(Beside < Tolerance)
{
}

bool EvidenceCollector::nearEdge(const Eigen::Vector3f& point) const
{
  return this->InScene.edgeGrid().nearest(point, this->Tolerance) >= 0;
}

PlaceOdds EvidenceCollector::placeOdds(const EvidenceCounts& counts, const EvidenceRates& rates, double searched) const
{
  return haveSurfaces(this->InScene, this->Model)
           ? meam::placeOdds(counts, rates, searched, this->Model.sheetThickness())
           : placeOddsOfEdges(counts);
}

double EvidenceCollector::logOdds(const EvidenceCounts& counts, const EvidenceRates& rates) const
{
  return haveSurfaces(this->InScene, this->Model) ? CalibrationWithSurface.logOdds(counts.sum(rates))
                                                  : CalibrationOfEdges.logOdds(counts.ofEdges(rates));
}

double EvidenceCollector::logOdds(
  const Eigen::Isometry3d& T_scene_model, const EvidenceRates& rates, std::size_t stride) const
{
  return this->logOdds(this->collect(T_scene_model, stride).counts, rates);
}

float EvidenceCollector::behindPlane() const
{
  // A flat part that lies in the floor reaches no deeper than it is thick, and less where its bosses or its rim make
  // its thickness. What lies on the floor may be taken for it where it is hardly thicker than the tolerance.
  const float thickness = this->Model.thickness, tolerance = this->Tolerance, most = Behind * tolerance;
  return -(thickness < Thinnest * tolerance ? most : std::clamp(BehindOfFlat * thickness, tolerance, most));
}

bool EvidenceCollector::isBehind(const Eigen::Vector3f& point) const
{
  const std::vector<Plane>& planes = this->InScene.enclosure;
  return std::any_of(planes.begin(), planes.end(),
    [&](const Plane& plane) { return plane.signedDistance(point) < this->behindPlane(); });
}

double EvidenceCollector::shareBehind(const Eigen::Isometry3d& T_scene_model, std::size_t stride) const
{
  const TrainedModel& model = this->Model;
  const PredictedVisibility& whole = *model.visibility;
  const Eigen::Isometry3f T = T_scene_model.cast<float>();
  double share = 0.0;
  for (const Plane& plane : this->InScene.enclosure)
  {
    const Plane inModel(T.linear().transpose() * plane.normal(), plane.signedDistance(T.translation()));
    if (inModel.signedDistance(whole.middle()) > whole.radius() + this->behindPlane())
    {
      continue;
    }
    std::size_t found = 0, all = 0;
    for (std::size_t k = 0; k < model.verificationPoints.size(); k += stride)
    {
      found += inModel.signedDistance(model.surface.points[model.verificationPoints[k]]) < this->behindPlane() ? 1 : 0;
      ++all;
    }
    share += all > 0 ? static_cast<double>(found) / static_cast<double>(all) : 0.0;
  }
  return std::min(share, 1.0);
}

double EvidenceCollector::closelyHidden(const Eigen::Isometry3d& T_scene_model) const
{
  if (!haveSurfaces(this->InScene, this->Model))
  {
    return 0.0;
  }
  const TrainedModel& model = this->Model;
  const DepthMap& depth = this->InScene.depth;
  const auto visible = this->predicted(T_scene_model, 1).visible;
  const Eigen::Isometry3f T = T_scene_model.cast<float>();
  const Eigen::Vector3f towards = T.linear() * model.visibility->towards(T_scene_model, this->InScene.sensor);
  const float close = static_cast<float>(CloselyBefore * model.diameter);
  const double patch = PatchSize * model.diameter;
  double area = 0.0; // as the sensor sees it
  for (std::size_t k = 0; k < visible->surface.size(); ++k)
  {
    const int i = visible->surface[k];
    const Eigen::Vector3f point = T * model.surface.points[i];
    const Eigen::Vector3f normal = T.linear() * model.surface.normals[i];
    const float cosine = normal.dot(towards);
    const float tolerance = this->Tolerance / std::max(cosine, Flattest);
    const bool isClose = visible->isInner[k] && cosine > 0.0f &&
                         depth.relationToMean(point, tolerance) == DepthMap::Relation::Hidden &&
                         depth.relationToMean(point, close) == DepthMap::Relation::OnSurface &&
                         depth.normalAt(point).dot(normal) >= FacingSurface;
    area += isClose ? model.verificationArea() * cosine : 0.0;
  }
  return area / (patch * patch);
}

EvidenceCollector::Predicted EvidenceCollector::predicted(
  const Eigen::Isometry3d& T_scene_model, std::size_t stride) const
{
  const double pitch = this->InScene.depth.pitch();
  return { T_scene_model, this->Model.visibility->visible(T_scene_model, this->InScene.sensor, pitch), stride };
}

PoseEvidence EvidenceCollector::collect(const Eigen::Isometry3d& T_scene_model, std::size_t stride) const
{
  const Predicted predicted = this->predicted(T_scene_model, stride);
  PoseEvidence evidence;
  this->addEdges(predicted, evidence);
  if (haveSurfaces(this->InScene, this->Model))
  {
    this->addSurface(predicted, evidence);
    this->addOutline(predicted, evidence);
  }
  return evidence;
}

void EvidenceCollector::addEdges(const Predicted& predicted, PoseEvidence& evidence) const
{
  const auto& [T_scene_model, visible, stride] = predicted;
  const Eigen::Isometry3f T = T_scene_model.cast<float>();
  const DepthMap& depth = this->InScene.depth;
  const float tolerance = this->Tolerance;
  const std::size_t edgeStride = stride * this->Settings.edgeStride;
  evidence.edges.reserve(visible->edges.size() / edgeStride + 1);
  evidence.edgeStates.reserve(visible->edges.size() / edgeStride + 1);
  for (std::size_t k = 0; k < visible->edges.size(); k += edgeStride)
  {
    const Eigen::Vector3f point = T * visible->edges.points[k];
    const Eigen::Vector3f tangent = T.linear() * visible->edges.directions[k];
    const int edge = this->InScene.edgeIndex.nearest(point, tangent, tolerance).edge;
    const bool matched = edge >= 0;
    // Violated also where no surface was measured: beside parts on no ground nothing else speaks against a pose. But
    // what was cut out of a scan may have hidden the part.
    const DepthMap::Relation relation = matched ? DepthMap::Relation::OnSurface : depth.relation(point, tolerance);
    const bool isCutOut = relation == DepthMap::Relation::NoSurface && this->InScene.quality.isCutOut();
    const PointState state = matched                                  ? PointState::Matched
                             : relation == DepthMap::Relation::Hidden ? PointState::Hidden
                             : isCutOut                               ? PointState::Unknown
                                                                      : PointState::Violated;
    const bool isOfBin = matched && this->InScene.isOnLongLine[edge];
    evidence.counts.edgesFound += matched && !isOfBin ? stride : 0.0;
    evidence.counts.edgesOfBin += isOfBin ? stride : 0.0;
    evidence.counts.edgesMissing += state == PointState::Violated ? stride : 0.0;
    evidence.edges.push_back(point);
    evidence.edgeStates.push_back(state);
  }
}

void EvidenceCollector::addSurface(const Predicted& predicted, PoseEvidence& evidence) const
{
  const auto& [T_scene_model, visible, stride] = predicted;
  const Eigen::Isometry3f T = T_scene_model.cast<float>();
  const TrainedModel& model = this->Model;
  const DepthMap& depth = this->InScene.depth;
  const float tolerance = this->Tolerance;
  const bool freeSpace = this->Settings.freeSpace;
  const auto stateOf = [&](DepthMap::Relation relation)
  {
    return relation == DepthMap::Relation::OnSurface                 ? PointState::Matched
           : relation == DepthMap::Relation::Hidden                  ? PointState::Hidden
           : relation == DepthMap::Relation::NoSurface || !freeSpace ? PointState::Unknown
                                                                     : PointState::Violated;
  };
  const float farBehind = std::max(tolerance, static_cast<float>(FarBehind * model.diameter));
  EvidenceCounts& counts = evidence.counts;
  const double patch = PatchSize * model.diameter;
  const double area = stride * model.verificationArea() / (patch * patch);
  const Eigen::Vector3f towards = T.linear() * model.visibility->towards(T_scene_model, this->InScene.sensor);
  const std::size_t size = (visible->surface.size() + stride - 1) / stride;
  evidence.surface.reserve(size);
  evidence.surfaceStates.reserve(size);
  for (std::size_t k = 0; k < visible->surface.size(); k += stride)
  {
    const int i = visible->surface[k];
    const Eigen::Vector3f point = T * model.surface.points[i];
    const Eigen::Vector3f normal = T.linear() * model.surface.normals[i];
    const float cosine = normal.dot(towards);
    const double seen = visible->isInner[k] ? area * std::max(cosine, 0.0f) : 0.0;
    PointState state = PointState::Violated;
    switch (depth.relationToMean(point, tolerance / std::max(cosine, Flattest)))
    {
      case DepthMap::Relation::OnSurface:
      {
        const Eigen::Vector3f measured = depth.normalAt(point);
        const bool isTurned = !measured.isZero() && measured.dot(normal) < FacingSurface;
        const bool isOfBin = this->IsSheet && SheetSurface::isOfBin(point, this->InScene, model);
        (isTurned ? counts.turned : measured.isZero() ? counts.unclear : counts.there) += isOfBin ? 0.0 : seen;
        state = isTurned ? PointState::Turned : PointState::Matched;
        break;
      }
      case DepthMap::Relation::Hidden:
        counts.hidden += seen;
        state = PointState::Hidden;
        break;
      case DepthMap::Relation::NoSurface:
        state = stateOf(depth.relation(point, tolerance)); // what is beside a gap of one cell
        counts.unmeasured += state == PointState::Unknown ? seen : 0.0;
        break;
      case DepthMap::Relation::InFront:
      {
        const bool isFar = depth.relationToMean(point, farBehind) == DepthMap::Relation::InFront;
        const float fall = visible->falls[k];
        const bool isPartBeside =
          fall > 0.0f && depth.relationToMean(point, fall + tolerance) == DepthMap::Relation::OnSurface;
        const bool saysNothing = !freeSpace || isPartBeside;
        (saysNothing ? counts.unmeasured : isFar ? counts.farPast : counts.past) += seen;
        state = saysNothing ? PointState::Unknown : PointState::Violated;
        break;
      }
    }
    counts.inSight += state == PointState::Hidden ? 0.0 : area * std::max(cosine, 0.0f);
    evidence.surface.push_back(point);
    evidence.surfaceStates.push_back(state);
  }
}

void EvidenceCollector::addOutline(const Predicted& predicted, PoseEvidence& evidence) const
{
  EvidenceCounts& counts = evidence.counts;
  const auto& [T_scene_model, visible, stride] = predicted;
  const Eigen::Isometry3f T = T_scene_model.cast<float>();
  const TrainedModel& model = this->Model;
  const DepthMap& depth = this->InScene.depth;
  const double patch = PatchSize * model.diameter;
  std::optional<SheetSurface> sheet;
  if (this->IsSheet)
  {
    sheet.emplace(this->InScene, model, T_scene_model, *visible, this->Tolerance, stride);
  }
  const double side = stride * model.visibility->cellSize() / patch;
  double under = 0.0; // of the outline, what a floor or a wall covers
  for (std::size_t k = 0; k < visible->outside.size(); k += stride)
  {
    const Eigen::Vector3f atPose = T * visible->outside[k];
    const Eigen::Vector3f point = sheet ? sheet->onMeasured(atPose) : atPose;
    const DepthMap::Relation relation = depth.relationToMean(point, this->Beside);
    counts.goesOn += relation == DepthMap::Relation::OnSurface ? side : 0.0;
    under += relation == DepthMap::Relation::Hidden && this->isBehind(point) ? side : 0.0;
    const bool ends = relation == DepthMap::Relation::InFront ||
                      (relation == DepthMap::Relation::NoSurface && depth.covers(point, static_cast<float>(patch)));
    counts.ends += ends && this->InScene.longLines.nearest(point, OutlineTolerance * this->Tolerance) < 0 ? side : 0.0;
  }
  // What ends all around may be the part's own face, as of parts side by side on no floor. Outline that is covered goes
  // on below.
  const double covered = counts.goesOn + under;
  const double outline = counts.ends + covered;
  const double goesOn = outline > 0.0 ? covered / outline : 1.0;
  if (goesOn > 0.0)
  {
    counts.enclosed = goesOn * Shown * this->shareBehind(T_scene_model, stride) *
                      static_cast<double>(model.verificationPoints.size()) * model.verificationArea() / (patch * patch);
  }
  const double most = OutlineOfPatch * counts.inSight, telling = counts.ends + counts.goesOn;
  if (telling > most)
  {
    counts.ends *= most / telling;
    counts.goesOn *= most / telling;
  }
}
}
