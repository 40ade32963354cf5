// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "pose/objective/SurfaceContinuation.h"
#include "pose/objective/SurfaceMisfit.h"
#include "pose/search/InstanceSuppression.h"
#include "pose/selection/InstanceOdds.h"
#include "pose/selection/PoseSelection.h"

namespace meam
{
/// Takes poses, one of each instance, to where the scan speaks for them the most (LocalSearch), the best first and only
/// as far as it matters: not what is hopeless where it lies or what a sure pose excludes, and not what follows when
/// enough are sure or when a long row of better ones has not become sure.
class InstanceFinishing
{
public:
  /// Keeps references to all.
  InstanceFinishing(const Scene& scene, const TrainedModel& model, const LocalSearch& search,
    const InstanceClaims& claims, const PoseSelectionSettings& settings);

  /// Of `scored` those at `selected`, best first; what is not finished keeps its pose and is judged there.
  FinishedInstances finished(const Poses& scored, const std::vector<int>& selected, const Progress& progress) const;

  const SurfaceContinuation& continuation() const { return this->Continuation; }
  const SurfaceMisfit& misfit() const { return this->Misfit; }

private:
  /// A finished pose that is sure.
  struct Sure
  {
    Eigen::Isometry3d T_scene_model;
    double logOdds;
    InstanceClaims::Claim claim;
  };
  FinishedInstance finish(const Pose& scored) const;
  bool isExcluded(const Pose& scored, const std::vector<Sure>& sure) const;
  /// What is said of one that is not finished, by its pose as it is.
  void judgeWhereItLies(FinishedInstance& instance) const;

  const Scene& InScene;
  const TrainedModel& Model;
  const LocalSearch& Search;
  const InstanceClaims& Claims;
  const PoseSelectionSettings& Settings;
  SurfaceContinuation Continuation;
  SurfaceMisfit Misfit;
};
}
