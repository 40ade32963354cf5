// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "mesh/TriangleMesh.h"
#include "model/DistanceField.h"

namespace meam
{
/// Points all over a part's faces, to ask what lies at a copy and what lies on it.
class PartSurface
{
public:
  /// Points about `spacing` mm from each other; distances are told up to `reach` mm. Throws Error for a mesh without
  /// faces, an invalid vertex or index, and a spacing that asks for millions of points.
  PartSurface(const TriangleMesh& part, double spacing, double reach);

  /// A ball around the part, model frame, mm.
  const Eigen::Vector3d& middle() const { return this->Middle; }
  double radius() const { return this->Radius; }

  /// Indices of the points, scene coordinates, that lie within `tolerance` mm, at most the reach, of the copy at a
  /// pose.
  std::vector<int> pointsAt(const Eigen::Isometry3d& T_scene_model, const Points& points, double tolerance) const;

  /// Share, [0, 1], of a copy as seen from `up` (unit, scene) over which one of the points lies, by more than
  /// `tolerance` mm; on a raster with cells of `cell` mm, wider than the points are apart.
  double covered(const Eigen::Isometry3d& T_scene_model, const Eigen::Vector3d& up, const Points& points, double cell,
    double tolerance) const;

private:
  Points Samples;
  DistanceField Distances;
  Eigen::Vector3d Middle = Eigen::Vector3d::Zero();
  double Radius = 0.0;
  double Reach;
};
}
