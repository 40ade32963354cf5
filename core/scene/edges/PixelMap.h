// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/Error.h"
#include "scene/Camera.h"
#include "scene/OrganizedCloud.h"

namespace meam
{
/// Which point of an organized cloud each pixel of an image shows, row by row.
struct PixelMap
{
  int width = 0;
  int height = 0;
  std::vector<int> points;     ///< row * width + column in the cloud's grid; -1: none that the sensor measured
  std::vector<float> depths;   ///< mm, how far that point is along the camera's z axis
  double pixelsPerPoint = 1.0; ///< distance in the image of neighbouring grid points, median
};

/// The image of a camera beside the sensor, whose size has to be known. The surface is filled between
/// neighbouring points, so that nothing shows through it, and a pixel gets the nearest point on what is in front.
/// Where neighbours are more than `jump` (mm) apart, or an opening between them was not measured, something
/// unknown stands: it hides what lies behind it and has no points itself.
///
/// Throws Error for a camera without a size or that does not see the scene.
PixelMap projectedPixels(
  const OrganizedCloud& cloud, const Camera& camera, double jump, int threads = 0, const Progress& progress = {});

/// The point of an edge pixel, or -1: of the pixels within `radius`, the closest one that shows the nearest
/// surface there; `jump` (mm) tells surfaces apart.
int pointOfPixel(const PixelMap& map, int row, int column, int radius, double jump);
/// The same of an image that is registered with the cloud: its pixels are the grid's points.
int pointOfPixel(const OrganizedCloud& cloud, int row, int column, int radius, double jump);
}
