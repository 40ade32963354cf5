// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "pose/Pose.h"
#include "pose/refinement/PoseRefinement.h"
#include "pose/selection/PoseComparison.h"
#include "pose/verification/PoseEvidence.h"

namespace meam
{
/// Decides between a pose and its turns that hardly move the part's surface: by its near-symmetries, and of a nearly
/// round part by every step about its axis, at which the surface fits as well where the notch that tells them apart is
/// out of sight. Calls may run in parallel.
class RotationDecision
{
public:
  /// Keeps references to all but the rates; `rotated` refines a pose that was turned by a step.
  RotationDecision(const Scene& scene, const TrainedModel& model, const PoseComparison& comparison,
    const EvidenceCollector& collector, const EvidenceRates& rates, const PoseRefinementSettings& rotated);

  /// Turns the pose to where the scene speaks for it most, by the comparison and, of a pose that is likely, by the
  /// evidence, and sets its certainty, how likely that rotation is among all, and the alternatives to it. `asItIs` is
  /// the pose as a contender.
  void decide(Pose& pose, PoseComparison::Contender asItIs) const;

private:
  const Scene& InScene;
  const TrainedModel& Model;
  const PoseComparison& Comparison;
  const EvidenceCollector& Collector;
  EvidenceRates Rates;
  const PoseRefinementSettings& Rotated;
  std::vector<Eigen::Isometry3d> Turns; ///< in the part's frame, without the identity; the near-symmetries first
};
}
