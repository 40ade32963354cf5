// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Error.h"
#include "scene/OrganizedCloud.h"

namespace meam
{
struct SceneEdgeExtractionSettings
{
  double smoothing = 1.0; ///< pixels, sigma of the Gaussian before Canny; 0: none
  // Canny's thresholds on the gradient (grey values, Sobel)
  double lowThreshold = 0.0;  ///< 0: 40 % of the high threshold
  double highThreshold = 0.0; ///< 0: from the distribution of the image's gradients
  int searchRadius = 1;       ///< pixels around an edge pixel in which its depth is looked for
  double depthJump = 0.0;     ///< mm between two surfaces that are neighbours; 0: 3 point distances
};

/// The points of the scene's edges: Canny on the registered image, each edge pixel taken to 3D. At
/// a depth jump the edge belongs to the surface that is nearer to the sensor; a pixel without depth
/// takes its neighbour's. Every grid point comes at most once; pointIds are row * width + column.
///
/// Throws Error for a cloud that is not organized or has no valid depth, an image of another size,
/// or settings out of range. An image of one colour has no edges: the result is empty.
PointCloud extractSceneEdges(const OrganizedCloud& cloud, const Image& image,
  const SceneEdgeExtractionSettings& settings = {}, const Progress& progress = {});
}
