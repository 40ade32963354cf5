// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/PointCloud.h"

#include <string>

namespace meam
{
/// Makes NaN of the points by which a sensor says that it measured nothing, in any frame: those at the origin, and
/// those of one z that many have, far beyond what the others span, such as 65535. Says in a sentence which; empty when
/// there are none.
std::string removeMarkers(Points& points);

/// The same of points in their sensor's frame: those of one depth that many have and no other comes near, and those
/// behind the sensor, when most are in front of it.
std::string removeByDepth(Points& points);
}
