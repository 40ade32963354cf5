// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/Error.h"
#include "model/TrainedModel.h"
#include "pose/Pose.h"
#include "scene/Scene.h"

namespace meam
{
/// Section 5.3 of the paper: PCL's point-to-point ICP of the edge points of each pose's view against the scene's edges,
/// at most so many iterations, between points no farther apart than `distance` (mm).
void refinePointToPoint(Poses& poses, const Scene& scene, const TrainedModel& model, double distance, int iterations,
  int threads, const Progress& progress = {});
}
