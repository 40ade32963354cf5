// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/PointCloud.h"
#include "scene/Sensor.h"

#include <optional>

namespace meam
{
constexpr double HiddenByNoise = 0.06; ///< share of a sensor's own points that lie behind others, with steep walls

/// Where points alone were most likely seen from: a sensor measures what nothing hides, so that from its place the
/// fewest points lie behind others. A perspective sensor that looks at their middle; none where hardly more do for
/// `guess`, and where many do from everywhere, as of several views. It is not looked for, which takes some hundred
/// looks, where no more than a share of the points, `mayHide`, lie behind others for the guess.
std::optional<Sensor> searchViewpoint(const Points& points, const Sensor& guess, double mayHide);
}
