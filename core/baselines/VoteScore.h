// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "model/TrainedModel.h"
#include "pose/Pose.h"
#include "scene/Scene.h"

namespace meam
{
/// The score of the methods that rank poses by their votes ([12], [23] of the paper): the votes of each become those of
/// all poses that agree with it, its score their share of the most.
void scoreByVotes(Poses& poses, const Scene& scene, const TrainedModel& model, int threads);
}
