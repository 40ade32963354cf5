// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/Error.h"
#include "base/LocalCloud.h"
#include "model/AppearanceModel.h"

namespace meam
{
enum class TangentMethod
{
  Tiles,       ///< Algorithms 1 and 2 of the paper
  RobustLine,  ///< the best supported line in a sphere, then the principal axis of its inliers
  LineSegments ///< the same, of points on line segments alone: what B2B takes (Choi et al., ICRA 2012)
};

/// Lengths in mm. A length of 0 follows the part's diameter.
struct TangentEstimationSettings
{
  TangentMethod method = TangentMethod::RobustLine;
  double leafSize = 0.0;        ///< of the points in a cube of this side one is kept; negative: all; 0: sceneLeafShare
  double sceneLeafShare = 0.03; ///< of the diameter, in a scene,
  double modelLeafShare = 0.02; ///< and in a model, whose points are exact

  // RobustLine, LineSegments
  double radius = 0.0;           ///< of the sphere; 0: radiusShare
  double radiusShare = 0.06;     ///< of the diameter, and no less than a segment needs; of measured points more:
  double radiusInliers = 4.0;    ///< times the inlier distance,
  double radiusSpacings = 3.0;   ///< and times the spacing of the points,
  double mostRadiusShare = 0.12; ///< of the diameter, at most
  double inlierDistance = 0.0;   ///< to the line; 0: inlierShare
  double inlierShare = 0.012;    ///< of the diameter; of measured points more:
  double inlierNoise = 2.2;      ///< standard deviations of their noise,
  double mostInlierShare = 0.03; ///< of the diameter, at most
  double candidateShare = 0.3;   ///< of the radius: lines are tried through one point in each cube of this side
  int fewestInliers = 4;         ///< of a line: one through three points of a band of edge points is chance
  int measuredPoints = 400;      ///< around so many noise and spacing are measured,
  int fewestForNoise = 12;       ///< noise where there are so many neighbours
  double noiseQuantile = 0.25;   ///< of their distances from a plane: more where edges are curved or planes many

  // LineSegments
  double segmentLength = 0.0; ///< a shorter run of points on a line is no segment; 0: segmentShare
  double segmentShare = 0.15; ///< of the diameter
  double segmentReach = 1.25; ///< lengths of a segment, the radius at least: its ends have to see all of it
  double segmentGap = 0.2;    ///< of that length: a longer gap ends a segment

  // Tiles
  int tilePixels = 10;       ///< H_rec = W_rec
  double pixelSize = 0.5;    ///< mm on the projection plane; the paper does not say
  double lineDistance = 0.3; ///< D_thresh
  double lineSupport = 0.18; ///< S_thresh, share of a tile's points

  int threads = 0; ///< 0: one for each processor
};

/// The paper's settings (Section 6) in place of the recommended ones.
TangentEstimationSettings paperTangentSettings();

/// Edge points that stay when they are thinned, with their tangents and weights, as thinWithWeights() has them.
struct ThinnedEdges
{
  LocalCloud edges;
  std::vector<int> indices; ///< of these in the cloud that was given
};

/// Thins a scene's edge points and gives each a tangent direction; points without a supported line are
/// left out (Algorithm 2), as are those that are on no line segment, where these are asked for. Points that carry
/// tangents, as edges of a mesh or of an image do, keep them and are only thinned. `partDiameter` (mm) sets lengths
/// that are 0. Tiles are cut on the plane across `viewDirection`, which is in the scene's own coordinates. Throws Error
/// for an empty cloud, for one that cannot be in the diameter's unit, or when a length is 0 and the diameter is too.
ThinnedEdges estimateTangents(const LocalCloud& edges, double partDiameter, const Eigen::Vector3d& viewDirection,
  const TangentEstimationSettings& settings = {}, const Progress& progress = {});

/// The same for each edge appearance model, seen from its viewpoint.
std::vector<AppearanceModel> estimateTangents(std::vector<AppearanceModel> models, double partDiameter,
  const TangentEstimationSettings& settings = {}, const Progress& progress = {});
}
