// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "pose/Pose.h"
#include "pose/refinement/PoseRefinement.h"
#include "pose/selection/PoseComparison.h"

namespace meam
{
struct RefinementRestartsSettings
{
  bool halfTurns = true;      ///< starts at half turns
  bool smallTurns = true;     ///< starts at `turn` to both sides
  double turn = 10.0;         ///< degrees, beside half a turn
  double distanceShare = 0.1; ///< of the diameter, the correspondences at the start
  int iterations = 6;         ///< steps; what stays is aligned afterwards
  double worthTrying = 1e-3;  ///< probability of a pose before: less, and it stays as it is;
  double sure = 0.9;          ///< more, and it is tried at half turns alone
};

/// Refines a pose once more from where it is turned about the part's principal axes: by half a turn, for thin parts fit
/// nearly as well upside down, and by a little to both sides, for a flat part's refinement may end beside the truth.
/// Turns by the part's symmetries, and about the axis of a nearly round one, are left out (RotationDecision and
/// RotationSearch). Calls may run in parallel.
class RefinementRestarts
{
public:
  /// Keeps references to all but the settings.
  RefinementRestarts(const Scene& scene, const TrainedModel& model, const PoseComparison& comparison,
    const RefinementRestartsSettings& settings);

  /// The pose, or that of a restart which the scene speaks for more. `asItIs` is the pose as a contender, and follows
  /// it.
  Pose best(const Pose& pose, PoseComparison::Contender& asItIs) const;

private:
  const Scene& InScene;
  const TrainedModel& Model;
  const PoseComparison& Comparison;
  RefinementRestartsSettings Settings;
  PoseRefinementSettings Refinement;
  std::vector<Eigen::Isometry3d> HalfTurns, SmallTurns; ///< in the part's frame
};
}
