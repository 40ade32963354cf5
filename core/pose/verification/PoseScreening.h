// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/Error.h"
#include "pose/Pose.h"
#include "pose/verification/PoseEvidence.h"
#include "pose/verification/RotationSearch.h"

#include <vector>

namespace meam
{
struct PoseScreeningSettings
{
  EvidenceSettings evidence; ///< only tolerance, lengths and freeSpace count; noise does not widen the tolerance
  RotationSearchSettings rotation;
  double leastSurface = 0.5; ///< share of the pose's surface towards the sensor that has to be there
  double unmeasured = 0.5;   ///< of a point that is there: what one counts where nothing was measured
  int enough = 100;          ///< of so many candidates or fewer none has to go for want of surface
  double distance = 0.0;     ///< mm, candidates nearer to each other are duplicates; 0: 4 % of the diameter
  double distanceShare = 0.04;
  double angle = 6.0;  ///< and those turned less than this (degrees)
  int pointStride = 3; ///< of the verification points one of so many is looked at
  int threads = 0;     ///< 0: one for each processor
};

/// Pre-screening of raw candidates, at a fraction of the cost of a score: of duplicates the one with most votes times
/// the share of its surface that is there stays, those whose surface is not there go, and each that stays is turned by
/// the approximate symmetry that the scene's edges speak for. Candidates that any rotation of a nearly round part makes
/// equal are duplicates, too. In the order they come, in the local frame. Without a surface only duplicates go.
Poses screenPoses(const Poses& candidates, const Scene& scene, const TrainedModel& model,
  const PoseScreeningSettings& settings = {}, const Progress& progress = {});

/// The share of each pose's surface towards the sensor that is there, [0, 1], as screening finds it: of what nothing
/// hides, and of what was not measured a part (`unmeasured`). 1 without a surface.
std::vector<double> surfaceShares(
  const Poses& poses, const Scene& scene, const TrainedModel& model, const PoseScreeningSettings& settings = {});
}
