// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/LocalCloud.h"
#include "model/TrainedModel.h"
#include "pose/Pose.h"

#include <vector>

namespace meam
{
/// Which of a scene's edge points an edge of the part explains: for each the index of the first of the poses (scene
/// coordinates, best first) that has an edge within ExplainedDistance, or `least` (mm) where that is more; -1: none.
/// The same for any number of threads; 0: one for each processor.
std::vector<int> explainEdges(
  const LocalCloud& edges, const Poses& poses, const TrainedModel& model, double least = 0.0, int threads = 0);
}
