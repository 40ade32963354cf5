// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/Error.h"
#include "scene/OrganizedCloud.h"

namespace meam
{
struct ImageEdgeSettings
{
  double smoothing = 1.0; ///< pixels, sigma of the Gaussian before Canny; 0: none
  // Canny's thresholds on the gradient (grey values, Sobel)
  double lowThreshold = 0.0;  ///< 0: 0.4 of the high threshold
  double highThreshold = 0.0; ///< 0: automatic
};

/// A pixel on an edge of an image.
struct EdgePixel
{
  int column = 0;
  int row = 0;
  Eigen::Vector2f direction = Eigen::Vector2f::UnitX(); ///< unit, along the edge; the sign carries no meaning
};

/// Canny's edges, row by row (paper, Section 3). The automatic threshold stands clear of what noise does to
/// the gradient, as pixels that are neither black nor white show it, and leaves out weak edges where there
/// are plenty of strong ones. An image of one colour has no edges.
///
/// Throws Error for an image without pixels or of another shape, and for settings out of range.
std::vector<EdgePixel> findImageEdges(const Image& image, const ImageEdgeSettings& settings = {}, int threads = 1);
}
