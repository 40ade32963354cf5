// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/PointCloud.h"

#include <mutex>
#include <vector>

namespace meam
{
struct TrainedModel;

/// What shows of a part from a direction may be more symmetric than the part: of a block with a step the flat back. So
/// turned it looks the same from there, though the symmetries of the part, which ask for most of its surface, say
/// nothing of it.
struct SideSymmetry
{
  Eigen::Vector3f towards;              ///< unit, from the part to the sensor, in the part's frame
  std::vector<Eigen::Isometry3d> turns; ///< about that direction, mm; none that is a near-symmetry of the part
};

/// The symmetries of the sides of a part, found when they are first asked for. Calls may run in parallel.
class SideSymmetries
{
public:
  /// `model` is the one that holds this.
  const std::vector<SideSymmetry>& of(const TrainedModel& model) const;

private:
  mutable std::once_flag AreFound;
  mutable std::vector<SideSymmetry> Found;
};
}
