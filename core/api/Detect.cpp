// SPDX-License-Identifier: BSD-3-Clause
#include "api/Conversion.h"
#include "base/Range.h"
#include "meam.h"
#include "model/TrainedModel.h"
#include "pose/DetectionSteps.h"
#include "scene/Units.h"

#include <chrono>

namespace meam
{
namespace
{
constexpr double AfterSceneEdges = 0.2; // share of the work, for the progress

void requireSettings(const DetectSettings& settings)
{
  requireWithin("number of poses (maximumPoses)", settings.maximumPoses, 0.0, Unbounded);
  requireWithin("probability of each pose (minimumProbability)", settings.minimumProbability, 0.0, 1.0);
  requireWithin("share of the reference points (referenceShare)", settings.referenceShare, 0.0, 1.0);
}

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

/// Sets the scan's edge points as given, or as extracted, with what the scan shows of the sensor.
void setEdges(const Scan& scan, const DetectSettings& settings, SceneInput& input, const Progress& progress)
{
  if (!scan.edges.empty())
  {
    requirePoints(scan.edges, "The scan's edge cloud");
    PointCloud edges;
    edges.points = scan.edges;
    input.edges = toLocalCloud(edges, settings.threads);
    return;
  }
  SceneEdgeExtractionSettings extraction = sceneEdgeSettings(settings);
  extraction.camera = scan.imageCamera;
  if (extraction.imageEdges && scan.image.pixels.empty())
  {
    throw Error("The scan has no image: give one, registered or with its camera, or turn imageEdges off to "
                "look for depthEdges and creases alone.");
  }
  setFoundEdges(extractSceneEdges({ scan.width, scan.height, scan.points }, scan.image, extraction, progress),
    settings.threads, input);
}
}

Detections detect(const Model& model, const Scan& scan, const DetectSettings& settings, const Progress& progress)
{
  const auto start = std::chrono::steady_clock::now();
  const TrainedModel& trained = model.trained();
  requireSettings(settings);
  requireScan(scan);
  SceneInput input;
  input.sensor = sensorOf(scan);
  setEdges(scan, settings, input, subProgress(progress, 0.0, AfterSceneEdges));
  input.measured = toLocalPoints(scan.points, input.edges.T_local_scene, settings.threads);
  requirePoints(scan.points.size(), input.measured.size(), "The scan");

  Detections result;
  result.quality = input.quality;
  const Progress ofPoses = subProgress(progress, AfterSceneEdges, 1.0);
  const Poses poses = estimatePoses(trained, input, detectionSettings(settings), nullptr, ofPoses);
  for (const Pose& pose : poses)
  {
    result.poses.push_back({ pose.T_scene_model, pose.score, pose.placeProbability, pose.probability, pose.certainty,
      pose.visibleFraction, pose.fit.residual, pose.votes, pose.viewId, pose.fit.covariance, {} });
    for (const RotationAlternative& other : pose.alternatives)
    {
      result.poses.back().alternatives.push_back({ other.T_scene_model, other.share });
    }
  }
  const std::string ofUnits = unitsWarning(input.edges.cloud.points, trained.diameter), doubts = doubtsOf(poses);
  result.warning = ofUnits + (ofUnits.empty() || doubts.empty() ? "" : " ") + doubts;
  result.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return result;
}
}
