// SPDX-License-Identifier: BSD-3-Clause
#include "pose/MEAMPoseEstimation.h"

#include <algorithm>
#include <chrono>

namespace meam
{
namespace
{
constexpr int RawPerRefined = 3; // of so many raw candidates one may be refined: a large bin has many instances

/// Seconds since the last call.
class Stopwatch
{
public:
  double lap()
  {
    const auto now = std::chrono::steady_clock::now();
    const double seconds = std::chrono::duration<double>(now - this->Last).count();
    this->Last = now;
    return seconds;
  }

private:
  std::chrono::steady_clock::time_point Last = std::chrono::steady_clock::now();
};
}

DetectionSettings detectionSettings(Preset preset, int maximumPoses, int threads, double minimumProbability)
{
  DetectionSettings settings;
  if (preset == Preset::Paper)
  {
    settings.tangents = paperTangentSettings();
    settings.detection = paperDetectionSettings();
    settings.verification = paperVerificationSettings();
    settings.refinement = paperRefinementSettings();
    settings.selection = paperVerificationSettings();
  }
  settings.selection.posesPerInstance = 1;
  settings.selection.maximumPoses = maximumPoses;
  settings.selection.minimumProbability = minimumProbability;
  settings.tangents.threads = threads;
  settings.detection.threads = threads;
  settings.verification.threads = threads;
  settings.refinement.threads = threads;
  settings.selection.threads = threads;
  return settings;
}

Poses estimatePoses(const TrainedModel& model, const PreciseCloud& edges, FramedPoints surface, const Sensor& sensor,
  const DetectionSettings& settings, StageTimes* times, const Progress& progress)
{
  StageTimes spent;
  Stopwatch watch;
  const EdgeTangents found =
    estimateTangents(edges, model.diameter, sensor.direction, settings.tangents, subProgress(progress, 0.0, 0.1));
  const PreciseCloud withTangents = found.of(edges);
  spent.tangents = watch.lap();
  Poses poses = detectPoses(withTangents, model, settings.detection, subProgress(progress, 0.1, 0.5));
  spent.detection = watch.lap();
  const Scene scene = sceneInOwnFrame(withTangents, std::move(surface), sensor, settings.verification.threads);
  const SceneIndex index(model, scene, settings.verification.threads);
  PoseVerificationSettings verification = settings.verification;
  if (verification.maximumPoses > 0)
  {
    verification.maximumPoses = std::max(verification.maximumPoses, static_cast<int>(poses.size()) / RawPerRefined);
  }
  poses = verifyPoses(poses, index, verification, subProgress(progress, 0.5, 0.7));
  spent.verification = watch.lap();
  poses = refinePoses(poses, index, settings.refinement, subProgress(progress, 0.7, 0.95));
  spent.refinement = watch.lap();
  poses = verifyPoses(poses, index, settings.selection, subProgress(progress, 0.95, 1.0));
  spent.selection = watch.lap();
  if (times)
  {
    *times = spent;
  }
  return poses;
}
}
