// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/Preset.h"
#include "features/TangentEstimation.h"
#include "pose/refinement/PoseRefinement.h"
#include "pose/verification/PoseVerification.h"
#include "pose/voting/PoseDetection.h"

namespace meam
{
struct DetectionSettings
{
  TangentEstimationSettings tangents;
  PoseDetectionSettings detection;
  PoseVerificationSettings verification; ///< of the raw candidates
  PoseRefinementSettings refinement;
  PoseVerificationSettings selection;    ///< of the refined poses: one for each instance
};

/// `maximumPoses` is the number of poses wanted, 0 for all, and `minimumProbability` that of each; `threads` 0 for one
/// for each processor.
DetectionSettings detectionSettings(
  Preset preset, int maximumPoses = 5, int threads = 0, double minimumProbability = 0.0);

/// Seconds spent in each stage of the online phase.
struct StageTimes
{
  double tangents = 0.0;
  double detection = 0.0;
  double verification = 0.0;
  double refinement = 0.0;
  double selection = 0.0;
};

/// The online phase, from edge points without tangents, as extracted, to ranked poses. The surface may be empty; all
/// poses, `edges` and `sensor` are in the scene's coordinates (mm). Of many raw candidates a third may be refined, also when
/// these are more than settings.verification.maximumPoses. `times` may be null.
Poses estimatePoses(const TrainedModel& model, const PreciseCloud& edges, FramedPoints surface, const Sensor& sensor,
  const DetectionSettings& settings, StageTimes* times = nullptr, const Progress& progress = {});
}
