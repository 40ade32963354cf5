// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/SoAPoints.h"
#include "model/PredictedVisibility.h"
#include "model/TrainedModel.h"
#include "pose/FitLengths.h"
#include "pose/verification/EvidenceCounts.h"
#include "pose/verification/ProbabilityCalibration.h"
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
  FitLengths lengths;
  double tolerance = 0.0; ///< mm, a model point this near to the scene fits; 0: lengths.fits of the diameter,
  double noises = 1.5;    ///< and no less than so many times the scan's noise
  EvidenceWeights weights;
  std::optional<EvidenceRates> rates; ///< of the scan, when they are known; else the poses tell them
  bool freeSpace = true;              ///< surface that the sensor saw past speaks against a pose; else it says nothing
  double facing = 0.8;        ///< cosine between the part's normal and the measured one, from which on the surface fits
  double farBehind = 0.1;     ///< of the diameter: what the sensor saw so far behind the part is far
  double closelyBefore = 0.1; ///< of the diameter: a surface that hides the part from nearer is close before it
  double flattest = 0.3;      ///< cosine: the tolerance along the line of sight grows up to surfaces seen so flatly
  double behind = 3.0;        ///< times the tolerance: so far behind the bin's floor or a wall a part cannot reach
  double shown = 0.25; ///< of its whole surface a body shows, on average over directions (Cauchy): its patches behind
  double outlineTolerance = 1.5;      ///< times the tolerance: a surface beyond the outline that goes on
  int edgeStride = 2;                 ///< of the visible edge points one of so many: neighbours tell the same
  ProbabilityCalibration calibration; ///< of these weights
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
  /// The points that are there: of the surface, without one of the edges.
  Points matched() const;
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
  /// The same as collect(T).matched(); edges are looked at only where no surface is predicted, the outline never.
  Points matchedPoints(const Eigen::Isometry3d& T_scene_model) const;
  /// Logarithm of the odds that the part is where this was counted.
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
  void addOutline(const Predicted& predicted, EvidenceCounts& counts) const;

  /// mm; less than nothing: so far behind the bin's floor or a wall.
  float behindPlane() const { return -static_cast<float>(this->Settings.behind) * this->Tolerance; }
  bool isBehind(const Eigen::Vector3f& point) const;

  const Scene& InScene;
  const TrainedModel& Model;
  EvidenceSettings Settings;
  float Tolerance; ///< mm
};
}
