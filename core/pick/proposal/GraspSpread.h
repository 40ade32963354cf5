// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/Error.h"
#include "mesh/Symmetries.h"
#include "pick/Grasp.h"

#include <functional>

namespace meam
{
constexpr double GraspTurnStep = 15.0; // degrees between the turns at which a free one is proved

/// Chooses `most` grasps that differ: again and again the one of largest worth, which is its quality, less for each one
/// that was taken at its place or with its way in before. Near ones that face the same way are left out, also those
/// that the exact symmetries, a free turn or the change of the jaws' places bring near. `all`: best first; `spread` and
/// the part's `size` in mm; `freeTurnOf` is asked once for each that is taken. The chosen come best first.
Grasps spreadOut(const Grasps& all, const Symmetries& symmetries, double spread, double size, int most,
  const std::function<FreeTurn(const Grasp&)>& freeTurnOf, const Progress& progress = {});
}
