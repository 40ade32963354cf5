// SPDX-License-Identifier: BSD-3-Clause
#include "pose/DetectionChoices.h"

namespace meam
{
DetectionSettings detectionSettings(const DetectionChoices& choices)
{
  DetectionSettings settings =
    detectionSettings(choices.preset, choices.maximumPoses, choices.threads, choices.minimumProbability);
  settings.detection.seed = choices.seed;
  if (takesFeatures(choices.preset))
  {
    settings.detection.features = choices.features;
  }
  if (choices.referenceShare > 0.0)
  {
    settings.detection.referenceShare = choices.referenceShare;
  }
  settings.selection.partIsPresent = choices.partIsPresent;
  return settings;
}

SceneEdgeExtractionSettings sceneEdgeSettings(const DetectionChoices& choices)
{
  SceneEdgeExtractionSettings settings = sceneEdgeSettings(choices.preset);
  settings.imageEdges = choices.imageEdges;
  settings.depthEdges &= choices.depthEdges;
  settings.creases &= choices.creases;
  settings.threads = choices.threads;
  return settings;
}

void setFoundEdges(const SceneEdges& found, int threads, SceneInput& scene)
{
  scene.edges = toLocalCloud(found.cloud, threads);
  scene.edges.fromScan = true;
  scene.quality = found.quality;
}
}
