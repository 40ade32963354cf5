// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/Error.h"
#include "io/cad/CADSettings.h"
#include "mesh/TriangleMesh.h"

#include <string>

namespace meam
{
struct CADPart
{
  TriangleMesh mesh;
  std::string report; ///< what was assumed of the file; mostly empty
};

/// Reads a part: of a STEP (.step, .stp) or IGES (.iges, .igs) file the faces of all its solids and shells, or of one
/// solid, in mm, however they are put together; any other as readMesh() does. Throws Error, naming the file and what is
/// wrong with it.
CADPart readCAD(const std::string& path, const CADSettings& settings = {}, const Progress& progress = {});
}
