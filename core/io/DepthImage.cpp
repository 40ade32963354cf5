// SPDX-License-Identifier: BSD-3-Clause
#include "io/DepthImage.h"

#include "io/ImageFile.h"
#include "scene/DepthCloud.h"

namespace meam
{
OrganizedCloud readDepthImage(
  const std::string& path, const Camera& camera, double depthScale, const Progress& progress)
{
  requireCamera(camera);
  report(progress, 0.0);
  const DepthPixels depths = readDepthPixels(path);
  return cloudOfDepths(depths.pixels, depths.width, depths.height, camera, depthScale, "The depth image '" + path + "'",
    subProgress(progress, 0.5, 1.0));
}
}
