// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "mesh/TriangleMesh.h"

namespace meam
{
/// Corners of a face at most; more take too long, and are no face that a program for CAD writes.
constexpr std::size_t MostCorners = 5000;

/// Cuts a face with these corners, indices of the mesh's vertices in their order around it, into triangles and adds
/// them to the mesh: a convex one about its first corner, another one by its ears (Meisters 1975), seen along its mean
/// normal. There are always two triangles fewer than corners, also of a face that crosses itself. Throws Error for more
/// than MostCorners.
void addPolygon(const std::vector<int>& corners, TriangleMesh& mesh);
}
