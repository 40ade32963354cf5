// SPDX-License-Identifier: BSD-3-Clause
#include "pose/DetectionSteps.h"

#include "base/Error.h"
#include "scene/Units.h"
#include "scene/preparation/SearchRegion.h"

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

namespace
{
SceneEdges findEdges(
  PreparedScan& scan, const DetectSettings& chosen, const std::optional<Camera>& imageCamera, const Progress& progress)
{
  SceneEdgeExtractionSettings settings = sceneEdgeSettings(chosen);
  settings.imageEdges &= !scan.image.pixels.empty();
  if (settings.imageEdges)
  {
    settings.camera = imageCamera;
  }
  else if (!settings.depthEdges && !settings.creases)
  {
    const bool byPreset = chosen.depthEdges || chosen.creases;
    throw Error((chosen.imageEdges ? "The scan has no image: give one, registered or with its camera, or "
                                   : "No edges are looked for: take those of the image, or ") +
                std::string(byPreset ? "the preset that looks for edges of the depth, too (Preset: Recommended)."
                                     : "switch on DepthEdges or Creases."));
  }
  else if (chosen.imageEdges)
  {
    appendSentence(scan.report, "The scan has no image: its edges are those of the cloud alone.");
  }
  SceneEdges found = extractSceneEdges(scan, settings, progress);
  if (found.quality.isCutOut())
  {
    appendSentence(scan.report,
      "Little was measured: if what lies around the parts was cut out, leave it in, for it tells where they end.");
  }
  return found;
}
}

ScanScene sceneOfScan(ScanSource source, const DetectSettings& chosen, const Progress& progress)
{
  ScanScene result;
  SceneInput& scene = result.scene;
  const bool isEverywhere = source.region.isEverywhere();
  if (source.edges)
  {
    scene.edges = std::move(*source.edges);
    scene.sensor = source.sensor.value();
    result.region = isEverywhere ? nullptr : std::make_shared<SearchRegion>(source.region);
  }
  else
  {
    PreparedScan prepared = prepareScan(std::move(source.cloud), std::move(source.image), source.sensor);
    if (!isEverywhere)
    {
      result.region = std::make_shared<SearchRegion>(source.region, prepared);
      result.region->crop(prepared, source.diameter());
    }
    result.found = findEdges(prepared, chosen, source.imageCamera, progress);
    result.report = prepared.report;
    scene.edges = toLocalCloud(result.found.cloud, chosen.threads);
    scene.edges.fromScan = true;
    scene.quality = result.found.quality;
    scene.sensor = prepared.sensor;
    scene.isViewpointGuessed = prepared.isViewpointGuessed;
    if (!prepared.isAsGiven)
    {
      scene.measured = toLocalPoints(prepared.measured(), scene.edges.T_local_scene, chosen.threads);
      return result;
    }
  }
  scene.measured = source.measured(scene.edges);
  if (result.region)
  {
    result.region->crop(scene.edges, scene.measured, source.diameter());
  }
  return result;
}

std::string doubtsOf(const Poses& poses, const SceneInput& scene, double partDiameter)
{
  const std::string doubts = doubtsOf(poses);
  const bool hasEdges = !spansTooLittle(scene.edges.cloud.points, partDiameter);
  if (!hasEdges && scene.measured.empty()) // a time limit struck before it was looked at
  {
    return doubts;
  }
  std::string told = unitsWarning(
    hasEdges ? scene.edges.cloud.points : scene.measured, partDiameter, scene.quality.pointDistance, doubts.empty());
  appendSentence(told, doubts);
  return told;
}
}
