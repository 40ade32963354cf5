// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "pose/MEAMPoseEstimation.h"

#include <string>

namespace meam
{
/// Which stage was the first without a pose, and what to look at first.
std::string adviceOnNothing(const WorkCounts& work);

/// What to change first in the scan, or in the settings, for more parts or surer ones: at most two sentences, the more
/// important one first; empty where parts were found and nothing stands out. `report`: of the search that found the
/// poses. A scan whose viewpoint was guessed is on no grid of its sensor: how much of it was measured is not known.
std::string scanAdvice(const ScanQuality& quality, const DetectionReport& report, const Poses& poses,
  double partDiameter, bool isViewpointGuessed = false);

/// What that rests on, in a line: how large the part is in the scan, its noise and edges, and at which stage how many
/// candidates were left.
std::string scanSummary(
  const ScanQuality& quality, const DetectionReport& report, const Poses& poses, double partDiameter);
}
