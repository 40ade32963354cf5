// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "scene/Sensor.h"

namespace meam
{
/// All that is known of a bin at the time of detection; mm.
struct Scene
{
  PointCloud edges; ///< edge points with tangents
  Points surface;   ///< all points the sensor measured; may be empty
  Sensor sensor;
};
}
