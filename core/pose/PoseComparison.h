// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "pose/SceneIndex.h"

namespace meam
{
/// Decides between poses of one instance by what the sensor saw: every measured point and every scene edge near the
/// instance speaks for the pose that explains it. Points that both explain, or none, do not count, so poses that
/// differ by a near-symmetry are decided by the notch or hole that breaks it. Calls may run in parallel.
class PoseComparison
{
public:
  /// Keeps a reference to the index.
  explicit PoseComparison(const SceneIndex& index)
    : Index(index)
  {
  }

  /// Greater than 0 when the scene speaks for `a`, less for `b`: points that one explains and the other does not.
  double advantage(const Eigen::Isometry3d& a, const Eigen::Isometry3d& b) const;

private:
  const SceneIndex& Index;
};
}
