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
  Turned,  ///< there is a surface, but it faces elsewhere
  Hidden,  ///< something lies in front of it: says nothing about the pose
  Unknown, ///< surface where nothing was measured: says nothing about the pose by itself
  Violated ///< the sensor saw past it: speaks against the pose
};

/// What each kind of measurement says for a pose: the logarithm of how much likelier it is with the part there than
/// with anything else, up to a common factor. Neighbours tell the same: what counts is how many patches they fill.
struct EvidenceWeights
{
  double patch = 0.1;       ///< of the diameter, the side of a square, as the sensor sees it, that counts once
  double there = 1.0;       ///< a patch of surface where it should be, that faces the right way
  double unclear = 0.5;     ///< where it should be, with too little around it to tell which way it faces
  double turned = -1.0;     ///< where it should be, that faces elsewhere
  double past = -5.0;       ///< that the sensor looked past
  double hidden = -0.3;     ///< with something before it: copies that lie deep are rarely right
  double unmeasured = -0.3; ///< where nothing was measured; gaps of one cell of the depth map do not count
  double goesOn = -1.0; ///< a patch's side of outline beyond which the measured surface goes on as if it were the part
  double edge = 0.2;    ///< of the logarithm that edges say, by the scan's own rates (EdgeRates), of one edge point
};

/// What counts when poses are scored.
struct EvidenceSettings
{
  FitLengths lengths;
  double tolerance = 0.0; ///< mm, a model point this near to the scene fits; 0: lengths.fits of the diameter,
  double noises = 1.5;    ///< and no less than so many times the scan's noise
  EvidenceWeights weights;
  bool freeSpace = true; ///< surface that the sensor saw past speaks against a pose; else it says nothing
  double facing = 0.8;   ///< cosine between the part's normal and the measured one, from which on the surface fits
  double flattest = 0.3; ///< cosine: the tolerance along the line of sight grows up to surfaces seen so flatly
  double outlineTolerance = 1.5;      ///< times the tolerance: a surface beyond the outline that goes on
  int edgeStride = 2;                 ///< of the visible edge points one of so many: neighbours tell the same
  ProbabilityCalibration calibration; ///< of these weights
};

/// How often a predicted edge point finds an edge in this scan.
struct EdgeRates
{
  double found = 0.75; ///< where the part is: of glossy parts, or of parts on parts of the same colour, few
  double chance = 0.3; ///< anywhere
};

struct EdgeRatesSettings
{
  EdgeRates usual;
  double usualPoints = 500.0;  ///< so many edge points the usual rates count: of few candidates nothing can be told
  double supportedShare = 0.1; ///< of the candidates, those that most speaks for
  double firstGain = 3.0;      ///< times the chance, but no more than usual: found, before anything is known
  double mostOfEdges = 10.0;   ///< that edges say for or against a candidate here: what is to be found has no last word
  int steps = 2;               ///< of what speaks for which candidates, and what that says of the edges
  double leastGain = 0.02;     ///< that an edge is found more often where the part is
};

/// What was counted of a pose.
struct EvidenceCounts
{
  // Areas as the sensor sees them, in patches
  double there = 0.0, unclear = 0.0, turned = 0.0, past = 0.0, hidden = 0.0, unmeasured = 0.0;
  double goesOn = 0.0; ///< length of outline, in sides of a patch
  // Edge points
  double edgesFound = 0.0, edgesMissing = 0.0;

  /// What the surface says.
  double ofSurface(const EvidenceWeights& weights) const;
  /// What the edges say.
  double ofEdges(const EvidenceWeights& weights, const EdgeRates& rates) const;
  /// All together.
  double sum(const EvidenceWeights& weights, const EdgeRates& rates) const;
};

/// The rates of a scan, from what was counted of its candidates, in turns (expectation maximization): of all candidates
/// most are wrong; those that most speaks for, by the rates of the turn before, are mostly right.
EdgeRates edgeRates(const std::vector<EvidenceCounts>& candidates, const EvidenceWeights& weights,
  const EdgeRatesSettings& settings = {});

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
  /// Whether a scene edge point lies within the tolerance of a point: the paper's test of fit.
  bool nearEdge(const Eigen::Vector3f& point) const;

private:
  const Scene& InScene;
  const TrainedModel& Model;
  EvidenceSettings Settings;
  float Tolerance; ///< mm
};
}
