// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/Error.h"
#include "base/PointCloud.h"
#include "mesh/TriangleMesh.h"

#include <string>
#include <vector>

namespace meam
{
enum class KeptComponents
{
  All,
  Largest ///< the connected component of the largest area
};

struct MeshPreparationSettings
{
  double scale = 1.0;                               ///< factor on the coordinates, to bring them to mm; positive
  Eigen::Vector3d offset = Eigen::Vector3d::Zero(); ///< mm, added after the scale
  KeptComponents keptComponents = KeptComponents::All;
  double holeSize = 0.0;     ///< mm: holes whose border is at most this long are closed; 0: none
  double maximumError = 0.0; ///< mm: the mesh is simplified as far as this bound allows; 0: not at all
  double edgeLength = 0.0;   ///< mm: the mesh is remade of triangles of this size; 0: not at all
};

/// Pairs of triangles that intersect are counted up to this number.
constexpr int MostIntersections = 10000; // a limit of time

/// What was found in a mesh and what was done to it. Lengths in mm.
struct MeshReport
{
  int inputVertices = 0;
  int inputTriangles = 0;
  int vertices = 0;
  int triangles = 0;
  int mergedVertices = 0;      ///< at exactly the place of another one
  int nearVertices = 0;        ///< within a millionth of the mesh's extent of another one; merged too
  int isolatedVertices = 0;    ///< of no face
  int degenerateTriangles = 0; ///< without area
  int duplicateTriangles = 0;  ///< with the vertices of another one
  int flippedComponents = 0;   ///< faced inwards
  int droppedComponents = 0;   ///< smaller ones, when only the largest is kept
  int components = 0;
  int closedHoles = 0;
  int intersections = 0; ///< pairs of triangles of the result that intersect, up to MostIntersections
  int borderEdges = 0;
  bool closed = false;
  double area = 0.0;
  double volume = 0.0;            ///< of a closed mesh, otherwise 0
  double diameter = 0.0;          ///< d_max
  std::vector<std::string> stray; ///< components of the result that are hardly of the part, in words
};

struct PreparedMesh
{
  TriangleMesh mesh;
  MeshReport report;
};

/// What was wrong with the mesh and what was done to it, in words.
std::string describe(const MeshReport& report);

/// Makes a clean mesh in mm of a CAD file's triangles (CGAL): scaled and moved, vertices shared, open
/// seams sewn, no degenerate or duplicate faces, neighbours wound the same way, outward where that can
/// be told. As the settings wish, only the largest component is kept, small holes are closed, then the
/// mesh is simplified and then remade of even triangles. A closed mesh is not required, and triangles
/// that intersect are only counted. Throws Error without faces, for a vertex that is not a number, for
/// a face with a vertex that does not exist, a scale that is not positive or a negative length.
PreparedMesh prepareMesh(
  const TriangleMesh& mesh, const MeshPreparationSettings& settings = {}, const Progress& progress = {});
}
