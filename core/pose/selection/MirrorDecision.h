// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "pose/selection/InstanceOdds.h"
#include "pose/verification/PoseEvidence.h"

namespace meam
{
/// Of poses, best first: the part may lie there, or what a mirror shows of it. Decided for all together, by what the
/// scan says of the likely ones against the mirrored part, refined from there; where it says too little the prior
/// stays.
void allowForMirrorImage(FinishedInstances& found, const Scene& scene, const TrainedModel& model,
  const EvidenceCollector& collector, const EvidenceSettings& settings, const EvidenceRates& rates, int threads);
}
