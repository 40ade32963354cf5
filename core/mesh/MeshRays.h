// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "mesh/TriangleMesh.h"

#include <Eigen/Core>

#include <memory>
#include <optional>
#include <vector>

namespace meam
{
/// Where a ray meets a face.
struct RayHit
{
  double distance = 0.0;                            ///< mm, along the ray
  Eigen::Vector3d normal = Eigen::Vector3d::Zero(); ///< unit, of the face, by its winding
  bool entering = false;                            ///< the ray comes from outside
};

/// The faces of a mesh that rays meet (CGAL's AABB tree). A face that a ray runs along is not met. Throws Error for a
/// mesh without faces, an invalid vertex or index. Any number of threads may ask.
class MeshRays
{
public:
  explicit MeshRays(const TriangleMesh& mesh);
  ~MeshRays();

  /// The faces on the way from a point (mm) along a unit direction, up to `reach` mm, nearest first. Faces that share
  /// the edge or the corner where the ray meets them, and are met from the same side, are one.
  std::vector<RayHit> hits(const Eigen::Vector3d& from, const Eigen::Vector3d& direction, double reach) const;

  /// The first that the ray enters the part by.
  std::optional<RayHit> firstEntered(const Eigen::Vector3d& from, const Eigen::Vector3d& direction, double reach) const;

private:
  class Tree;
  std::unique_ptr<const Tree> Faces;
};
}
