// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "model/TrainedModel.h"

#include <string>

namespace meam
{
/// Writes a trained model as one file, NAME.meam by custom: eight bytes of signature, the format version, and arrays by
/// name with a check sum, little-endian. What takes long to derive from a model is among them (DerivedFields). Throws
/// Error, naming the file, when it cannot be written; no partial file is left then.
void writeModel(const std::string& path, const TrainedModel& model);

/// Reads it back, bit by bit the same. Throws Error, naming the file and what to do, for another kind of file, another
/// version, and one that is cut off or damaged; allocates no more than its length justifies.
TrainedModel readModel(const std::string& path);

/// Whether the file starts like a trained model, of any version; false for one that cannot be read.
bool isModel(const std::string& path);
}
