// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/Error.h"
#include "mesh/TriangleMesh.h"

#include <string>

namespace meam
{
constexpr char MeshFileUnit[] = "the file's unit"; // what the lengths of a mesh in a file are of

/// Whether it is a STEP (.step, .stp) or IGES (.iges, .igs) file, by its extension. io/cad reads these.
bool isBRepFile(const std::string& path);

/// Reads a mesh, in the file's own unit, by the file's extension: .stl (ascii or binary), .obj, .ply or .off. Polygons
/// are cut into triangles; all but the shape is skipped. The triangles of an STL file share the vertices that lie at
/// exactly the same place, in the order in which these come first. Throws Error, naming the file and what is wrong with
/// it, also when it has no faces.
TriangleMesh readMesh(const std::string& path, const Progress& progress = {});

/// Reads the vertices of an OBJ file as a scan, which needs no faces. Throws Error as readMesh().
Points readOBJPoints(const std::string& path);
}
