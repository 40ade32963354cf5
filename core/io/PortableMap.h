// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "io/ImageFile.h"

#include <array>
#include <cstdint>
#include <string>
#include <string_view>

namespace meam
{
/// Whether a file starts as a PGM, plain or binary, or as a PFM of one channel.
bool isPortableMap(std::string_view bytes);

/// Width and height that the header promises; zeros for a header that is cut off or damaged.
std::array<std::uint64_t, 2> portableMapSize(std::string_view bytes);

/// Reads the values of an image of which isPortableMap() holds, whole numbers up to 65535 or real ones of 32 bits. The
/// rows of a PFM stand from the bottom. 255 of 8 bits and 65535 of 16 come out as NaN. Throws Error, naming the file,
/// for one that is cut off or damaged, and for a PFM with another scale than 1: some programs multiply by it, some
/// divide, and some leave it out.
DepthPixels readPortableMap(const std::string& path, std::string_view bytes);
}
