// SPDX-License-Identifier: BSD-3-Clause
#include "pose/DetectionSteps.h"

namespace meam
{
DetectionSettings detectionSettings(const DetectSettings& chosen)
{
  DetectionSettings settings =
    detectionSettings(chosen.preset, chosen.maximumPoses, chosen.threads, chosen.minimumProbability);
  settings.detection.seed = chosen.seed;
  if (takesFeatures(chosen.preset))
  {
    settings.detection.features = chosen.features;
  }
  if (chosen.referenceShare > 0.0)
  {
    settings.detection.referenceShare = chosen.referenceShare;
  }
  settings.selection.rotationCounts = chosen.rotationCounts;
  settings.selection.partIsPresent = chosen.partIsPresent;
  return settings;
}

SceneEdgeExtractionSettings sceneEdgeSettings(const DetectSettings& chosen)
{
  SceneEdgeExtractionSettings settings = sceneEdgeSettings(chosen.preset);
  settings.imageEdges = chosen.imageEdges;
  settings.depthEdges &= chosen.depthEdges;
  settings.creases &= chosen.creases;
  settings.threads = chosen.threads;
  return settings;
}

void setFoundEdges(const SceneEdges& found, int threads, SceneInput& scene)
{
  scene.edges = toLocalCloud(found.cloud, threads);
  scene.edges.fromScan = true;
  scene.quality = found.quality;
}
}
