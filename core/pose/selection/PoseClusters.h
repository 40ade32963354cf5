// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/Error.h"
#include "model/TrainedModel.h"
#include "pose/Pose.h"
#include "pose/SamePose.h"

#include <vector>

namespace meam
{
struct PoseClustersSettings
{
  double distance = 0.0; ///< mm, poses whose middles are nearer than this are of one instance; 0: 10 % of the diameter
  double distanceShare = SamePose().distance;
  double distanceFor(double diameter) const
  {
    return this->distance > 0.0 ? this->distance : this->distanceShare * diameter;
  }
  double angle = SamePose().angle; ///< degrees, poses of one instance that are turned less than this are the same
  int posesPerInstance = 1;        ///< that stay
};

/// Of poses, best first, the indices of those that stay, ascending: of one instance so many of the first, no two of
/// them the same up to the symmetries `same`, near ones among them.
std::vector<int> firstOfClusters(const Poses& poses, const Symmetries& same, const TrainedModel& model,
  const PoseClustersSettings& settings, const Progress& progress = {});
}
