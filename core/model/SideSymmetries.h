// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/PointCloud.h"

#include <mutex>
#include <vector>

namespace meam
{
struct TrainedModel;

/// From some directions a part looks more symmetric than it is, as the flat back of a block with a step. After these
/// turns it looks the same from there.
struct SideSymmetry
{
  Eigen::Vector3f towards;              ///< unit, from the part to the sensor, in the part's frame
  std::vector<Eigen::Isometry3d> turns; ///< about that direction, mm; none within 15 degrees of a near-symmetry
};

/// The symmetries of the sides of a part, found when they are first asked for. Calls may run in parallel.
class SideSymmetries
{
public:
  SideSymmetries() = default;
  /// Of a model of which they are known.
  explicit SideSymmetries(std::vector<SideSymmetry> known);

  /// `model` is the one that holds this.
  const std::vector<SideSymmetry>& of(const TrainedModel& model) const;

private:
  mutable std::once_flag AreFound;
  mutable std::vector<SideSymmetry> Found;
};
}
