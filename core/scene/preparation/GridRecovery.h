// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "scene/preparation/PointRaster.h"

#include <optional>

namespace meam
{
/// The pixels of the sensor that measured a cloud, found again from where its points lie: x / z and y / z of a pinhole
/// camera without distortion, x and y of an orthographic one, are multiples of one step each. The points are in the
/// sensor's frame, mm; none of it has to be known but where it is. None when they lie on no lattice, or on one of which
/// they fill less than a third.
std::optional<RasterView> recoverGrid(const Points& points, bool perspective);

/// Pixels that points are off the middles of theirs, on average.
double offGrid(const Points& points, const RasterView& view);
}
