// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "model/TrainedModel.h"
#include "pose/Pose.h"
#include "scene/Scene.h"

namespace meam
{
/// Patches of right parts that are missing at most.
inline constexpr int MissingByChance = 1;

/// How many patches of a part the sensor saw past on most of the copies that show them, of poses in the local frame.
/// What hides a copy, or is measured wrongly at a rim, is at another place on each; what a part that looks alike lacks,
/// or has elsewhere, is missing on all. Beyond a patch the scan goes on for a cell of the depth map at least.
int missingPatches(const Poses& poses, const Scene& scene, const TrainedModel& model, int threads);
}
