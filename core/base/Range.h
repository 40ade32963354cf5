// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <limits>
#include <string>

namespace meam
{
constexpr double Unbounded = std::numeric_limits<double>::infinity();

/// Throws Error for a number that is not finite or not within its range: "The maximum tilt has to be 0 to 180 degrees,
/// not 500." `unit`: what follows the range, " mm".
void requireWithin(const std::string& name, double value, double low, double high, const std::string& unit = {});

/// The same of a number above 0: "The distance step has to be above 0 and at most 1, not 3."
void requirePositive(const std::string& name, double value, double high = Unbounded, const std::string& unit = {});
}
