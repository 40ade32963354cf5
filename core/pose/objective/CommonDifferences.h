// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "model/TrainedModel.h"
#include "pose/Pose.h"
#include "scene/Scene.h"

namespace meam
{
/// Patches in which most of the copies that show them differ from the part, beyond what chance makes. What hides a copy
/// or lies beside it, or is measured wrongly at a rim, is at another place on each; what a part that looks alike lacks,
/// or has elsewhere, differs on all.
struct CommonDifferences
{
  int missing = 0; ///< of the part: the sensor saw past it
  int surplus = 0; ///< beside it, where one of its faces ends, or before a ring: there is surface, of no part beside it
};

/// Of poses in the local frame. `mayBeThere`: those of all copies that may be there, too, these among them; one whose
/// body cuts into another does not lie beside it. The same for any number of threads.
CommonDifferences commonDifferences(
  const Poses& poses, const Poses& mayBeThere, const Scene& scene, const TrainedModel& model, int threads);
}
