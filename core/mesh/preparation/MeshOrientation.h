// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "mesh/preparation/SurfaceMesh.h"

namespace meam
{
/// Turns the mesh outwards, where that can be told; returns how many components were turned.
/// `crossesItself`: some of its triangles intersect.
int orientOutward(SurfaceMesh& mesh, bool crossesItself);
}
