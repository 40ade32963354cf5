// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/PointCloud.h"
#include "mesh/TriangleMesh.h"

namespace meam
{
/// Distances from a mesh on a grid about it: exact near the surface, not more than the truth far from it. Inside
/// of a closed mesh they are negative; an open one has no inside.
class SignedDistanceGrid
{
public:
  /// `cellSize` in the mesh's unit. The mesh may be closed in parts that overlap; it faces outwards.
  SignedDistanceGrid(const TriangleMesh& mesh, bool closed, double cellSize);

  /// A lower bound of the distance at any point outside; inside it is below zero.
  float bound(const Eigen::Vector3f& point) const;

  /// The distance, between the samples as three linear functions have it, and the direction in which it
  /// grows (unit; zero where there is none). Farther than a few cells from the surface it is a bound.
  float at(const Eigen::Vector3f& point, Eigen::Vector3f& direction) const;

private:
  std::size_t index(int x, int y, int z) const
  {
    return (static_cast<std::size_t>(z) * this->Size.y() + y) * this->Size.x() + x;
  }
  void addTriangle(const Eigen::Matrix3f& corners);
  void makeSigned(const TriangleMesh& mesh);
  void spread();

  Eigen::AlignedBox3f Box; ///< of the samples
  float CellSize;
  Eigen::Array3i Size; ///< samples along x, y and z
  std::vector<float> Distances;
};
}
