// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/Error.h"
#include "pick/Bin.h"
#include "scene/OrganizedCloud.h"

namespace meam
{
struct BinDetectionSettings
{
  double mostTilt = 30.0;  ///< degrees between the floor's normal and the sensor's direction
  double fullSides = 60.0; ///< % of each side of the rim that must have been measured
  double leastSize = 10.0; ///< % of the scan's extent: a smaller rectangle is none
};

/// Finds an open rectangular bin in a scan of it from above: the floor as BackgroundRemoval finds it, the highest level
/// whose points lie all around a rectangle and
/// less inside of it (the rim; cv::minAreaRect), and how thick that is. Where no floor is in
/// sight, up is against the sensor's direction and the floor as deep as the lowest points. Throws Error where there is
/// no such rim.
Bin detectBin(const OrganizedCloud& cloud, const BinDetectionSettings& settings = {}, const Progress& progress = {});
}
