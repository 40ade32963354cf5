// SPDX-License-Identifier: BSD-3-Clause
#include "scene/MeasuredCloud.h"

#include <algorithm>
#include <cmath>

namespace meam
{
std::vector<std::uint8_t> greyValues(const std::vector<float>& intensities)
{
  float largest = 0.0f;
  bool whole = true;
  for (const float value : intensities)
  {
    if (std::isfinite(value))
    {
      largest = std::max(largest, value);
      whole = whole && value >= 0.0f && value == std::floor(value);
    }
  }
  const float factor = (whole && largest <= 255.0f) || largest <= 0.0f ? 1.0f : 255.0f / largest;
  std::vector<std::uint8_t> values;
  values.reserve(intensities.size());
  for (const float intensity : intensities)
  {
    const float value = std::round(factor * intensity);
    values.push_back(value > 0.0f ? static_cast<std::uint8_t>(std::min(value, 255.0f)) : 0);
  }
  return values;
}
}
