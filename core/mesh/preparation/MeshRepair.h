// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include "base/Error.h"
#include "mesh/TriangleMesh.h"
#include "mesh/preparation/MeshPreparation.h"
#include "mesh/preparation/SurfaceMesh.h"

namespace meam
{
// The steps of prepareMesh(), in this order. Each counts in `counts` what it found.

/// The scaled and moved triangles with shared vertices, wound consistently, without duplicate or
/// degenerate ones. May be empty.
SurfaceMesh meshOfSoup(
  const TriangleMesh& input, const MeshPreparationSettings& settings, MeshReport& counts, const Progress& progress);

/// Removes all connected components but the one of the largest area.
void keepLargestComponent(SurfaceMesh& mesh, MeshReport& counts);

/// Closes holes whose border is no longer than `holeSize` (mm).
void closeHoles(SurfaceMesh& mesh, double holeSize, MeshReport& counts, const Progress& progress);

/// Pairs of triangles that intersect; counting ends at MostIntersections.
int countIntersections(const SurfaceMesh& mesh, const Progress& progress);
}
