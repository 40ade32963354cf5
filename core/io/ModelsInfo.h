// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "mesh/Symmetries.h"

#include <string>

namespace meam
{
/// The entry of a part in a BOP dataset's models_info.json, as text: diameter, bounds and exact symmetries, mm.
std::string modelsInfo(const Symmetries& symmetries, double diameter, const Eigen::AlignedBox3f& bounds);

/// The exact symmetries of a part as a models_info.json names them, mm. Throws Error, naming the file, when the
/// part is not in it or something of it is damaged.
Symmetries readModelsInfo(const std::string& path, int objectId);
}
