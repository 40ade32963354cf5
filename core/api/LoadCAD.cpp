// SPDX-License-Identifier: BSD-3-Clause
#include "io/cad/CADFile.h"
#include "meam.h"

namespace meam
{
Mesh loadCAD(const std::string& path, const CADSettings& settings, const Progress& progress)
{
  CADPart part = readCAD(path, settings, progress);
  return { std::move(part.mesh.vertices), std::move(part.mesh.triangles), std::move(part.report) };
}
}
