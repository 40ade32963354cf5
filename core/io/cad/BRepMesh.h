// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "mesh/TriangleMesh.h"

#include <string>

namespace meam
{
struct BRepMesh
{
  TriangleMesh mesh; ///< mm; no faces when the file holds no surface
  int solids = 0;
};

/// The triangles of all faces in a STEP or IGES file, by Open CASCADE, which crashes on many damaged ones. Faces that
/// share an edge share its vertices. Throws Error for what is cut off or damaged.
BRepMesh meshOfBRep(const std::string& path);
}
