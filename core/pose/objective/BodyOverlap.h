// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "model/TrainedModel.h"

namespace meam
{
/// Whether parts at two poses cut into each other, for no two bodies are in the same place: a noticeable share of the
/// surface of one lies deeper in the other than poses are off. A body that is too thin for that cuts nothing.
bool bodiesOverlap(const TrainedModel& model, const Eigen::Isometry3d& a, const Eigen::Isometry3d& b);
}
