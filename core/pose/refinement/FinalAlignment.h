// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "pose/Pose.h"
#include "pose/refinement/PoseFitter.h"

namespace meam
{
/// Shares of the part's diameter, where nothing else is said.
struct FinalAlignmentSettings
{
  double window = 0.02;       ///< from a point of the part to edge points that count
  double across = 0.006;      ///< the same across its tangent, and along the normal of its surface
  double margin = 0.003;      ///< that a point moves by before its edge points are looked up again
  double widestFirst = 1.5;   ///< times `across` in the first step
  double leastMotion = 3e-6;  ///< less is none: the pose stays
  int steps = 15;             ///< at most
  int visibilitySteps = 8;    ///< in the first ones the predicted visibility is looked up again
  double extrapolation = 5.0; ///< times its length that a step is taken farther, at most
  double farthest = 0.02;     ///< a pose that comes to stay farther from where it was has gone astray,
  double mostTurned = 3.0;    ///< or turned by more degrees
  double fitDistance = 0.012; ///< between corresponding points, for the fit of a pose that is not aligned
  PoseFitterSettings fitter;
};

/// Final robust alignment: iteratively reweighted least squares on edges and surface, with residuals that change
/// steadily with the pose, until it stays; steps are extrapolated (Aitken's delta-squared process, as a secant). From
/// anywhere within 2 % of the diameter the same place. The pose, in the local frame, as it came where the scene leaves
/// it a freedom that is none of the part's symmetries, or leads it farther away. The residual is that of means over
/// edge points, less than that of the points.
Pose alignRobustly(
  const Pose& pose, const Scene& scene, const TrainedModel& model, const FinalAlignmentSettings& settings = {});

/// How well the scene fixes a pose where it is, in the local frame. What it differs by from `T_aligned`, where least
/// squares leave it, adds to the covariance.
PoseFit fitInPlace(const Pose& pose, const Eigen::Isometry3d& T_aligned, const Scene& scene, const TrainedModel& model,
  const FinalAlignmentSettings& settings = {});
}
