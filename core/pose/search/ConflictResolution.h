// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/Error.h"
#include "model/TrainedModel.h"
#include "pose/Pose.h"
#include "scene/Scene.h"

namespace meam
{
/// One type of part and its verified poses, in the local frame, in a scene that is prepared for its diameter.
struct PartDetections
{
  const Scene& scene;
  const TrainedModel& model;
  const Poses& poses;
};

/// A pose and the type of part that is there.
struct PartPose
{
  int part = 0;  ///< index of the type
  int index = 0; ///< of the pose among those of the type
  Pose pose;     ///< in the local frame, with the view that shows what the sensor sees
};

struct ConflictResolutionSettings
{
  double shared = 0.5;  ///< share of what one of two poses explains from which on they claim the same surface, [0, 1]
  int maximumPoses = 0; ///< of all that stay the best; 0: no limit
  int threads = 0;      ///< 0: one for each processor
};

/// Of the poses of each part, by what speaks for each by itself, which are on a copy of another part: a likely pose of
/// that one claims the same measured surface and has much more support (resolveConflicts). Of parts that look alike
/// neither has, so that what the copies have in common still tells which part they are.
std::vector<std::vector<bool>> onOtherParts(const std::vector<PartDetections>& parts,
  const ConflictResolutionSettings& settings = {}, const Progress& progress = {});

/// Of poses that claim the same measured surface, of different parts or of one, the best supported stays; all that
/// stay come back, best first. All parts have to be of one scene, in one local frame.
///
/// A pose explains the measured points within 2 % of the smallest part's diameter, but 1 % of the own diameter of parts
/// that are more than twice as large. Two poses are in conflict when more than `shared` of the measured points that
/// either explains are explained by the other, too: so a small part that fits inside a large one's face is, and one
/// that lies on top of it is not. The support of a pose is the odds of its place's probability (no more than 99 to 1)
/// times the measured points it explains, less those in proportion that the sensor saw past or did not measure: every
/// point more is one more that had to fit by accident if the pose were wrong, and points of the scene count the same
/// for parts of any size. Equal support: probability, score, then visible fraction decide, at last the order. Without a
/// surface the scene's edge points take its place.
///
/// Throws Error for settings out of range and when some parts have the scene's surface and others do not.
std::vector<PartPose> resolveConflicts(const std::vector<PartDetections>& parts,
  const ConflictResolutionSettings& settings = {}, const Progress& progress = {});
}
