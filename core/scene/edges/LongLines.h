// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/PointCloud.h"
#include "scene/EdgeIndex.h"

#include <vector>

namespace meam
{
/// For each edge point whether it lies on a straight line of edge points that is longer than the part: the rim of the
/// bin, its walls' corners, the border of a table. No edge of the part can be that long; edges of parts that stand in
/// line, with less than a tenth of its diameter between them, make such lines, too. `tolerance` in mm across the lines.
/// `index` of the edges. The same for any number of threads; 0: one for each processor.
std::vector<unsigned char> onLongLines(
  const PointCloud& edges, const EdgeIndex& index, double partDiameter, double tolerance, int threads = 0);
}
