// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/Error.h"
#include "pose/Pose.h"
#include "pose/refinement/FinalAlignment.h"
#include "pose/refinement/PoseFitter.h"

namespace meam
{
enum class RefinementMethod
{
  PointToPoint,   ///< Section 5.3 of the paper: PCL's ICP with the edge appearance model
  EdgesAndSurface ///< edge points to scene tangents, surface points to planes, those visible only
};

/// Lengths in mm; a length of 0 follows the part's diameter.
struct PoseRefinementSettings
{
  RefinementMethod method = RefinementMethod::EdgesAndSurface;
  int iterations = 10;
  double maximumDistance = 0.0; ///< between corresponding points at the start; 0: a share of the diameter:
  double distanceShare = 0.1;
  double pointDistanceShare = 0.04; ///< the same of point-to-point ICP
  double lastDistanceShare = 0.12;  ///< of that distance at the end: correspondences get nearer step by step
  int fullSteps = 1;                ///< the last ones, with all points
  int coarseStride = 4;             ///< of the points in the steps before one of so many
  PoseFitterSettings fitter;
  int threads = 0; ///< 0: one for each processor
};

/// The paper's settings in place of the recommended ones.
PoseRefinementSettings paperRefinementSettings();

/// Iterative closest point for each pose (paper, Section 5.3), in the order they come, in the local frame; scores stay.
/// Without a surface only edges count. Throws Error for less than one iteration.
Poses refinePoses(const Poses& poses, const Scene& scene, const TrainedModel& model,
  const PoseRefinementSettings& settings = {}, const Progress& progress = {});
}
