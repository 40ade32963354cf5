// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "pose/MEAMPoseEstimation.h"
#include "pose/search/ConflictResolution.h"

#include <string>
#include <vector>

namespace meam
{
/// The poses of one type among those of several, with their ranks over all, from 1.
struct RankedPoses
{
  Poses poses;
  std::vector<int> ranks;
};
RankedPoses posesOfPart(const std::vector<PartPose>& poses, int part);

/// mm, of the largest type.
double largestDiameter(const std::vector<const TrainedModel*>& models);

/// What poses leave open of how long their parts are, in a sentence for each type after what is told of them. `names`:
/// of the types; where there are none these are part 1 and so on.
std::string untoldLengths(
  const std::vector<PartPose>& poses, std::string told = {}, const std::vector<std::string>& names = {});

/// The online phase for several types of part in one scan: of poses that claim the same surface the best supported
/// stays (resolveConflicts). Ranked poses, in the scene's own coordinates (mm), with the type of each. Of one type it
/// is estimatePoses. Where a few poses are asked for, all types are searched in turn, some reference points of each
/// after others, until together so many are sure. Each type has its share of the time up to the deadline. `report` may
/// be null; its rates are those of the last type, its times and work of all.
std::vector<PartPose> estimateParts(const std::vector<const TrainedModel*>& models, const SceneInput& input,
  const DetectionSettings& settings, DetectionReport* report = nullptr, const Progress& progress = {});
}
