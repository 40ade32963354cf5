// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/Error.h"
#include "scene/MeasuredCloud.h"

#include <array>

namespace meam
{
/// What a PCD file holds, in the file's own unit: normals from normal_x, normal_y and normal_z, intensities from
/// intensity, of any type, colours from rgb or rgba.
struct PCDData : MeasuredCloud
{
  /// Sensor position and quaternion w x y z.
  std::array<double, 7> viewpoint = { 0, 0, 0, 1, 0, 0, 0 };
};

/// Reads a Point Cloud Library file, version 0.5 to 0.7: ascii, binary or binary_compressed, fields
/// in any order and of any type; fields it does not know are skipped. Throws Error, naming the file
/// and what is wrong with it; allocates no more than the length of the file justifies.
PCDData readPCD(const std::string& path, const Progress& progress = {});

/// Width and height as the file's header promises them. Throws Error when it is not a PCD file.
std::array<int, 2> readPCDSize(const std::string& path);

/// Writes a binary PCD file. Throws Error when an array has another length than the points, or when
/// the file cannot be written; no partial file is left then.
void writePCD(const std::string& path, const PCDData& data);
}
