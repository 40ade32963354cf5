// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "model/TrainedModel.h"
#include "pose/Pose.h"
#include "scene/Scene.h"

#include <string>

namespace meam
{
/// How many times as thick as in the CAD file the parts of a scan are along the one axis along which the part is too
/// thin for its size to be measured, by the floor: right parts do not lie in it, and some lie on it. 1 where nothing
/// tells of another thickness: no floor is in sight, or too few parts lie on it, whatever the thickness. A sensor that
/// sees parts deeper than the floor shows the same as thinner parts. `poses`: in the local frame.
double thicknessByFloor(const Poses& poses, const Scene& scene, const TrainedModel& model);

/// In one sentence, for users; empty for 1.
std::string thicknessWords(double factor);
}
