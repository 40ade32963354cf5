// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/PointCloud.h"

namespace meam
{
constexpr double Metre = 1000.0; // mm

/// Throws Error when a scene cannot be in the part's unit of length: its extent is far smaller or
/// larger than `partDiameter` allows. The message names the likely factor.
void requireSameUnits(const Points& scene, double partDiameter);

/// What to tell a user when a scene's extent is possible but unlikely for a part in the same unit, as with centimetres:
/// it names the likely factor. Empty when there is nothing to tell.
std::string unitsWarning(const Points& scene, double partDiameter);
}
