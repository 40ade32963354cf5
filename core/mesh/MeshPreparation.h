// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Error.h"
#include "Geometry.h"

namespace meam
{
struct MeshPreparationSettings
{
  double scale = 1.0;                               ///< factor on the coordinates, to bring them to mm; positive
  Eigen::Vector3d offset = Eigen::Vector3d::Zero(); ///< mm, added after the scale
};

/// What was found in a mesh and what was done to it. Lengths in mm.
struct MeshReport
{
  int inputVertices = 0;
  int inputTriangles = 0;
  int vertices = 0;
  int triangles = 0;
  int mergedVertices = 0;      ///< at exactly the place of another one
  int isolatedVertices = 0;    ///< of no face
  int degenerateTriangles = 0; ///< without area
  int duplicateTriangles = 0;  ///< with the vertices of another one
  int flippedComponents = 0;   ///< faced inwards
  int components = 0;
  int borderEdges = 0;
  bool closed = false;
  double area = 0.0;
  double volume = 0.0;   ///< of a closed mesh, otherwise 0
  double diameter = 0.0; ///< d_max
};

struct PreparedMesh
{
  TriangleMesh mesh;
  MeshReport report;
};

/// Makes a clean mesh in mm of a CAD file's triangles (CGAL): scaled and moved, vertices shared, no
/// degenerate or duplicate faces, neighbours wound the same way, outward where that can be told. A
/// closed mesh is not required. Throws Error without faces, for a vertex that is not a number, for
/// a face with a vertex that does not exist, or a scale that is not positive.
PreparedMesh prepareMesh(
  const TriangleMesh& mesh, const MeshPreparationSettings& settings = {}, const Progress& progress = {});
}
