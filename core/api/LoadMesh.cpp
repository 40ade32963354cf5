// SPDX-License-Identifier: BSD-3-Clause
#include "io/MeshFile.h"
#include "meam.h"

namespace meam
{
Mesh loadMesh(const std::string& path)
{
  TriangleMesh mesh = readMesh(path);
  return { std::move(mesh.vertices), std::move(mesh.triangles) };
}
}
