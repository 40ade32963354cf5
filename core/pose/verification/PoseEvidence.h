// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/SoAPoints.h"
#include "model/TrainedModel.h"
#include "pose/FitLengths.h"
#include "pose/verification/ProbabilityCalibration.h"
#include "scene/Scene.h"

namespace meam
{
/// What the sensor saw of one point that a pose predicts to be visible.
enum class PointState : unsigned char
{
  Matched, ///< it is there
  Hidden,  ///< something lies in front of it: says nothing about the pose
  Unknown, ///< surface where nothing was measured: says nothing about the pose by itself
  Violated ///< the sensor saw past it: speaks against the pose
};

/// What counts when poses are scored.
struct EvidenceSettings
{
  FitLengths lengths;
  double tolerance = 0.0; ///< mm, a model point this near to the scene fits; 0: lengths.fits of the diameter
  /// What each kind of evidence counts in the score, 0 or more, not all 0: edges, surface, and that scene edges on the
  /// part are explained. Without a surface edges alone count.
  double edgeWeight = 0.4;
  double surfaceWeight = 0.4;
  double explainedWeight = 0.2;
  bool freeSpace = true; ///< surface that the sensor saw past speaks against a pose; else it says nothing
  /// Scene edges within so many tolerances of the part's surface are on the part: those a little off it are others'.
  double onSurface = 0.7;
  int edgeStride = 2;                 ///< of the visible edge points one of so many: neighbours tell the same
  ProbabilityCalibration calibration; ///< of these weights
};

/// Throws Error when the weights make no score.
void requireWeights(const EvidenceSettings& settings);

/// Of the points a pose predicts to be visible those that it is verified on, local frame (mm), and what became of each.
struct PoseEvidence
{
  Points edges;
  std::vector<PointState> edgeStates;
  Points surface;
  std::vector<PointState> surfaceStates;
  int explained = 0;   ///< scene edge points on the part's visible surface that are edges of the part
  int unexplained = 0; ///< those that are not

  /// Share of what should be visible that is there: edges, surface and explained scene edges, [0, 1]. The surface
  /// counts in proportion to how much of what nothing hides was measured.
  double score(const EvidenceSettings& settings = {}) const;
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
  /// Whether a scene edge point lies within the tolerance of a point: the paper's test of fit.
  bool nearEdge(const Eigen::Vector3f& point) const;

private:
  const Scene& InScene;
  const TrainedModel& Model;
  EvidenceSettings Settings;
  float Tolerance; ///< mm
};
}
