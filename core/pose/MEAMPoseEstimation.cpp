// SPDX-License-Identifier: BSD-3-Clause
#include "pose/MEAMPoseEstimation.h"

#include "baselines/BaselineSettings.h"
#include "pose/PoseSearch.h"
#include "pose/Stopwatch.h"
#include "scene/Units.h"

namespace meam
{
namespace
{
constexpr double Searches = 0.9; // of the progress: up to refined poses

PoseSelectionSettings selectionOf(const DetectionSettings& settings)
{
  PoseSelectionSettings selection = settings.selection;
  selection.deadline = settings.deadline;
  return selection;
}
}

StageTimes& StageTimes::operator+=(const StageTimes& other)
{
  for (double StageTimes::*stage : { &StageTimes::tangents, &StageTimes::scene, &StageTimes::detection,
         &StageTimes::screening, &StageTimes::verification, &StageTimes::refinement, &StageTimes::selection })
  {
    this->*stage += other.*stage;
  }
  return *this;
}

WorkCounts& WorkCounts::operator+=(const WorkCounts& other)
{
  this->references += other.references;
  this->screened += other.screened;
  this->verified += other.verified;
  this->refined += other.refined;
  this->selected += other.selected;
  return *this;
}

DetectionSettings detectionSettings(Preset preset, int maximumPoses, int threads, double minimumProbability)
{
  DetectionSettings settings;
  if (preset == Preset::Recommended)
  {
    settings.screening.emplace().threads = threads;
    settings.candidateVerification = candidateVerificationSettings();
    settings.candidateSelection = candidateSelectionSettings();
  }
  else
  {
    settings = baselineSettings(preset);
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

Poses rankCandidates(Poses candidates, const Scene& scene, const TrainedModel& model, const DetectionSettings& settings,
  DetectionReport* report, const Progress& progress, const PoseObserver& observer)
{
  DetectionReport unused;
  PoseSearch search(scene, model, settings, report ? *report : unused, observer);
  search.rank(std::move(candidates), 0, subProgress(progress, 0.0, Searches));
  return search.selectWanted(selectionOf(settings), subProgress(progress, Searches, 1.0));
}

Poses findPoses(const Scene& scene, const TrainedModel& model, const DetectionSettings& settings,
  DetectionReport* report, const Progress& progress, const PoseObserver& observer)
{
  DetectionReport unused;
  DetectionReport& told = report ? *report : unused;
  PoseSearch search(scene, model, settings, told, observer);
  searchByShares(settings, subProgress(progress, 0.0, Searches),
    [&](double share, int wanted, const Deadline& ofVotes, const Progress& ofShare)
    {
      told.isCutShort = !isDoneBy(ofVotes, [&] { search.upTo(share, wanted, ofVotes.within(ofShare)); });
      return told.isCutShort || (wanted > 0 && search.sure() >= wanted);
    });
  const Poses poses = search.selectWanted(selectionOf(settings), subProgress(progress, Searches, 1.0));
  told.isCutShort = told.isCutShort || settings.deadline.hasStruck();
  told.maximumPoses = settings.selection.maximumPoses;
  return poses;
}

bool showsNothing(const SceneInput& input, double partDiameter)
{
  if (!input.edges.fromScan)
  {
    return false;
  }
  requireSameUnits(input.measured, partDiameter);
  return spansTooLittle(input.edges.cloud.points, partDiameter);
}

Poses estimatePoses(const TrainedModel& model, const SceneInput& input, const DetectionSettings& settings,
  DetectionReport* report, const Progress& progress)
{
  DetectionReport unused;
  DetectionReport& told = report ? *report : unused;
  StageTimes& spent = told.times;
  Stopwatch watch;
  if (showsNothing(input, model.diameter))
  {
    return {};
  }
  const Scene scene = sceneOf(model, input, settings, &spent, subProgress(progress, 0.0, 0.1));
  spent.scene = watch.lap() - spent.tangents;
  const Poses poses = findPoses(scene, model, settings, &told, subProgress(progress, 0.1, 1.0));
  watch.lap();
  Poses ranked = toSceneFrame(poses, scene.T_local_scene(), model.symmetries);
  spent.selection += watch.lap();
  return ranked;
}
}
