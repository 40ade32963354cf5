// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "pose/selection/InstanceOdds.h"

namespace meam
{
/// Of poses, best first: the part may lie there, or one that is longer or shorter along an axis of its CAD file.
/// Decided for all together, by the lengths of the likely ones; where they are too few, or the scan is too coarse,
/// nothing changes.
void allowForOtherSize(FinishedInstances& found, const Scene& scene, const TrainedModel& model, int threads);
}
