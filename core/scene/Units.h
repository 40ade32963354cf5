// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/PointCloud.h"

#include <string>

namespace meam
{
constexpr double Metre = 1000.0; // mm

struct LengthUnit
{
  double length; // mm
  const char* name;
};
inline constexpr LengthUnit UnitsBesideMM[] = { { Metre, "metres" }, { 25.4, "inches" }, { 10.0, "centimetres" } };

/// What to tell where a camera so far (mm) from a robot's base or gripper is likely in another unit: "the camera 1.2 mm
/// away: ..."; empty where mm may be right.
std::string cameraUnitDoubt(double distance);

/// Throws Error when a scene cannot be in the part's unit of length: its extent is far smaller or
/// larger than `partDiameter` allows. The message names the likely factors.
void requireSameUnits(const Points& scene, double partDiameter);

/// Whether points span less than a part that is partly in sight can: no part's edges are all so near to each other.
bool spansTooLittle(const Points& points, double partDiameter);

/// What to tell a user when a scene's extent is possible but unlikely for a part in the same unit, as with centimetres:
/// it names the likely factors, those of centimetres, inches and metres. Empty when there is nothing to tell.
/// With the `pointDistance` of the scan, 0 where it is not known, it tells, too, when both the extent and how many
/// points the part spans are unusual: few points always, many unless something sure was found.
std::string unitsWarning(const Points& scene, double partDiameter, double pointDistance = 0.0, bool isSure = true);
}
