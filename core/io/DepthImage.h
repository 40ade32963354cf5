// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/Error.h"
#include "scene/Camera.h"
#include "scene/OrganizedCloud.h"

#include <string>

namespace meam
{
/// Reads a depth image, one channel of whole numbers (PNG, TIFF or PGM) or of real ones (TIFF or PFM), as the cloud
/// that the camera measured: a point for each pixel, in the camera's frame; a pixel times `depthScale` is the distance
/// along its z axis in mm; 0, less, and the largest value of 8 or 16 bits are no depth. Where the camera is in the
/// scene does not matter. Throws Error for a file that is no depth image, one of another size than the camera's, where
/// that is known, and a scale that is not positive.
OrganizedCloud readDepthImage(
  const std::string& path, const Camera& camera, double depthScale = 1.0, const Progress& progress = {});
}
