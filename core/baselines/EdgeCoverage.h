// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/Error.h"
#include "model/TrainedModel.h"
#include "pose/Pose.h"
#include "scene/Scene.h"

namespace meam
{
/// Section 5.2 of the paper: scores each pose by the share of its view's edge points that have a scene edge point
/// within `tolerance` (mm).
void scoreByEdgeCoverage(Poses& poses, const Scene& scene, const TrainedModel& model, float tolerance, int threads,
  const Progress& progress = {});
}
