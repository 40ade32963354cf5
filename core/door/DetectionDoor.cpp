// SPDX-License-Identifier: BSD-3-Clause
#include "door/DoorConversion.h"
#include "meam.h"
#include "model/TrainedModel.h"
#include "pose/MEAMPoseEstimation.h"
#include "scene/Units.h"
#include "scene/edges/SceneEdgeExtraction.h"

#include <chrono>

namespace meam
{
namespace
{
constexpr double AfterSceneEdges = 0.2; // share of the work, for the progress

void requireScan(const Scan& scan)
{
  requireGrid(scan);
  if (scan.height == 1 && scan.edges.empty())
  {
    throw Error(
      "The scan is not organized, so that its edges cannot be taken from an image: give its edge points, or an "
      "organized scan (a grid of width x height points).");
  }
}

Sensor sensorOf(const Scan& scan)
{
  Sensor sensor;
  if (scan.sensor)
  {
    sensor = *scan.sensor;
    if (!sensor.direction.allFinite() || !(sensor.direction.norm() > 0.0))
    {
      throw Error("The sensor's direction is zero: give the way it looks, in the scan's coordinates.");
    }
    sensor.direction.normalize();
  }
  else if (scan.height == 1)
  {
    sensor.perspective = false;
    sensor.direction = -Eigen::Vector3d::UnitZ();
  }
  return sensor;
}

/// The scan's edge points as extracted, with what the scan shows of the sensor, or as given, in their local frame.
LocalCloud edgesOf(const Scan& scan, const DetectSettings& settings, ScanQuality& quality, const Progress& progress)
{
  if (!scan.edges.empty())
  {
    requirePoints(scan.edges, "The scan's edge cloud");
    PointCloud edges;
    edges.points = scan.edges;
    return toLocalCloud(edges, settings.threads);
  }
  SceneEdgeExtractionSettings extraction = sceneEdgeSettings(settings.preset);
  extraction.imageEdges = settings.imageEdges;
  extraction.depthEdges &= settings.depthEdges;
  extraction.creases &= settings.creases;
  extraction.camera = scan.imageCamera;
  extraction.threads = settings.threads;
  if (settings.imageEdges && scan.image.pixels.empty())
  {
    throw Error("The scan has no image: give one, registered or with its camera, or turn imageEdges off to "
                "look for depthEdges and creases alone.");
  }
  const SceneEdges found =
    extractSceneEdges({ scan.width, scan.height, scan.points }, scan.image, extraction, progress);
  quality = found.quality;
  LocalCloud edges = toLocalCloud(found.cloud, settings.threads);
  edges.fromScan = true;
  return edges;
}
}

Detections detect(const Model& model, const Scan& scan, const DetectSettings& settings, const Progress& progress)
{
  const auto start = std::chrono::steady_clock::now();
  const TrainedModel& trained = model.trained();
  requireScan(scan);
  SceneInput input;
  input.sensor = sensorOf(scan);
  input.edges = edgesOf(scan, settings, input.quality, subProgress(progress, 0.0, AfterSceneEdges));
  input.measured = toLocalPoints(scan.points, input.edges.T_local_scene, settings.threads);
  requirePoints(scan.points.size(), input.measured.size(), "The scan");

  DetectionSettings steps =
    detectionSettings(settings.preset, settings.maximumPoses, settings.threads, settings.minimumProbability);
  steps.detection.seed = settings.seed;
  if (takesFeatures(settings.preset))
  {
    steps.detection.features = settings.features;
  }
  if (settings.referenceShare > 0.0)
  {
    steps.detection.referenceShare = settings.referenceShare;
  }

  if (settings.partIsPresent)
  {
    assumePresence(steps);
  }

  Detections result;
  result.quality = input.quality;
  const Progress ofPoses = subProgress(progress, AfterSceneEdges, 1.0);
  const Poses poses = estimatePoses(trained, input, steps, nullptr, ofPoses);
  for (const Pose& pose : poses)
  {
    result.poses.push_back(
      { pose.T_scene_model, pose.score, pose.probability, pose.certainty, pose.visibleFraction, pose.fit.residual });
  }
  const std::string ofUnits = unitsWarning(input.edges.cloud.points, trained.diameter), doubts = doubtsOf(poses);
  result.warning = ofUnits + (ofUnits.empty() || doubts.empty() ? "" : " ") + doubts;
  result.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return result;
}
}
