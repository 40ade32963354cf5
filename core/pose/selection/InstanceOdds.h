// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "model/TrainedModel.h"
#include "pose/Pose.h"
#include "pose/objective/CommonDifferences.h"
#include "pose/objective/SurfaceContinuation.h"
#include "scene/Scene.h"

namespace meam
{
/// An instance with its final pose.
struct FinishedInstance
{
  Pose pose;
  Points beyond;          ///< measured surface that goes on beside it (SurfaceContinuation)
  double logOdds;         ///< that a copy is there
  bool isLeft = false;    ///< as it was scored, for enough others are sure: it comes after them
  bool isOnOther = false; ///< on a copy of another type of part
};

using FinishedInstances = std::vector<FinishedInstance>;

/// Whether it tells what the scan holds: it is likely, and on no other type's copy. What is not likely is nothing at
/// all.
bool tells(const FinishedInstance& finished);

/// Place of a pose; of less it does not matter what contradicts it.
inline constexpr double WorthExplaining = 0.02;

/// No likelier than `certainty`, that what lies there is the part.
void allowFor(FinishedInstance& finished, double certainty);

/// Of poses, best first, those that tell what the scan holds, `most` at most.
Poses likelyOf(const FinishedInstances& found, std::size_t most);

/// Those that are left at the end.
void sortBest(FinishedInstances& found);

/// Of poses, best first: of two whose bodies cut into each other one is right at most.
void excludeOverlaps(FinishedInstances& found, const TrainedModel& model);

/// Of poses, best first: no pose is likelier than that it is of the part and not of one that looks alike, which what
/// the pose does not explain of the face that it lies on, nor another pose does, what it lacks and how far the surface
/// lies off it tell. `excused`: SurfaceMisfit.
void allowForLookalikes(
  FinishedInstances& found, const TrainedModel& model, const SurfaceContinuation& continuation, double excused);

/// Of poses, best first: in what the likely ones differ from the part.
CommonDifferences differencesOfLikely(
  const FinishedInstances& found, const Scene& scene, const TrainedModel& model, int threads);
/// The part may lie there, or one that differs in so many patches. `excused`: SurfaceMisfit, of the surplus.
void allowForDifferences(FinishedInstances& found, const CommonDifferences& differences, double excused);

/// What is said of places and rotations is what held in the scans that the model was calibrated on.
void calibrate(FinishedInstances& found, const ModelCalibration& calibration);
}
