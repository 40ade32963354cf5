// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/Error.h"
#include "pose/Pose.h"
#include "pose/search/Suppression.h"
#include "pose/selection/PoseComparison.h"

namespace meam
{
/// Tells which poses of a part are of one instance: their middles are nearer than `distance`, or nearer than half a
/// diameter, and they explain mostly the same. Keeps references to scene and model; calls may run in parallel.
class InstanceClaims
{
public:
  /// `distance` in mm.
  InstanceClaims(const Scene& scene, const TrainedModel& model, double distance);

  struct Claim
  {
    Eigen::Vector3d middle; ///< of the part
    ExplainedPoints points;
  };
  Claim of(const Eigen::Isometry3d& T_scene_model) const;
  bool areOne(const Claim& a, const Claim& b) const;

private:
  const Scene& InScene;
  const TrainedModel& Model;
  double Distance; ///< mm
};

/// Of poses, best first, the indices of one for each instance, ascending. `compares`: of nearly equal evidence the one
/// stays that the scene speaks for, point by point; else the first.
std::vector<int> bestOfInstances(const Poses& poses, const InstanceClaims& claims, const PoseComparison& comparison,
  bool compares, int threads, const Progress& progress = {});
}
