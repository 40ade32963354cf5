// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "pick/Bin.h"
#include "pick/PickSettings.h"
#include "pick/planning/PartSurface.h"
#include "pose/Pose.h"
#include "scene/OrganizedCloud.h"
#include "scene/edges/GridSurface.h"

#include <optional>
#include <vector>

namespace meam
{
/// A scan as planning sees it.
struct PickSurroundings
{
  Points points;                                  ///< all, thinned
  Points unexplained;                             ///< those of neither a copy nor the bin
  double voxelSize = 0.0;                         ///< mm
  double tolerance = 0.0;                         ///< mm
  Eigen::Vector3d up = -Eigen::Vector3d::UnitZ(); ///< unit
  double top = 0.0;                               ///< mm along `up`: the bin's rim, or the highest point
  std::vector<int> copies;                        ///< poses that are likely enough to stand in the way
  std::vector<std::vector<int>> pointsOf;         ///< of each copy
};

/// What lies around the copies of a part that is `partSize` mm large; `surfaces`: of each pose that of its part, which
/// may be another one; `scale`: of the cloud.
PickSurroundings surroundingsOf(const Poses& poses, const std::vector<const PartSurface*>& surfaces,
  const OrganizedCloud& cloud, const GridScale& scale, const std::optional<Bin>& bin, double partSize,
  const PlanSettings& settings);

/// Share, [0, 1], of a pose, the `copy`th of the copies, that lies under something, from above.
double coveredShare(const Pose& pose, int copy, const PartSurface& surface, const PickSurroundings& around);

/// How likely a pose is, [0, 1], `needsRotation`: its rotation included; 1 of one of which nothing is known, such as a
/// true one.
double confidence(const Pose& pose, bool needsRotation);
}
