// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/Error.h"
#include "base/PointCloud.h"
#include "mesh/TriangleMesh.h"

namespace meam
{
/// The same surface in even triangles with edges of about `edgeLength` mm (CGAL's isotropic remeshing). Sharp edges and
/// borders stay where they are; they are only cut into pieces. Throws Error for an edge length that is not positive or
/// asks for millions of triangles.
TriangleMesh remesh(const TriangleMesh& mesh, double edgeLength, const Progress& progress = {});
}
