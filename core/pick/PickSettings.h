// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "pick/PickTypes.h"

namespace meam
{
constexpr double MostTolerance = 0.06;        // of the part's size, however noisy: farther away lies something else
constexpr double ComfortableClearance = 10.0; // mm; more is no better

/// Throws Error for a number that is out of its range, in a sentence with its name.
void requireSettings(const PlanSettings& settings);
}
