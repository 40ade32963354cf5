// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "scene/OrganizedCloud.h"
#include "scene/Sensor.h"

#include <optional>
#include <string>
#include <vector>

namespace meam
{
/// Where a scan is seen from.
struct ScanViewpoint
{
  Eigen::Isometry3d T_sensor_scan = Eigen::Isometry3d::Identity(); ///< mm, to the frame that looks along +z
  bool perspective = true;                                         ///< from that frame's origin
  std::string report; ///< in sentences, what was assumed of the axes; empty for x right, y down and z forward
};

/// The way that a given sensor looks, unit: a perspective one without a direction, (0, 0, 0), at the middle of the
/// points. Zero where neither tells.
Eigen::Vector3d lookingDirection(const Sensor& sensor, const Points& points);

/// What a given sensor is.
ScanViewpoint viewpointOf(const Sensor& sensor);

/// Whether all points but strays lie within 60 degrees of the way from a perspective sensor to their middle.
bool seesAll(const Sensor& sensor, const Points& points);

/// Of an organized cloud, by where its points lie on its grid. Its sensor is at the origin and looks along an axis when
/// pixels follow the rays from there; otherwise it is a pinhole camera elsewhere, as in a robot's frame, or an
/// orthographic one, as of a height map, which is seen from above. Where nothing fits, at the origin, along +z.
ScanViewpoint viewpointOfGrid(const OrganizedCloud& cloud);

/// That a cloud without a grid is usually seen from, the likeliest first: the origin, along +z or -z, when all lies
/// ahead of it within 60 degrees and its middle within 30; far above, along -z; the origin, along another axis that all
/// lies ahead of. The grid of its sensor, where it is found again, tells which.
std::vector<ScanViewpoint> likelyViewpoints(const Points& points);
}
