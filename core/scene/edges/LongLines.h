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
  double seedCell = 0.1;     ///< of the edge points in a cube of this side a line is looked for from one
};

/// For each edge point whether it lies on a straight line of edge points that is longer than the part: the rim of the
/// bin, its walls' corners, the border of a table. No edge of the part can be that long; edges of parts that stand in
/// line, with less than `mostMissing` + 1 steps between them, make such lines, too. `tolerance` in mm across the lines.
/// `index` of the edges. The same for any number of threads; 0: one for each processor. Throws Error for a step that is
/// not positive.
std::vector<unsigned char> onLongLines(const PointCloud& edges, const EdgeIndex& index, double partDiameter,
  double tolerance, const LongLineSettings& settings = {}, int threads = 0);
}
