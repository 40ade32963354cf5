// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace meam
{
/// Which set of parameters every step starts from.
enum class Preset
{
  Paper,      ///< Liu et al., Sensors 2018, Section 6
  Recommended ///< what measures better
};
}
