// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

namespace meam
{
/// An 8 bit image, row by row from the top left; 1 channel (grey) or 3 (red, green, blue).
struct Image
{
  int width = 0;
  int height = 0;
  int channels = 1;
  std::vector<std::uint8_t> pixels;
};
}
