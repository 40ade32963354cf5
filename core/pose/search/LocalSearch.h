// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "pose/Pose.h"
#include "pose/objective/DepthFit.h"
#include "pose/refinement/PoseRefinement.h"
#include "pose/search/PatternSearch.h"
#include "pose/selection/PoseComparison.h"
#include "pose/verification/PoseEvidence.h"
#include "pose/verification/RotationSearch.h"

#include <optional>

namespace meam
{
struct LocalSearchSettings
{
  bool halfTurns = true; ///< refines from half turns about the principal axes, for thin parts fit nearly as well upside
                         ///< down
  bool smallTurns = true; ///< refines from 10 or 6 degrees to both sides, for a flat part's refinement may end beside
                          ///< the truth
  bool aboutAxis = true;  ///< turns a nearly round part about its axis to where the scene's edges fit its own
  bool nearSymmetries = true; ///< decides between near-symmetries, those of the side that is seen among them, of a
                              ///< nearly round part every step about its axis,
  bool depthFit = true;       ///< by the measured depth point by point, too
  bool aligns = true;         ///< robustly, at the end
  bool maximizes = true;      ///< moves an aligned pose that the scan contradicts
  PatternSearchSettings pattern;
};

/// Looks for the best pose of an instance: multi-start ICP about the part's principal axes, near-symmetry
/// disambiguation, for the surface fits as well there where the notch that tells them apart is out of sight, final
/// alignment (alignRobustly), and where the scan contradicts that, maximization of the log odds (PatternSearch). Calls
/// may run in parallel.
class LocalSearch
{
public:
  /// Keeps references to scene, model, comparison and collector.
  LocalSearch(const Scene& scene, const TrainedModel& model, const PoseComparison& comparison,
    const EvidenceCollector& collector, const EvidenceRates& rates, const LocalSearchSettings& settings = {});

  struct Result
  {
    Pose pose; ///< with its certainty, how likely its rotation is among all, the alternatives to it, and its fit
    PoseEvidence evidence; ///< at it
    double logOdds;        ///< that a copy is there
  };
  /// The pose, or the one that the scene speaks for most.
  Result best(Pose pose) const;
  /// Logarithm of the odds that a copy is at a pose as it is.
  double placeLogOdds(const Eigen::Isometry3d& T_scene_model) const;

private:
  using Contender = PoseComparison::Contender;
  /// Takes the best of the poses refined from half turns and small ones; `current` is the pose as a contender.
  void restart(Pose& pose, Contender& current) const;
  /// Takes the better of the rotations about the axis of a nearly round part, refined.
  void turnAboutAxis(Pose& pose, Contender& current) const;
  /// Takes the likeliest rotation, by the comparison and, of a pose that is likely, by the evidence and the depth.
  void decide(Pose& pose, Contender current) const;
  /// Poses that hardly move the surface, the near-symmetries first. `all`: those beyond them, too, of the side that the
  /// sensor sees among them.
  std::vector<Eigen::Isometry3d> rotationsOf(const Eigen::Isometry3d& T_scene_model, bool all) const;
  /// Adds the evidence for each of the rotations against the first to their share, which is the advantage here, where
  /// it is more than `least`; with less a rotation is none.
  void addEvidence(std::vector<RotationAlternative>& rotations, double least) const;
  /// The same with the measured depth where it tells of rotations, of those that are not hopeless.
  void addDepth(std::vector<RotationAlternative>& rotations) const;

  const Scene& InScene;
  const TrainedModel& Model;
  const PoseComparison& Comparison;
  const EvidenceCollector& Collector;
  EvidenceRates Rates;
  LocalSearchSettings Settings;
  RotationSearch Search;
  PoseRefinementSettings AfterTurn; ///< refinement of a pose that is nearly right
  // In the part's frame, without the identity
  std::vector<Eigen::Isometry3d> HalfTurns, SmallTurns, SmallerTurns;
  std::vector<Eigen::Isometry3d> Rotations; ///< that hardly move the surface: near-symmetries first, then steps
  std::size_t NearSymmetries = 0;           ///< of these
  PatternSearch Pattern;
  std::optional<DepthFit> Depth; ///< where it tells of rotations
};
}
