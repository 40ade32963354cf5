// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "mesh/TriangleMesh.h"

#include <string>

namespace meam
{
struct BRepMesh
{
  TriangleMesh mesh; ///< mm; no faces when the file holds no surface
  Points solidSizes; ///< mm, of the bounds of each solid that the mesh is of
};

/// The triangles of all faces in a STEP or IGES file, or of one of its solids (from 1; 0: all), by Open CASCADE, which
/// crashes on many damaged ones. Faces that share an edge share its vertices. Throws Error for what is cut off or
/// damaged, and for a solid that the file does not hold.
BRepMesh meshOfBRep(const std::string& path, int solid);
}
