// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "pose/MEAMPoseEstimation.h"
#include "scene/edges/SceneEdgeExtraction.h"

namespace meam
{
/// What a user decides about detection, by whichever door they come; all else follows from the preset.
struct DetectionChoices
{
  Preset preset = Preset::Recommended;
  Features features = Features::Both; ///< of a preset that leaves them to the user
  int maximumPoses = 5;               ///< the best ones; 0: all
  double minimumProbability = 0.0;    ///< of each, [0, 1]
  bool partIsPresent = false;         ///< no pose is less likely because the part may be missing
  double referenceShare = 0.0;        ///< P_ref; 0: the preset's
  bool imageEdges = true;             ///< what is looked for in a scan whose edges are not given
  bool depthEdges = true;             ///< of a preset that looks for them
  bool creases = true;                ///< the same
  unsigned seed = 1;
  int threads = 0; ///< 0: one for each processor
};

/// The settings of all steps from the scene's edge points on.
DetectionSettings detectionSettings(const DetectionChoices& choices);

/// Those of the step that finds the edge points in a scan; without the camera of its image.
SceneEdgeExtractionSettings sceneEdgeSettings(const DetectionChoices& choices);

/// Takes the edge points that were found in a scan, and how well it was measured, for the scene's.
void setFoundEdges(const SceneEdges& found, int threads, SceneInput& scene);
}
