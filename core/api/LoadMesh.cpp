// SPDX-License-Identifier: BSD-3-Clause
#include "io/MeshFile.h"
#include "meam.h"
#include "mesh/preparation/StrayComponents.h"

namespace meam
{
Mesh loadMesh(const std::string& path)
{
  TriangleMesh mesh = readMesh(path);
  std::string report = strayReport(path, mesh, MeshFileUnit);
  return { std::move(mesh.vertices), std::move(mesh.triangles), std::move(report) };
}
}
