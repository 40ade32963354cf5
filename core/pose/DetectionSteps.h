// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "pose/DetectSettings.h"
#include "pose/MEAMPoseEstimation.h"
#include "scene/preparation/Region.h"
#include "scene/preparation/ScanPreparation.h"

namespace meam
{
/// The settings of all steps from the scene's edge points on.
DetectionSettings detectionSettings(const DetectSettings& chosen);

/// Those of the step that finds the edge points in a scan; without the camera of its image.
SceneEdgeExtractionSettings sceneEdgeSettings(const DetectSettings& chosen);

/// What a scan brings, in its own coordinates.
struct ScanSource
{
  std::optional<LocalCloud> edges; ///< where they are given; otherwise they are looked for in cloud and image
  OrganizedCloud cloud;
  Image image;                                             ///< may be empty
  std::optional<Camera> imageCamera;                       ///< that took it; none: it is registered with the cloud
  std::optional<Sensor> sensor;                            ///< none where it is not known; given edges need it
  Region region;                                           ///< where parts are looked for
  std::function<Points(const LocalCloud& edges)> measured; ///< called once: in the frame of the edges
  std::function<double()> diameter;                        ///< mm, of the largest part; called for a region
};

/// A scene, and what was made of its scan on the way.
struct ScanScene
{
  SceneInput scene;
  std::shared_ptr<const SearchRegion> region;
  SceneEdges found;   ///< none where they were given
  std::string report; ///< what was assumed
};

/// The scene of a scan; its edge points are those of the cloud alone, which the report says then, where it has no
/// image. Throws Error when edges of the image alone are asked for and there is none.
ScanScene sceneOfScan(ScanSource source, const DetectSettings& chosen, const Progress& progress = {});

/// What may be wrong with the scan's unit or the part's, and that nothing sure was found; empty when all is well.
std::string doubtsOf(const Poses& poses, const SceneInput& scene, double partDiameter);
}
