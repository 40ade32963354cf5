// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "model/DistanceField.h"
#include "model/MirrorImage.h"
#include "model/SideSymmetries.h"

#include <cstdint>
#include <optional>
#include <vector>

namespace meam
{
class NamedArrays;

/// What detection derives from a model and takes longer to make than to read.
struct DerivedFields
{
  DistanceField surfaceDistance, edgeDistance;
  std::vector<std::uint8_t> interior; ///< BodyInterior::cells
  Mirroring mirroring;
  std::vector<SideSymmetry> sides;
  std::vector<std::uint8_t> stepsBeside; ///< SurroundingPatches::steps
};

/// Adds those of a model to the arrays of its file. What first scans find out of a model is found out unless it is
/// known.
void setDerived(NamedArrays& arrays, const TrainedModel& model);

/// Reads them back, bit by bit the same; none where a file has none, or those of another version. Throws Error, as
/// "is damaged: ...", for what is none of these.
std::optional<DerivedFields> derivedOf(const NamedArrays& arrays);
}
