// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/SoAPoints.h"
#include "model/PredictedVisibility.h"
#include "model/TrainedModel.h"
#include "pose/verification/PlaceOdds.h"
#include "scene/Scene.h"

#include <memory>
#include <optional>

namespace meam
{
/// What the sensor saw of one point that a pose predicts to be visible.
enum class PointState : unsigned char
{
  Matched, ///< it is there
  Turned,  ///< there is a surface, but it faces elsewhere
  Hidden,  ///< something lies in front of it: says nothing about the pose
  Unknown, ///< nothing was measured there, or just the part's own lower side beside: says nothing about the pose by
           ///< itself
  Violated ///< the sensor saw past it: speaks against the pose
};

/// What counts when poses are scored.
struct EvidenceSettings
{
  /// mm, a model point this near to the scene fits; 0: FitDistance of the diameter, and no less than 1.5 times the
  /// scan's noise.
  double tolerance = 0.0;
  std::optional<EvidenceRates> rates; ///< of the scan, when they are known; else the poses tell them
  bool followsNoise = true;           ///< that tolerance, when it is not given
  bool freeSpace = true;              ///< surface that the sensor saw past speaks against a pose; else it says nothing
  int edgeStride = 2;                 ///< of the visible edge points one of so many: neighbours tell the same
};

/// Of the points a pose predicts to be visible those that it is verified on, local frame (mm), and what became of each.
struct PoseEvidence
{
  Points edges;
  std::vector<PointState> edgeStates;
  Points surface;
  std::vector<PointState> surfaceStates;
  EvidenceCounts counts;

  /// Of the surface that nothing hides the share that was measured where it should be; without a surface, of the edges;
  /// [0, 1].
  double score() const;
  /// Share of the predicted points that nothing hides, [0, 1].
  double visibleFraction() const;
};

/// Whether the scene and the model have surfaces, so that poses are verified by them; otherwise by edges alone.
inline bool haveSurfaces(const Scene& scene, const TrainedModel& model)
{
  return scene.hasSurface() && !model.surface.empty();
}

/// Collects the evidence for and against poses of a part. Keeps references; calls may run in parallel.
class EvidenceCollector
{
public:
  EvidenceCollector(const Scene& scene, const TrainedModel& model, const EvidenceSettings& settings = {});
  /// Of every `stride`-th of the surface points that the pose predicts, and of half as many of the edge points.
  PoseEvidence collect(const Eigen::Isometry3d& T_scene_model, std::size_t stride = 1) const;
  /// What the counts say of a final pose, of which logOdds() or the search has `searched`, kind by kind.
  PlaceOdds placeOdds(const EvidenceCounts& counts, const EvidenceRates& rates, double searched) const;
  /// What poses are searched for by: logarithm of the odds that the part is where this was counted.
  double logOdds(const EvidenceCounts& counts, const EvidenceRates& rates) const;
  /// The same of what is counted at a pose.
  double logOdds(const Eigen::Isometry3d& T_scene_model, const EvidenceRates& rates, std::size_t stride = 1) const;
  /// The share of the part's whole surface, seen or not, that lies behind the bin's floor or a wall, [0, 1].
  double shareBehind(const Eigen::Isometry3d& T_scene_model, std::size_t stride = 1) const;
  /// Patches of what the pose predicts, as the sensor sees them, that are hidden by a surface close before them which
  /// faces the same way: it may be the part's own.
  double closelyHidden(const Eigen::Isometry3d& T_scene_model) const;
  /// Whether a scene edge point lies within the tolerance of a point: the paper's test of fit.
  bool nearEdge(const Eigen::Vector3f& point) const;
  /// How near to the scene a model point fits, mm.
  float tolerance() const { return this->Tolerance; }
  double sheetThickness() const { return this->Model.sheetThickness(); }

private:
  /// What a pose predicts to be visible; every `stride`-th point of it is looked at.
  struct Predicted
  {
    Eigen::Isometry3d T_scene_model;
    std::shared_ptr<const PredictedVisibility::Visible> visible;
    std::size_t stride;
  };
  Predicted predicted(const Eigen::Isometry3d& T_scene_model, std::size_t stride) const;
  void addEdges(const Predicted& predicted, PoseEvidence& evidence) const;
  void addSurface(const Predicted& predicted, PoseEvidence& evidence) const;
  /// Sides of the outline, and the part of the body that lies behind floor and walls.
  void addOutline(const Predicted& predicted, PoseEvidence& evidence) const;

  /// mm; less than nothing: so far behind the bin's floor or a wall.
  float behindPlane() const;
  bool isBehind(const Eigen::Vector3f& point) const;

  const Scene& InScene;
  const TrainedModel& Model;
  EvidenceSettings Settings;
  float Tolerance; ///< mm
  float Beside;    ///< mm, of a surface beside the outline that goes on
  bool IsSheet;    ///< what it lies on may be within the tolerance: SheetSurface
};
}
