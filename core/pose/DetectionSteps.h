// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "pose/DetectSettings.h"
#include "pose/MEAMPoseEstimation.h"
#include "scene/preparation/ScanPreparation.h"

namespace meam
{
/// The settings of all steps from the scene's edge points on.
DetectionSettings detectionSettings(const DetectSettings& chosen);

/// Those of the step that finds the edge points in a scan; without the camera of its image.
SceneEdgeExtractionSettings sceneEdgeSettings(const DetectSettings& chosen);

/// The edge points of a scan: those of the cloud alone, which its report says then, where it has no image.
/// `imageCamera` took the image; none: it is registered with the scan. Throws Error when edges of the image alone are
/// asked for and there is none.
SceneEdges findEdges(PreparedScan& scan, const DetectSettings& chosen, const std::optional<Camera>& imageCamera,
  const Progress& progress = {});

/// Takes the edge points that were found in a scan, and how well it was measured, for the scene's.
void setFoundEdges(const SceneEdges& found, int threads, SceneInput& scene);

/// What may be wrong with the scan's unit or the part's, and that nothing sure was found; empty when all is well.
std::string doubtsOf(const Poses& poses, const SceneInput& scene, double partDiameter);
}
