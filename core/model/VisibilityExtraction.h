// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/Error.h"
#include "base/PointCloud.h"
#include "mesh/TriangleMesh.h"
#include "model/AppearanceModel.h"

namespace meam
{
class LineOfSight;

enum class VisibilityMethod
{
  HiddenPointRemoval, ///< of the samples alone (Katz, Tal and Basri, SIGGRAPH 2007), as in the paper
  MeshVisibility      ///< exact: the line of sight from each sample against the mesh
};

struct VisibilityExtractionSettings
{
  VisibilityMethod method = VisibilityMethod::HiddenPointRemoval;
  /// 1, 2, 6 (the paper), 14, 26, or N on a Fibonacci sphere; 0: the whole part as one model ("without MEAM")
  int viewpoints = 6;
  Eigen::Vector3d coneDirection = Eigen::Vector3d::UnitZ(); ///< of any length; the middle of the viewpoints
  double coneAngle = 180.0;        ///< degrees: viewpoints are no farther from the cone's direction; 180: all around
  double viewpointDistance = 10.0; ///< from the middle of the part, in part diameters

  // HiddenPointRemoval
  double radiusFactor = 1000.0; ///< gamma: radius of the inversion sphere over the farthest distance
};

/// Indices, ascending, of the points that are visible from `viewpoint`: hidden point removal of Katz,
/// Tal and Basri (SIGGRAPH 2007) by inversion in a sphere around the viewpoint and a convex hull.
std::vector<int> visiblePoints(const Points& points, const Eigen::Vector3d& viewpoint, double radiusFactor);

/// Indices, ascending, of the samples that `viewpoint` sees of a mesh. Both sides of a face can be seen:
/// the back of a closed mesh is hidden by its front, an open sheet shows the side that faces the viewpoint.
std::vector<int> visiblePoints(
  const PointCloud& surface, const Eigen::Vector3d& viewpoint, const LineOfSight& sight, const Progress& progress = {});

/// One appearance model for each viewpoint (paper, Section 4): the points of `surface` (mm) that are
/// visible from it. `mesh` is what the surface was sampled from; only MeshVisibility needs it, and turns
/// the normals of what is seen towards the viewpoint. A viewpoint that sees nothing, such as a flat
/// sheet's from its side, has no model. No viewpoints: one model "Whole part" of all samples, as they are,
/// towards +z; neither method, nor cone, nor mesh plays a part. Throws Error for an empty surface or one of
/// NaN, and without what the method needs.
std::vector<AppearanceModel> extractVisibility(const PointCloud& surface,
  const VisibilityExtractionSettings& settings = {}, const TriangleMesh* mesh = nullptr, const Progress& progress = {});
}
