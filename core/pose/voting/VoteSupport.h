// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "pose/voting/PoseDetection.h"

#include <vector>

namespace meam
{
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
  const TrainedModel& model, const PoseDetectionSettings& detection, const Progress& progress = {});
}
