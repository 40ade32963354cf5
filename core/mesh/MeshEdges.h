// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/PointCloud.h"
#include "mesh/TriangleMesh.h"

#include <array>

namespace meam
{
/// An edge of a mesh and its faces.
struct MeshEdge
{
  std::array<int, 2> vertices; ///< ascending
  std::array<int, 2> faces;    ///< the first two, ascending; the second is -1 at a border
  int faceCount;               ///< more than two where the surface branches
};

/// All edges of the mesh, ordered by their vertices. The mesh's indices have to be valid.
std::vector<MeshEdge> edgesOf(const TriangleMesh& mesh);

/// Unit normals of the triangles, by their winding. A triangle so flat that rounding turns it takes that of the face
/// beside its longest edge; the normal is zero where it has no area and nothing but such faces beside it. `edges` are
/// those of the mesh.
Points faceNormals(const TriangleMesh& mesh, const std::vector<MeshEdge>& edges);

/// A point on an edge.
struct EdgeSample
{
  Eigen::Vector3f point;
  Eigen::Vector3f tangent; ///< unit, along the edge
  int edge;                ///< index in the list of edges
};

/// Samples edges evenly: those that meet end to end form a chain, and `spacing` (mm) is measured along the
/// chain, so that a curve of many short edges has no more points than a straight line of its length.
/// Chains end where more or fewer than two of the edges meet. A chain gets as many points as the spacing
/// fits into it, rounded, the first and the last half a step from its ends; one shorter than half of the
/// spacing gets none. Throws Error for a spacing that is not positive or asks for millions of points.
std::vector<EdgeSample> sampleEdges(
  const Points& vertices, const std::vector<std::array<int, 2>>& edges, double spacing);
}
