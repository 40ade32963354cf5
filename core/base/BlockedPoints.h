// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/SoAPoints.h"

namespace meam
{
/// Points in blocks of neighbours, for work on all points near a place, many at a time.
class BlockedPoints
{
public:
  static constexpr int Size = 16; ///< points of a block; the last has what is left

  /// Points that are not finite are left out. The same for any number of threads, of which two at most help.
  explicit BlockedPoints(const Points& points, int threads = 1);

  /// The finite points' indices block by block; block b begins at b * Size.
  const std::vector<int>& order() const { return this->Order; }

  /// Numbers of the blocks that come within `radius` of `centre`, ascending.
  std::vector<int> within(const Eigen::Vector3f& centre, double radius) const;

private:
  std::vector<int> Order;
  SoAPoints Low; ///< corners of the blocks' bounds
  SoAPoints High;
};
}
