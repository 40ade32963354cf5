// SPDX-License-Identifier: BSD-3-Clause
#include "api/Conversion.h"

#include "base/Error.h"
#include "base/Range.h"
#include "meam.h"
#include "model/TrainedModel.h"
#include "pose/DetectionSteps.h"
#include "pose/PartsEstimation.h"
#include "pose/ScanAdvice.h"
#include "scene/preparation/ScanViewpoint.h"

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

/// None when it is not given.
std::optional<Sensor> givenSensor(const Scan& scan)
{
  std::optional<Sensor> sensor = scan.sensor;
  if (sensor)
  {
    if (!sensor->position.allFinite() || !sensor->direction.allFinite())
    {
      throw Error("The scan's sensor (Scan::sensor) has a position or a direction that is not a finite number.");
    }
    sensor->direction = lookingDirection(*sensor, scan.points);
    if (sensor->direction.isZero(0.0))
    {
      throw Error("The sensor's direction is zero: give the way it looks, in the scan's coordinates.");
    }
  }
  return sensor;
}

/// That of a scan whose edge points are given.
Sensor sensorOf(const Scan& scan)
{
  const Sensor fromAbove{ false, Eigen::Vector3d::Zero(), -Eigen::Vector3d::UnitZ() };
  return givenSensor(scan).value_or(scan.height == 1 ? fromAbove : Sensor());
}

ScanSource sourceOf(const Scan& scan, double largestDiameter, const DetectSettings& settings)
{
  ScanSource source;
  if (!scan.edges.empty())
  {
    requirePoints(scan.edges, "The scan's edge cloud");
    PointCloud edges;
    edges.points = scan.edges;
    source.edges = toLocalCloud(edges, settings.threads);
    source.sensor = sensorOf(scan);
  }
  else
  {
    source.cloud = { scan.width, scan.height, scan.points };
    source.image = settings.imageEdges ? scan.image : Image();
    source.imageCamera = scan.imageCamera;
    source.sensor = givenSensor(scan);
  }
  source.region = scan.region;
  source.measured = [&scan, threads = settings.threads](const LocalCloud& edges)
  {
    Points measured = toLocalPoints(scan.points, edges.T_local_scene, threads);
    requirePoints(scan.points.size(), measured.size(), "The scan");
    return measured;
  };
  source.diameter = [=] { return largestDiameter; };
  return source;
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
  const double largest = largestDiameter(trained);
  requireSettings(settings);
  requireGrid(scan);
  const Deadline deadline = settings.timeLimit > 0.0 ? Deadline(settings.timeLimit) : Deadline();
  ScanScene seen;
  const SceneInput& scene = seen.scene;
  std::vector<PartPose> found;
  DetectionReport report;
  const auto search = [&]
  {
    seen = sceneOfScan(
      sourceOf(scan, largest, settings), settings, deadline.within(subProgress(progress, 0.0, AfterSceneEdges)));
    DetectionSettings steps = detectionSettings(settings);
    steps.deadline = deadline;
    steps.region = seen.region;
    found = estimateParts(trained, scene, steps, &report, subProgress(progress, AfterSceneEdges, 1.0));
  };
  Detections result;
  result.isCutShort = !isDoneBy(deadline, search) || report.isCutShort;
  result.quality = scene.quality;
  result.report = untoldLengths(found, seen.report);
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
  result.advice = scanAdvice(scene.quality, report, poses, largest, scene.isViewpointGuessed);
  appendSentence(result.warning, result.isCutShort ? cutShort(settings.timeLimit) : "");
  appendSentence(result.warning, doubtsOf(poses, scene, trained.front()->diameter));
  result.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return result;
}

Detections detect(const Model& model, const Scan& scan, const DetectSettings& settings, const Progress& progress)
{
  return detect(std::vector<Model>{ model }, scan, settings, progress);
}
}
