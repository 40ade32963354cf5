// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/Error.h"
#include "model/TrainedModel.h"
#include "pose/Pose.h"

#include <vector>

namespace meam
{
/// Of poses, best first, the indices of those that stay, ascending: of one instance, whose middles are nearer than
/// `distance` (mm), so many of the first, no two of them the same up to the symmetries `same`, near ones among them.
std::vector<int> firstOfClusters(const Poses& poses, const Symmetries& same, const TrainedModel& model, double distance,
  int posesPerInstance, const Progress& progress = {});
}
