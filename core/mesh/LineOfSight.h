// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/PointCloud.h"
#include "mesh/TriangleMesh.h"

#include <memory>

namespace meam
{
/// Tells whether the faces of a mesh stand between two points: exactly (CGAL's AABB tree), whichever way
/// they are wound. Throws Error for a mesh without faces, an invalid vertex or index.
class LineOfSight
{
public:
  explicit LineOfSight(const TriangleMesh& mesh);
  ~LineOfSight();

  /// Whether no face touches the segment. Any number of threads may ask.
  bool isFree(const Eigen::Vector3d& from, const Eigen::Vector3d& to) const;

  /// Whether `viewpoint` sees the surface at a point of it: the side that faces the viewpoint, lifted by
  /// a hair off the face. `normal` is unit, of either sign. A face that is seen edge-on is not seen.
  bool isSeen(const Eigen::Vector3d& point, const Eigen::Vector3d& normal, const Eigen::Vector3d& viewpoint) const;

  /// The hair in mm: far below what matters, far above the rounding of coordinates.
  double hair() const;

private:
  class Tree;
  std::unique_ptr<const Tree> Faces;
};
}
