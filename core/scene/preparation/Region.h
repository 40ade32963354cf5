// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>

#include <cstdint>
#include <vector>

namespace meam
{
/// Where in a scan parts are looked for: the middles of their surfaces lie in both, as the sensor sees it.
struct Region
{
  Eigen::AlignedBox3d box;        ///< mm, along the axes of the scan; empty: everywhere
  std::vector<std::uint8_t> mask; ///< of each point of the scan, 0 where it is left out; empty: none is

  bool isEverywhere() const { return this->box.isEmpty() && this->mask.empty(); }
};
}
