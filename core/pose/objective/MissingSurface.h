// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "model/TrainedModel.h"
#include "pose/Pose.h"
#include "scene/Scene.h"

namespace meam
{
/// How many patches of a part the sensor saw past on most of the copies that show them, of poses in the local frame,
/// beyond what chance makes. What hides a copy, or is measured wrongly at a rim, is at another place on each; what a
/// part that looks alike lacks, or has elsewhere, is missing on all. The same for any number of threads.
int missingPatches(const Poses& poses, const Scene& scene, const TrainedModel& model, int threads);
}
