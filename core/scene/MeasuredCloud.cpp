// SPDX-License-Identifier: BSD-3-Clause
#include "scene/MeasuredCloud.h"

#include <algorithm>
#include <cmath>

namespace meam
{
namespace
{
constexpr float LargestOfBytes = 2.0f * 255.0f; // whole colours somewhat beyond 255 are none of 16 bits
constexpr float Overshoot = 2.0f; // real colours up to 1 may have gone beyond by rounding; 2 of 255 is black

float largestOf(const std::vector<float>& values)
{
  float largest = 0.0f;
  for (const float value : values)
  {
    largest = std::isfinite(value) ? std::max(largest, value) : largest;
  }
  return largest;
}

std::vector<std::uint8_t> bytesOf(const std::vector<float>& values, float factor)
{
  std::vector<std::uint8_t> bytes;
  bytes.reserve(values.size());
  for (const float each : values)
  {
    const float value = std::round(factor * each);
    bytes.push_back(value > 0.0f ? static_cast<std::uint8_t>(std::min(value, 255.0f)) : 0);
  }
  return bytes;
}
}

std::vector<std::uint8_t> greyValues(const std::vector<float>& intensities)
{
  const float largest = largestOf(intensities);
  const bool whole = std::all_of(intensities.begin(), intensities.end(),
    [](float value) { return !std::isfinite(value) || (value >= 0.0f && value == std::floor(value)); });
  return bytesOf(intensities, (whole && largest <= 255.0f) || largest <= 0.0f ? 1.0f : 255.0f / largest);
}

std::vector<std::uint8_t> colorValues(const std::vector<float>& channels, bool areReal)
{
  const float largest = largestOf(channels);
  return bytesOf(channels, areReal && largest < Overshoot ? 255.0f : largest > LargestOfBytes ? 1.0f / 257.0f : 1.0f);
}
}
