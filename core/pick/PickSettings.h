// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "pick/PickTypes.h"

#include <limits>
#include <string>

namespace meam
{
/// What a pick has to keep, and how finely planning looks.
struct PickSettings : PlanSettings
{
  double comfortableClearance = 10.0; ///< mm; more is no better
  double cupSlack = 2.0;              ///< mm that a cup gives way when it comes down on the part
  double partMargin = 1.0; ///< mm that the open gripper keeps from the part that it takes, but between its pads
  double voxelSize = 0.0;  ///< mm, of what is measured besides; 0: 4 point distances, at least 1 % of the diameter

  // Shares of the part's size, the diagonal of its box.
  double toleranceOfPart = 0.01; ///< the tolerance without noise, and the smallest voxel
  double mostTolerance = 0.06;   ///< however noisy: farther away lies something else
  double surfaceSpacing = 0.03;  ///< of the points on the part that tell what lies at it and on it
  double mostOutside = 0.5;      ///< a grasp so far from the part is one of another part, or in another unit
  double noiseInTolerance = 3.0; ///< standard deviations: all but 3 of 1,000 points
  double pointsInVoxel = 4.0;    ///< point distances in the side of a voxel, so that a slanted surface has no holes
  double thinnedInVoxel = 2.0;   ///< of the points along that side so many are taken: more say no more
  int fewestInVoxel = 2;         ///< a point alone is none of a surface
};

constexpr double Unbounded = std::numeric_limits<double>::infinity();

/// Throws Error for a number that is not finite or not within its range: "The maximum tilt has to be 0 to 180 degrees,
/// not 500." `unit`: what follows the range, " mm".
void requireWithin(const std::string& name, double value, double low, double high, const std::string& unit = {});

/// Throws Error for a number that is out of its range, in a sentence with its name.
void requireSettings(const PickSettings& settings);
}
