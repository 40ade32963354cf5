// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/Error.h"
#include "base/PointCloud.h"
#include "mesh/TriangleMesh.h"

namespace meam
{
/// Reads an OFF file (Object File Format, ascii; also COFF, NOFF, STOFF and their combinations), in
/// the file's own unit. Polygons are cut into triangles about their first corner; normals, colours
/// and texture coordinates are skipped. Throws Error, naming the file and what is wrong with it;
/// allocates no more than the length of the file justifies.
TriangleMesh readOFF(const std::string& path, const Progress& progress = {});
}
