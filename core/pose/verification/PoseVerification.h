// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/Error.h"
#include "pose/Pose.h"
#include "pose/PoseMemory.h"
#include "pose/verification/PoseEvidence.h"

namespace meam
{
enum class VerificationMethod
{
  EdgeCoverage,    ///< Section 5.2 of the paper: share of the edge appearance model that fits the scene
  VisibleEvidence, ///< edges and surface that should be visible, against what the sensor saw
  Votes            ///< of all poses that agree with one, as a share of the most: no look at the scene ([12], [23])
};

struct PoseVerificationSettings
{
  VerificationMethod method = VerificationMethod::VisibleEvidence;
  EvidenceSettings evidence; ///< of EdgeCoverage the tolerance, the rest of VisibleEvidence
  int pointStride = 1;       ///< of the predicted points one of so many is looked at: 2 is enough for candidates
  int posesPerView = 0;      ///< N_pv: best poses kept for each appearance model; 0: no limit
  int threads = 0;           ///< 0: one for each processor
};

/// What was seen at a pose: of its evidence what counts when it is scored.
struct SeenAtPose
{
  EvidenceCounts counts;
  double score;
  double visibleFraction;
  int viewId;
};
using EvidenceMemory = PoseMemory<SeenAtPose>;

/// The recommended settings before refinement.
PoseVerificationSettings candidateVerificationSettings();

/// Scores every pose against the scene, or by its votes, which become those of all that agree with it, and returns them
/// best first, in the local frame: score, probability, visible
/// fraction, and the view that shows what the sensor sees. Without a surface only edges count. `rates`, which may be
/// null, gets how far the scan's edges and outlines can be trusted; the paper's score does not ask. `memory`, which may
/// be null, is of calls with the same scene, model and settings: what it knows is not looked at again.
Poses verifyPoses(const Poses& poses, const Scene& scene, const TrainedModel& model,
  const PoseVerificationSettings& settings = {}, const Progress& progress = {}, EvidenceRates* rates = nullptr,
  EvidenceMemory* memory = nullptr);

/// The appearance model of a pose: its own, when it names one, otherwise the nearest to the sensor.
int viewOf(const Pose& pose, const Scene& scene, const TrainedModel& model);

/// Sets score, visible fraction and view by the evidence collected at the pose.
void setSeen(Pose& pose, const PoseEvidence& evidence, const Scene& scene, const TrainedModel& model);
/// Sets evidence and probabilities by the log odds that a copy is there and the pose's certainty.
void setEvidence(Pose& pose, double logOdds);

/// The rates of a scene: those that are known, or by candidates of a part, every `stride`-th point of each.
EvidenceRates evidenceRatesOf(const Poses& candidates, const EvidenceCollector& collector,
  const EvidenceSettings& settings, std::size_t stride, int threads);
}
