// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/Error.h"
#include "scene/MeasuredCloud.h"

#include <string>

namespace meam
{
/// Reads a text with a point in each line, in the file's own unit, as a cloud that is not organized: numbers between
/// blanks, tabs, commas or semicolons, the decimal comma where commas do not stand between them. A first line names
/// the columns (x y z, nx ny nz, r g b or red green blue, intensity; as CloudCompare, Open3D and ParaView write them);
/// without one they are x y z and, by their number and values, an intensity, a colour, a normal; a first column that
/// counts the lines is passed over, and so are rows and columns of an image before five columns or eight. Lines from #
/// or // on before the points, and a first line with their number (.pts), are passed over; a point with a word that is
/// none, such as nan or nothing between two commas, is NaN. Colours are as colorValues() has them. Throws Error, naming
/// the file, the line and what is wrong with it.
MeasuredCloud readXYZ(const std::string& path, const Progress& progress = {});

/// Whether the file begins as such a text does; false for one that cannot be read.
bool isXYZ(const std::string& path);
}
