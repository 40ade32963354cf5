// SPDX-License-Identifier: BSD-3-Clause
#include "pose/MEAMPoseEstimation.h"

#include <algorithm>
#include <chrono>

namespace meam
{
namespace
{
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
  if (preset != Preset::Recommended)
  {
    settings.tangents = paperTangentSettings();
    settings.detection = paperDetectionSettings();
    settings.candidateVerification = paperVerificationSettings();
    settings.candidateSelection.method = SelectionMethod::Clusters;
    settings.refinement = paperRefinementSettings();
    settings.verification = paperVerificationSettings();
    settings.selection.method = SelectionMethod::Clusters;
    if (preset == Preset::B2B)
    {
      settings.tangents.method = TangentMethod::LineSegments;
    }
    if (preset == Preset::OriginalPPF)
    {
      settings.detection = originalDetectionSettings();
      settings.refinement = {}; // by the surface: its points are what poses are found by
    }
    if (preset == Preset::OriginalPPF || preset == Preset::B2B)
    {
      settings.candidateVerification = settings.verification = votesVerificationSettings();
      settings.candidateSelection.maximumPoses = 30; // as many as the paper's from six views
    }
  }
  else
  {
    settings.screening.emplace().threads = threads;
    settings.candidateVerification.pointStride = 2;
    settings.candidateSelection.method = SelectionMethod::Alternatives;
  }
  settings.selection.maximumPoses = maximumPoses;
  settings.selection.minimumProbability = minimumProbability;
  settings.tangents.threads = threads;
  settings.scene.threads = threads;
  settings.detection.threads = threads;
  settings.candidateVerification.threads = threads;
  settings.candidateSelection.threads = threads;
  settings.refinement.threads = threads;
  settings.verification.threads = threads;
  settings.selection.threads = threads;
  return settings;
}

Poses estimatePoses(const TrainedModel& model, const SceneInput& input, const DetectionSettings& settings,
  DetectionReport* report, const Progress& progress)
{
  StageTimes spent;
  EdgeRates rates;
  Stopwatch watch;
  LocalCloud edges = estimateTangents(
    input.edges, model.diameter, input.sensor.direction, settings.tangents, subProgress(progress, 0.0, 0.1))
                       .edges;
  spent.tangents = watch.lap();
  const Scene scene(std::move(edges), input.measured, input.sensor, model.diameter, settings.scene, input.quality);
  spent.scene = watch.lap();
  Poses poses = detectPoses(scene, model, settings.detection, subProgress(progress, 0.1, 0.5));
  spent.detection = watch.lap();
  if (settings.screening)
  {
    poses = screenPoses(poses, scene, model, *settings.screening, subProgress(progress, 0.5, 0.6));
  }
  spent.screening = watch.lap();
  poses = verifyPoses(poses, scene, model, settings.candidateVerification, subProgress(progress, 0.6, 0.7), &rates);
  spent.verification = watch.lap();
  poses = selectPoses(poses, scene, model, settings.candidateSelection, subProgress(progress, 0.7, 0.75));
  spent.selection = watch.lap();
  poses = refinePoses(poses, scene, model, settings.refinement, subProgress(progress, 0.75, 0.9));
  spent.refinement = watch.lap();
  poses = verifyPoses(poses, scene, model, settings.verification, subProgress(progress, 0.9, 0.93));
  spent.verification += watch.lap();
  poses = selectPoses(poses, scene, model, settings.selection, subProgress(progress, 0.93, 1.0));
  poses = toSceneFrame(poses, scene.T_local_scene(), model.symmetries);
  spent.selection += watch.lap();
  if (report)
  {
    report->times = spent;
    report->edgeRates.reset();
    if (settings.candidateVerification.method == VerificationMethod::VisibleEvidence)
    {
      report->edgeRates = rates;
    }
  }
  return poses;
}
}
