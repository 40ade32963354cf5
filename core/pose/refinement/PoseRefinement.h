// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/Error.h"
#include "model/TrainedModel.h"
#include "pose/Pose.h"
#include "scene/Scene.h"

namespace meam
{
enum class RefinementMethod
{
  PointToPoint,   ///< Section 5.3 of the paper: PCL's ICP with the edge appearance model
  EdgesAndSurface ///< edge points to scene tangents, surface points to planes, those visible only
};

struct PoseRefinementSettings
{
  RefinementMethod method = RefinementMethod::EdgesAndSurface;
  int iterations = 10;
  /// mm, between corresponding points at the start; 0: 10 % of the diameter, of PointToPoint 4 %.
  double maximumDistance = 0.0;
  bool fullLastStep = true; ///< EdgesAndSurface: of all points, those before of some
  int threads = 0;          ///< 0: one for each processor
};

/// Iterative closest point for each pose (paper, Section 5.3), in the order they come, in the local frame; scores stay.
/// Without a surface only edges count. Throws Error for less than one iteration.
Poses refinePoses(const Poses& poses, const Scene& scene, const TrainedModel& model,
  const PoseRefinementSettings& settings = {}, const Progress& progress = {});
}
