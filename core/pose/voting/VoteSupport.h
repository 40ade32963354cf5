// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "pose/SamePose.h"
#include "pose/voting/PoseDetection.h"

#include <vector>

namespace meam
{
struct VoteSupportSettings
{
  double onPart = 0.02;                  ///< of the diameter: a scene point this near to the part is on it
  double cellReach = 0.06;               ///< of the diameter: model points this near to a scene point may stand for it
  double distance = SamePose().distance; ///< of the diameter: a turn of a model point whose pose is nearer than this,
  double angle = SamePose().angle;       ///< and turned by less (degrees), votes for the pose
  double turnStep = 7.2;                 ///< degrees, between the equal poses of a round part that are looked at
  int ranks = 10;                        ///< peaks of a reference point that are looked at
};

/// What a scene point on the part votes for as a reference point.
struct PointVotes
{
  Eigen::Vector3f point; ///< local frame
  bool byEdges;          ///< with edge points, or else with points of the surface
  bool isReference;      ///< it was chosen as a reference point
  int votes; ///< for the pose: the best of the model points' cells nearest to it, and of peaks that lead to it
  int most;  ///< of its best peak, wherever that leads to
  int rank;  ///< of its first peak that leads to the pose, from 1; 0: none of those looked at does
};

/// The votes for a pose, up to the part's exact symmetries, of the scene's points on the part there: first the edge
/// points, then those of the surface. Of a ball, turns about the first of its axes alone are looked at.
std::vector<PointVotes> votesForPose(const Eigen::Isometry3d& T_scene_model, const Scene& scene,
  const TrainedModel& model, const PoseDetectionSettings& detection, const VoteSupportSettings& settings = {},
  const Progress& progress = {});
}
