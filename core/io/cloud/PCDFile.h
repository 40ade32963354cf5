// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/Error.h"
#include "scene/MeasuredCloud.h"

#include <array>

namespace meam
{
/// Reads a Point Cloud Library file, version 0.5 to 0.7, in the file's own unit: ascii, binary or binary_compressed,
/// fields in any order and of any type: normals from normal_x, normal_y and normal_z, intensities from intensity,
/// gray or i, colours from rgb or rgba, or red green blue or r g b as colorValues() has them; fields it does not know
/// are skipped; a VIEWPOINT other than the default is the sensor's pose. Throws Error, naming the file and what is
/// wrong with it; allocates no more than the length of the file justifies.
MeasuredCloud readPCD(const std::string& path, const Progress& progress = {});

/// Width and height as the file's header promises them. Throws Error when it is not a PCD file.
std::array<int, 2> readPCDSize(const std::string& path);
}
