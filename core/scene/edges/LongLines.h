// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/PointCloud.h"
#include "scene/EdgeIndex.h"

#include <vector>

namespace meam
{
/// Lengths as shares of the part's diameter.
struct LongLineSettings
{
  double leastLength = 1.25; ///< no straight edge of the part is longer than its diameter
  double step = 0.05;        ///< from one point of a line to the next
  double straight = 0.4;     ///< so far from a line's first point its direction is told; from there on it stays
  double parallel = 0.95;    ///< cosine between line and tangents
  int mostMissing = 1;       ///< steps in a row without an edge
  std::size_t stride = 16;   ///< of the edge points one of so many is where a line is looked for
};

/// For each edge point whether it lies on a straight line of edge points that is longer than the part: the rim of the
/// bin, its walls' corners, the border of a table. No edge of the part can be that long. `tolerance` in mm across the
/// lines. `index` of the edges. The same for any number of threads; 0: one for each processor.
std::vector<unsigned char> onLongLines(const PointCloud& edges, const EdgeIndex& index, double partDiameter,
  double tolerance, const LongLineSettings& settings = {}, int threads = 0);
}
