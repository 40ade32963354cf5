// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "mesh/TriangleMesh.h"

#include <string>
#include <vector>

namespace meam
{
/// The connected components of a mesh that are hardly of the part, largest first, each in words: what lies far off the
/// rest, as a stray triangle, and planes far larger than all that is no plane, as a datum plane. `unit` is that of the
/// coordinates. Vertices at the same place are one; triangles without area are left out.
std::vector<std::string> strayComponents(const TriangleMesh& mesh, const std::string& unit);

/// What to tell whoever reads a part from a file, and what to change; empty without stray components.
std::string strayReport(const std::string& path, const TriangleMesh& mesh, const std::string& unit);
}
