// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/Error.h"
#include "scene/Camera.h"
#include "scene/OrganizedCloud.h"

#include <string>
#include <vector>

namespace meam
{
/// The cloud that a camera measured, in its own frame: of `depths` width times height, row by row from the top, one for
/// each pixel, along the camera's z axis; times `scale` they are mm. 0, less, and what is not finite are no depth.
/// Where the camera is in the scene does not matter. Throws Error for another number of depths, a camera of another
/// size, where that is known, a scale that is not positive, and where nothing is nearer than 50 m. `what`: the depths
/// in a message, as "The depth image 'a.png'".
OrganizedCloud cloudOfDepths(const std::vector<float>& depths, int width, int height, const Camera& camera,
  double scale, const std::string& what, const Progress& progress = {});
}
