// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Geometry.h"

namespace meam
{
/// Throws Error when the mesh has no faces, a vertex that is not a number, or a face with a vertex
/// that does not exist.
void requireMesh(const TriangleMesh& mesh);

/// Throws Error when the points (mm) cannot be samples of the mesh: some lie outside its bounds.
void requireSamplesOf(const TriangleMesh& mesh, const Points& points);
}
