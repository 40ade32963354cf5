// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/PointCloud.h"

#include <string>

namespace meam
{
/// Makes NaN of the points by which a sensor says that it measured nothing: those at the origin; those of one depth
/// that many have and no other comes near, such as 65535; and, of a scan in its sensor's frame, those behind the
/// sensor, when most are in front of it. Says in a sentence which; empty when there are none.
std::string removeUnmeasured(Points& points, bool isInSensorFrame);
}
