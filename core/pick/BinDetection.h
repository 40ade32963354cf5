// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/Error.h"
#include "pick/Bin.h"
#include "scene/OrganizedCloud.h"

namespace meam
{
/// Finds an open rectangular bin in a scan of it from above: the floor as BackgroundRemoval finds it, the level whose
/// points lie all around the largest rectangle, and fewer inside of it (the rim; cv::minAreaRect), and how thick that
/// is. Where no floor is in sight, up is against the sensor's direction and the floor as deep as the lowest points.
/// Throws Error where the cloud is not organized, or there is no such rim.
Bin detectBin(const OrganizedCloud& cloud, const Progress& progress = {});
}
