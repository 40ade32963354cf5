// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/Error.h"
#include "pose/Pose.h"
#include "pose/SceneIndex.h"

namespace meam
{
enum class RefinementMethod
{
  PointToPoint,       ///< Section 5.3 of the paper: PCL's ICP with the edge appearance model
  EdgesAndSurface     ///< edge points to scene tangents, surface points to planes, those visible only
};

/// Lengths in mm; a length of 0 follows the part's diameter.
struct PoseRefinementSettings
{
  RefinementMethod method = RefinementMethod::EdgesAndSurface;
  int iterations = 10;
  double maximumDistance = 0.0; ///< between corresponding points; 0: 10 % of the diameter, point-to-point 4 %
  int threads = 0;              ///< 0: one for each processor
};

/// The paper's settings in place of the recommended ones.
PoseRefinementSettings paperRefinementSettings();

/// Iterative closest point for each pose (paper, Section 5.3), in the order they come; scores stay.
/// Without a surface only edges count. Of poses that the part's symmetries make equal the nearest to what came comes out.
/// Throws Error for less than one iteration.
Poses refinePoses(const Poses& poses, const SceneIndex& index, const PoseRefinementSettings& settings = {},
  const Progress& progress = {});

/// The same of poses in the frame of the scene's points.
Poses refineInFrame(const Poses& poses, const SceneIndex& index, const PoseRefinementSettings& settings = {},
  const Progress& progress = {});

/// The pose, in the frame of the scene's points, refined once more by edges and surface, by residuals that change steadily
/// and until it stays: from anywhere within 2 % of the diameter the same place. As it came where the scene leaves it a
/// freedom that is none of the part's symmetries, or leads it farther away. The residual is that of means over edge points,
/// less than that of the points.
Pose settlePose(const Pose& pose, const SceneIndex& index);

/// refinePoses in a scene that nothing else is asked about. Throws Error when the scene has no edges.
inline Poses refinePoses(const Poses& poses, const TrainedModel& model, const Scene& scene, const PoseRefinementSettings& settings = {},
  const Progress& progress = {})
{
  return refinePoses(poses, SceneIndex(model, scene, settings.threads), settings, progress);
}
}
