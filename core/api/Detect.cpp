// SPDX-License-Identifier: BSD-3-Clause
#include "api/Conversion.h"
#include "base/Range.h"
#include "meam.h"
#include "model/TrainedModel.h"
#include "pose/DetectionSteps.h"
#include "pose/PartsEstimation.h"
#include "scene/Units.h"

#include <algorithm>
#include <chrono>
#include <iterator>

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
  requireWithin("time limit (timeLimit)", settings.timeLimit, 0.0, Unbounded, " s");
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

Detections detect(
  const std::vector<Model>& models, const Scan& scan, const DetectSettings& settings, const Progress& progress)
{
  const auto start = std::chrono::steady_clock::now();
  if (models.empty())
  {
    throw Error("There is no part to look for: give one model or more.");
  }
  std::vector<const TrainedModel*> trained;
  std::transform(
    models.begin(), models.end(), std::back_inserter(trained), [](const Model& model) { return &model.trained(); });
  requireSettings(settings);
  requireScan(scan);
  SceneInput input;
  input.sensor = sensorOf(scan);
  const Deadline deadline = settings.timeLimit > 0.0 ? Deadline(settings.timeLimit) : Deadline();
  std::vector<PartPose> found;
  DetectionReport report;
  const auto search = [&]
  {
    setEdges(scan, settings, input, deadline.within(subProgress(progress, 0.0, AfterSceneEdges)));
    input.measured = toLocalPoints(scan.points, input.edges.T_local_scene, settings.threads);
    requirePoints(scan.points.size(), input.measured.size(), "The scan");
    DetectionSettings steps = detectionSettings(settings);
    steps.deadline = deadline;
    found = estimateParts(trained, input, steps, &report, subProgress(progress, AfterSceneEdges, 1.0));
  };
  Detections result;
  result.isCutShort = !isDoneBy(deadline, search) || report.isCutShort;
  result.quality = input.quality;
  Poses poses;
  for (const auto& [part, index, pose] : found)
  {
    result.poses.push_back({ pose.T_scene_model, pose.score, pose.placeProbability, pose.probability, pose.certainty,
      pose.visibleFraction, pose.fit.residual, pose.votes, pose.viewId, pose.fit.covariance, {}, part });
    for (const RotationAlternative& other : pose.alternatives)
    {
      result.poses.back().alternatives.push_back({ other.T_scene_model, other.share });
    }
    poses.push_back(pose);
  }
  const std::string ofTime = result.isCutShort ? cutShort(settings.timeLimit) : "";
  for (const std::string& sentence :
    { unitsWarning(input.edges.cloud.points, trained.front()->diameter), ofTime, doubtsOf(poses) })
  {
    result.warning += (result.warning.empty() || sentence.empty() ? "" : " ") + sentence;
  }
  result.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return result;
}

Detections detect(const Model& model, const Scan& scan, const DetectSettings& settings, const Progress& progress)
{
  return detect(std::vector<Model>{ model }, scan, settings, progress);
}
}
