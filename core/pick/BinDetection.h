// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/Error.h"
#include "pick/Bin.h"
#include "scene/OrganizedCloud.h"

namespace meam
{
struct BinDetectionSettings
{
  double mostTilt = 30.0;      ///< degrees between the floor's normal and the sensor's direction
  double fullSides = 60.0;     ///< % of each side of the rim that must have been measured
  double leastSize = 10.0;     ///< % of the scan's extent: a smaller rectangle is none
  double sideTolerance = 0.02; ///< of the rectangle's shorter side: so near a side is on it
  double pointsInLevel = 2.0;  ///< point distances in the height of a level
  double noiseInLevel = 4.0;   ///< standard deviations of the noise besides
  double lowestShare = 0.02;   ///< of the points inside may be lower than the floor: wrong ones
  double thinnestWall = 2.0;   ///< point distances
  double middleShare = 0.7;    ///< of the sides: what lies there is inside of any wall
  double mostInside = 0.5;     ///< of the points there may be as high as the rim: it is no solid block
  double sameArea = 0.05;      ///< rectangles that differ by less are of one rim
  double thickestWall = 0.25;  ///< of the rim's shorter side
};

/// Finds an open rectangular bin in a scan of it from above: the floor as BackgroundRemoval finds it, the level whose
/// points lie all around the largest rectangle, and fewer inside of it (the rim; cv::minAreaRect), and how thick that
/// is. Where no floor is in sight, up is against the sensor's direction and the floor as deep as the lowest points.
/// Throws Error where there is no such rim.
Bin detectBin(const OrganizedCloud& cloud, const BinDetectionSettings& settings = {}, const Progress& progress = {});
}
