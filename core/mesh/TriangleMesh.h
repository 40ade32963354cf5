// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/PointCloud.h"

namespace meam
{
/// A part's surface: vertices in mm, triangles counter-clockwise seen from outside.
struct TriangleMesh
{
  Points vertices;
  std::vector<Eigen::Vector3i> triangles;
};

/// Throws Error when the mesh has no faces, a vertex that is not a number, or a face with a vertex
/// that does not exist.
void requireMesh(const TriangleMesh& mesh);

/// Throws Error when the points (mm) cannot be samples of the mesh: some lie outside its bounds.
void requireSamplesOf(const TriangleMesh& mesh, const Points& points);
}
