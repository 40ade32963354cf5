// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/PointCloud.h"

namespace meam
{
/// A scene's extent, the diagonal of its bounds, in diameters of the part.
struct UnitCheckSettings
{
  // Others are possible in the same unit, but unlikely: a scene spans a part or more, and mostly some tens of them.
  double leastUsual = 0.7;
  double mostUsual = 200.0;
  // The likely factor is 10 when it takes the extent to one between these, else 1000.
  double leastLikely = 1.5;
  double mostLikely = 100.0;
  // Others are not possible.
  double leastPossible = 0.2;
  double mostPossible = 1000.0;
  double strayShare = 0.02; ///< of the points, at each end of each axis: they are left out when there is more
};

/// Throws Error when a scene cannot be in the part's unit of length: its extent is far smaller or
/// larger than `partDiameter` allows. The message names the likely factor.
void requireSameUnits(const Points& scene, double partDiameter, const UnitCheckSettings& settings = {});

/// What to tell a user when a scene's extent is possible but unlikely for a part in the same unit, as with centimetres:
/// it names the likely factor. Empty when there is nothing to tell.
std::string unitsWarning(const Points& scene, double partDiameter, const UnitCheckSettings& settings = {});
}
