// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/PointCloud.h"
#include "mesh/TriangleMesh.h"

namespace meam
{
/// The surface through rings of points, one after the other, all of the same number, or of a single point, which closes
/// an end; `closed`: the last ring is joined to the first one. Points go counter-clockwise about the way from ring to
/// ring; what lies to the outside of rings that grow along that way faces backward, as a cone's base does.
TriangleMesh ringMesh(const std::vector<PrecisePoints>& rings, bool closed);
}
