// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "pose/Pose.h"
#include "pose/refinement/PoseFitter.h"

namespace meam
{
/// Final robust alignment: iteratively reweighted least squares on edges and surface, with residuals that change
/// steadily with the pose, until it stays; steps are extrapolated (Aitken's delta-squared process, as a secant). From
/// anywhere within 2 % of the diameter the same place. The pose, in the local frame, as it came where the scene leaves
/// it a freedom that is none of the part's symmetries, or leads it farther away. The residual is that of means over
/// edge points, less than that of the points.
Pose alignRobustly(const Pose& pose, const Scene& scene, const TrainedModel& model);

/// How well the scene fixes a pose where it is, in the local frame. What it differs by from `T_aligned`, where least
/// squares leave it, adds to the covariance.
PoseFit fitInPlace(const Pose& pose, const Eigen::Isometry3d& T_aligned, const Scene& scene, const TrainedModel& model);
}
