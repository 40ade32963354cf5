// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <limits>
#include <string>

namespace meam
{
/// What a pick has to keep, and how finely planning looks.
struct PickSettings
{
  double safetyMargin = 2.0;     ///< mm that the gripper keeps from all but the part that it holds
  double wayIn = 80.0;           ///< mm, straight along the grasp's z, that have to be free
  double leastProbability = 0.5; ///< of a pose that is picked; less likely ones do not stand in
                                 ///< the way either; one of unknown probability and score (0) is certain
  double mostTilt = 60.0;        ///< degrees between the way in and straight down
  double mostCovered = 20.0;     ///< % of the part, from above, that may lie under something
  double turnStep = 30.0;        ///< degrees between the turns that a free one is tried at
  double tolerance = 0.0; ///< mm: measured points so near to a copy or the bin are of it; 0: 3 times the noise and
                          ///< 1 % of the part's size, its box from corner to corner; at most 6 %
};

constexpr double MostTolerance = 0.06;        // of the part's size, however noisy: farther away lies something else
constexpr double ComfortableClearance = 10.0; // mm; more is no better
constexpr double Unbounded = std::numeric_limits<double>::infinity();

/// Throws Error for a number that is not finite or not within its range: "The maximum tilt has to be 0 to 180 degrees,
/// not 500." `unit`: what follows the range, " mm".
void requireWithin(const std::string& name, double value, double low, double high, const std::string& unit = {});

/// Throws Error for a number that is out of its range, in a sentence with its name.
void requireSettings(const PickSettings& settings);
}
