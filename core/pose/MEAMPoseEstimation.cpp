// SPDX-License-Identifier: BSD-3-Clause
#include "pose/MEAMPoseEstimation.h"

#include "baselines/BaselineSettings.h"
#include "pose/PoseTolerances.h"
#include "pose/Stopwatch.h"
#include "scene/Units.h"
#include "scene/preparation/SearchRegion.h"

#include <algorithm>
#include <map>

namespace meam
{
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

namespace
{
// A few poses are asked for of a bin full of parts: some of the reference points find enough that are sure. Of all of
// them so many vote first, others only where these do not do; what was found out of candidates stays known.
constexpr double Shares[] = { 0.06, 0.2, 1.0 };
constexpr std::size_t RefinedOfCopy =
  6;                               // for each copy that is wanted so many candidates are refined first, best first,
constexpr std::size_t Growth = 2;  // and then so many times as many, until enough copies are sure
constexpr double VotingTime = 0.6; // of what is left of a time limit: up to refined poses; the rest finishes them

/// The stages from raw candidates to ranked poses, of which a search may go through all but the last several times,
/// each time with more candidates.
class Ranking
{
public:
  Ranking(const Scene& scene, const TrainedModel& model, const DetectionSettings& settings, DetectionReport& told,
    const PoseObserver& observer)
    : InScene(scene)
    , Model(model)
    , Settings(settings)
    , Told(told)
    , Observer(observer)
  {
  }

  /// Takes candidates as far as refined poses with their scores, in place of those before; where a number of copies is
  /// wanted (0: all), no more than it takes. Returns whether so many are as good as found.
  bool rank(Poses poses, int wanted, const Progress& progress)
  {
    StageTimes& spent = this->Told.times;
    WorkCounts& work = this->Told.work;
    const Scene& scene = this->InScene;
    const TrainedModel& model = this->Model;
    const DetectionSettings& settings = this->Settings;
    Stopwatch watch;
    this->returned(PoseStage::Voting, poses);
    work.screened += static_cast<int>(poses.size());
    if (settings.screening)
    {
      poses = screenPoses(poses, scene, model, *settings.screening, subProgress(progress, 0.0, 0.2));
      this->returned(PoseStage::Screening, poses);
    }
    spent.screening += watch.lap();
    EvidenceRates rates;
    const std::size_t knownBefore = this->Candidates.size();
    const std::size_t count = poses.size();
    poses = verifyPoses(
      poses, scene, model, settings.candidateVerification, subProgress(progress, 0.2, 0.4), &rates, &this->Candidates);
    const bool haveRates = settings.candidateVerification.method == VerificationMethod::VisibleEvidence;
    work.verified += static_cast<int>(haveRates ? this->Candidates.size() - knownBefore : count);
    const std::optional<EvidenceRates> ofScan = haveRates ? std::optional(rates) : std::nullopt;
    this->returned(PoseStage::CandidateVerification, poses);
    spent.verification += watch.lap();
    poses = selectPoses(poses, scene, model, settings.candidateSelection, subProgress(progress, 0.4, 0.5));
    this->returned(PoseStage::CandidateSelection, poses);
    spent.selection += watch.lap();
    PoseVerificationSettings verification = settings.verification;
    verification.evidence.rates = ofScan; // of all candidates; few are left
    this->Told.rates = ofScan;
    bool haveWanted = false;
    std::size_t most = wanted > 0 ? RefinedOfCopy * wanted : poses.size();
    for (double from = 0.0; from < 1.0 && !haveWanted; most *= Growth)
    {
      const bool isLast = most >= poses.size();
      const Poses best(poses.begin(), isLast ? poses.end() : poses.begin() + static_cast<std::ptrdiff_t>(most));
      const double to = isLast ? 1.0 : static_cast<double>(most) / static_cast<double>(poses.size());
      const Progress ofLot = subProgress(progress, 0.5 + 0.5 * from, 0.5 + 0.5 * to);
      const Poses refined = this->Refined.of(best,
        [&](const Poses& unknown)
        {
          work.refined += static_cast<int>(unknown.size());
          return refinePoses(unknown, scene, model, settings.refinement, subProgress(ofLot, 0.0, 0.8));
        });
      this->returned(PoseStage::Refinement, refined);
      spent.refinement += watch.lap();
      this->Verified =
        verifyPoses(refined, scene, model, verification, subProgress(ofLot, 0.8, 1.0), nullptr, &this->OfRefined);
      from = to;
      spent.verification += watch.lap();
      haveWanted = wanted > 0 && this->sure() >= wanted;
    }
    return haveWanted;
  }

  /// One pose of each instance.
  Poses select(const Progress& progress)
  {
    this->returned(PoseStage::Verification, this->Verified);
    PoseSelectionSettings selection = this->Settings.selection;
    selection.evidence.rates = this->Told.rates;
    selection.deadline = this->Settings.deadline;
    Stopwatch watch;
    this->Told.work.selected += static_cast<int>(this->Verified.size());
    const Poses poses = selectPoses(this->Verified, this->InScene, this->Model, selection, progress);
    this->returned(PoseStage::Selection, poses);
    this->Told.times.selection += watch.lap();
    if (this->Observer)
    {
      for (const auto& [stage, all] : this->Returned)
      {
        this->Observer(stage, all);
      }
    }
    return poses;
  }

private:
  /// How many copies are as good as found.
  int sure() const
  {
    const Eigen::Vector3d middle = this->Model.visibility->middle().cast<double>();
    const double apart = SamePoseDistance * this->Model.diameter;
    std::vector<const Pose*> sure;
    for (const Pose& pose : this->Verified)
    {
      const auto isOf = [&](const Pose* other)
      { return translationError(pose.T_scene_model, other->T_scene_model, middle) < apart; };
      if (pose.evidence >= SureLogOdds && std::none_of(sure.begin(), sure.end(), isOf))
      {
        sure.push_back(&pose);
      }
    }
    return static_cast<int>(sure.size());
  }

  void returned(PoseStage stage, const Poses& poses)
  {
    if (this->Observer)
    {
      this->Returned[stage] = poses;
    }
  }

  const Scene& InScene;
  const TrainedModel& Model;
  const DetectionSettings& Settings;
  DetectionReport& Told;
  const PoseObserver& Observer;
  EvidenceMemory Candidates; ///< of those that lots before had, too
  PoseMemory<Pose> Refined;  ///< by what they were before
  EvidenceMemory OfRefined;
  Poses Verified;
  std::map<PoseStage, Poses> Returned; ///< in the order of the stages
};
}

Poses rankCandidates(Poses poses, const Scene& scene, const TrainedModel& model, const DetectionSettings& settings,
  DetectionReport* report, const Progress& progress, const PoseObserver& observer)
{
  DetectionReport unused;
  Ranking ranking(scene, model, settings, report ? *report : unused, observer);
  ranking.rank(std::move(poses), 0, subProgress(progress, 0.0, 0.86));
  return ranking.select(subProgress(progress, 0.86, 1.0));
}

Poses findPoses(const Scene& scene, const TrainedModel& model, const DetectionSettings& settings,
  DetectionReport* report, const Progress& progress, const PoseObserver& observer)
{
  DetectionReport unused;
  DetectionReport& told = report ? *report : unused;
  Stopwatch watch;
  CandidateSearch search(scene, model, settings.detection);
  told.times.detection += watch.lap();
  Ranking ranking(scene, model, settings, told, observer);
  // The order by votes, or by what fits of edges, does not tell what is sure.
  const int asked = settings.screening ? settings.selection.maximumPoses : 0;
  const int wanted = asked > 0 ? asked + SpareCopies : 0;
  const Eigen::Isometry3d T_scene_local = scene.T_local_scene().inverse();
  const Eigen::Vector3d middle = model.visibility->middle().cast<double>();
  const auto isOutside = [&](const Pose& pose)
  { return settings.region && !settings.region->contains(T_scene_local * pose.T_scene_model * middle); };
  const auto vote = [&](double share, const Progress& ofLot)
  {
    watch.lap();
    Poses candidates = search.upTo(share, subProgress(ofLot, 0.0, 0.5));
    candidates.erase(std::remove_if(candidates.begin(), candidates.end(), isOutside), candidates.end());
    told.times.detection += watch.lap();
    return ranking.rank(std::move(candidates), wanted, subProgress(ofLot, 0.5, 1.0));
  };
  constexpr double most = 0.9; // of the progress
  const Deadline ofVotes = settings.deadline.after(VotingTime);
  double from = 0.0;
  for (const double to : Shares)
  {
    if (to < 1.0 && asked == 0 && !settings.deadline.isSet())
    {
      continue;
    }
    const Progress ofLot = ofVotes.within(subProgress(progress, most * from, most * to));
    bool haveWanted = false;
    told.isCutShort = !isDoneBy(ofVotes, [&] { haveWanted = vote(to, ofLot); });
    if (told.isCutShort || haveWanted)
    {
      break;
    }
    from = to;
  }
  told.work.references += search.references();
  const Poses poses = ranking.select(subProgress(progress, most, 1.0));
  told.isCutShort = told.isCutShort || settings.deadline.hasStruck();
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
