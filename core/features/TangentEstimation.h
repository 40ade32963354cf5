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
  double leafSize = 0.0; ///< of the points in a cube of this side one is kept; negative: all; 0: 3 % of the diameter in
                         ///< a scene, 2 % in a model
  // RobustLine, LineSegments
  double radius = 0.0;         ///< of the sphere; 0: 6 % of the diameter, of measured points up to 12
  bool followsNoise = true;    ///< radius and inlier distance that are 0 grow with noise and spacing of measured points
  double inlierDistance = 0.0; ///< to the line; 0: 1.2 % of the diameter, of measured points up to 3
  // LineSegments
  double segmentLength = 0.0; ///< a shorter run of points on a line is no segment; 0: 15 % of the diameter
  // Tiles
  int tilePixels = 10;       ///< H_rec = W_rec
  double pixelSize = 0.5;    ///< mm on the projection plane; the paper does not say
  double lineDistance = 0.3; ///< D_thresh
  double lineSupport = 0.18; ///< S_thresh, share of a tile's points
  int threads = 0;           ///< 0: one for each processor
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
