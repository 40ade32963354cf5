// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/Error.h"
#include "base/PointCloud.h"
#include "mesh/TriangleMesh.h"

namespace meam
{
/// The mesh with as few triangles as edge collapses reach (OpenMesh) while no point of the new surface is
/// farther than `maximumError` (mm) from the old one, nor of the old one from the new. The result is
/// measured, see meshDistance(). Its vertices are some of the old ones; edges and borders stay within the
/// bound too. Throws Error for an error bound that is not positive.
TriangleMesh simplifyMesh(const TriangleMesh& mesh, double maximumError, const Progress& progress = {});
}
