// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "pick/PickTypes.h"

#include <limits>
#include <string>

namespace meam
{
constexpr double MostTolerance = 0.06;        // of the part's size, however noisy: farther away lies something else
constexpr double ComfortableClearance = 10.0; // mm; more is no better
constexpr double Unbounded = std::numeric_limits<double>::infinity();

/// Throws Error for a number that is not finite or not within its range: "The maximum tilt has to be 0 to 180 degrees,
/// not 500." `unit`: what follows the range, " mm".
void requireWithin(const std::string& name, double value, double low, double high, const std::string& unit = {});

/// Throws Error for a number that is out of its range, in a sentence with its name.
void requireSettings(const PlanSettings& settings);
}
