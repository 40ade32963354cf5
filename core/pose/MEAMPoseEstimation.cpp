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
    settings.candidateSelection = settings.selection = paperSelectionSettings();
    settings.refinement = paperRefinementSettings();
    settings.verification = paperVerificationSettings();
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
      settings.candidateSelection = votesSelectionSettings();
    }
  }
  else
  {
    settings.screening.emplace().threads = threads;
    settings.candidateVerification = candidateVerificationSettings();
    settings.candidateSelection = candidateSelectionSettings();
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

Scene sceneOf(const TrainedModel& model, const SceneInput& input, const DetectionSettings& settings, StageTimes* times,
  const Progress& progress)
{
  Stopwatch watch;
  LocalCloud edges =
    estimateTangents(input.edges, model.diameter, input.sensor.direction, settings.tangents, progress).edges;
  if (times)
  {
    times->tangents = watch.lap();
  }
  return Scene(std::move(edges), input.measured, input.sensor, model.diameter, settings.scene, input.quality);
}

Poses rankCandidates(Poses poses, const Scene& scene, const TrainedModel& model, const DetectionSettings& settings,
  DetectionReport* report, const Progress& progress, const PoseObserver& observer)
{
  DetectionReport unused;
  DetectionReport& told = report ? *report : unused;
  StageTimes& spent = told.times;
  EvidenceRates rates;
  Stopwatch watch;
  const auto observe = [&](PoseStage stage)
  {
    if (observer)
    {
      observer(stage, poses);
    }
  };
  if (settings.screening)
  {
    poses = screenPoses(poses, scene, model, *settings.screening, subProgress(progress, 0.0, 0.2));
    observe(PoseStage::Screening);
  }
  spent.screening = watch.lap();
  poses = verifyPoses(poses, scene, model, settings.candidateVerification, subProgress(progress, 0.2, 0.4), &rates);
  told.rates =
    settings.candidateVerification.method == VerificationMethod::VisibleEvidence ? std::optional(rates) : std::nullopt;
  observe(PoseStage::CandidateVerification);
  spent.verification = watch.lap();
  poses = selectPoses(poses, scene, model, settings.candidateSelection, subProgress(progress, 0.4, 0.5));
  observe(PoseStage::CandidateSelection);
  spent.selection = watch.lap();
  poses = refinePoses(poses, scene, model, settings.refinement, subProgress(progress, 0.5, 0.8));
  observe(PoseStage::Refinement);
  spent.refinement = watch.lap();
  PoseVerificationSettings verification = settings.verification;
  PoseSelectionSettings selection = settings.selection;
  verification.evidence.rates = selection.evidence.rates = told.rates; // of all candidates; few are left
  poses = verifyPoses(poses, scene, model, verification, subProgress(progress, 0.8, 0.86));
  observe(PoseStage::Verification);
  spent.verification += watch.lap();
  poses = selectPoses(poses, scene, model, selection, subProgress(progress, 0.86, 1.0));
  observe(PoseStage::Selection);
  spent.selection += watch.lap();
  return poses;
}

Poses findPoses(const Scene& scene, const TrainedModel& model, const DetectionSettings& settings,
  DetectionReport* report, const Progress& progress, const PoseObserver& observer)
{
  constexpr double votingShare = 0.45; // of the progress
  Stopwatch watch;
  Poses candidates = detectPoses(scene, model, settings.detection, subProgress(progress, 0.0, votingShare));
  if (report)
  {
    report->times.detection = watch.lap();
  }
  if (observer)
  {
    observer(PoseStage::Voting, candidates);
  }
  return rankCandidates(
    std::move(candidates), scene, model, settings, report, subProgress(progress, votingShare, 1.0), observer);
}

Poses estimatePoses(const TrainedModel& model, const SceneInput& input, const DetectionSettings& settings,
  DetectionReport* report, const Progress& progress)
{
  DetectionReport unused;
  DetectionReport& told = report ? *report : unused;
  StageTimes& spent = told.times;
  Stopwatch watch;
  const Scene scene = sceneOf(model, input, settings, &spent, subProgress(progress, 0.0, 0.1));
  spent.scene = watch.lap() - spent.tangents;
  const Poses poses = findPoses(scene, model, settings, &told, subProgress(progress, 0.1, 1.0));
  watch.lap();
  Poses ranked = toSceneFrame(poses, scene.T_local_scene(), model.symmetries);
  spent.selection += watch.lap();
  return ranked;
}
}
