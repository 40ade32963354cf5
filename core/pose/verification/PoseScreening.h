// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/Error.h"
#include "model/TrainedModel.h"
#include "pose/Pose.h"
#include "scene/Scene.h"

#include <vector>

namespace meam
{
struct PoseScreeningSettings
{
  double leastSurface = 0.5; ///< share of the pose's surface towards the sensor that has to be there
  int enough = 100;          ///< of so many candidates or fewer none has to go for want of surface
  bool freeSpace = true;     ///< surface that the sensor saw past counts as missing; else as not measured
  int threads = 0;           ///< 0: one for each processor
};

/// Pre-screening of raw candidates, at a fraction of the cost of a score: of duplicates the one with most votes times
/// the share of its surface that is there stays, those whose surface is not there go, and each that stays is turned by
/// the approximate symmetry that the scene's edges speak for. Candidates that any rotation of a nearly round part makes
/// equal are duplicates, too. In the order they come, in the local frame. Without a surface only duplicates go.
Poses screenPoses(const Poses& candidates, const Scene& scene, const TrainedModel& model,
  const PoseScreeningSettings& settings = {}, const Progress& progress = {});

/// The share of each pose's surface towards the sensor that is there, [0, 1], as screening finds it: of what nothing
/// hides, and of what was not measured a half. 1 without a surface.
std::vector<double> surfaceShares(
  const Poses& poses, const Scene& scene, const TrainedModel& model, const PoseScreeningSettings& settings = {});
}
