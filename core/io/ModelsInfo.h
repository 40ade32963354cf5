// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "mesh/Symmetries.h"

#include <string>

namespace meam
{
/// The entry of a part in a BOP dataset's models_info.json, as text: diameter, bounds and exact symmetries, mm.
std::string modelsInfo(const Symmetries& symmetries, double diameter, const Eigen::AlignedBox3f& bounds);
}
