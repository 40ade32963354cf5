// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "scene/OrganizedCloud.h"

#include <optional>

namespace meam
{
/// A cloud with what a sensor says of each point; an array is empty when it says nothing. A cloud of height 1
/// is not organized.
struct MeasuredCloud
{
  OrganizedCloud cloud;
  Points normals;
  std::vector<float> intensities;   ///< grey values of any range
  std::vector<std::uint8_t> colors; ///< red, green, blue of each point
  /// The sensor's pose that a file tells; points may be in this sensor's own frame instead.
  std::optional<Eigen::Isometry3d> T_cloud_sensor{};
};

/// Grey values of 8 bits: those that are whole numbers up to 255 already as they are, others times what makes the
/// largest 255; below 0 and NaN is black.
std::vector<std::uint8_t> greyValues(const std::vector<float>& intensities);

/// Colours of 8 bits from red, green, blue of each point: those of real numbers up to 1 times 255, those beyond 510,
/// which are of 16 bits, divided by 257, others as they are; below 0 and NaN is black.
std::vector<std::uint8_t> colorValues(const std::vector<float>& channels, bool areReal);
}
