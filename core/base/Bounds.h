// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/PointCloud.h"

namespace meam
{
/// Axis-aligned bounds of the finite points.
Eigen::AlignedBox3f bounds(const Points& points);

/// Bounds without the given share of the points at each end of each axis.
Eigen::AlignedBox3f innerBounds(const Points& points, double share);
}
