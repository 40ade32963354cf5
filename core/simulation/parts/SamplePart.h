// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/PointCloud.h"
#include "mesh/TriangleMesh.h"

namespace meam
{
/// The part of the examples, made here so that they need no outside data: a ribbed flange as in car
/// air-conditioning, 80 mm across and 22 mm high, with thin walls. Its axis is z. A lug at +x, a
/// gap in the rim and a missing rib beside it fix the roll; three holes make it differ from its
/// mirror image. A closed mesh, facing outwards, of about 3500 triangles.
TriangleMesh makeSamplePart();
}
