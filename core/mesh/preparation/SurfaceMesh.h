// SPDX-License-Identifier: BSD-3-Clause
// CGAL's mesh, between the steps of the mesh preparation. Heavy: only for files that include CGAL anyway.
#pragma once

#include "base/PointCloud.h"
#include "mesh/TriangleMesh.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Surface_mesh.h>

namespace meam
{
using MeshKernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using SurfaceMesh = CGAL::Surface_mesh<MeshKernel::Point_3>;
using FaceNumbers = SurfaceMesh::Property_map<SurfaceMesh::Face_index, std::size_t>;

/// Where more than two faces meet at an edge, or neighbours are wound against each other, the faces
/// get vertices of their own.
SurfaceMesh toSurfaceMesh(const TriangleMesh& mesh);
/// Without what was removed from the mesh.
TriangleMesh toTriangleMesh(const SurfaceMesh& mesh);

/// The corners of a face, a column each.
Eigen::Matrix3d cornersOf(const SurfaceMesh& mesh, SurfaceMesh::Face_index face);

/// The area of each connected component in mm^2; `componentOf` becomes the number of each face's.
std::vector<double> componentAreas(SurfaceMesh& mesh, FaceNumbers& componentOf);
}
