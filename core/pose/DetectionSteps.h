// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "pose/DetectSettings.h"
#include "pose/MEAMPoseEstimation.h"
#include "scene/edges/SceneEdgeExtraction.h"

namespace meam
{
/// The settings of all steps from the scene's edge points on.
DetectionSettings detectionSettings(const DetectSettings& chosen);

/// Those of the step that finds the edge points in a scan; without the camera of its image.
SceneEdgeExtractionSettings sceneEdgeSettings(const DetectSettings& chosen);

/// Takes the edge points that were found in a scan, and how well it was measured, for the scene's.
void setFoundEdges(const SceneEdges& found, int threads, SceneInput& scene);
}
