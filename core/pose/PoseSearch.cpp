// SPDX-License-Identifier: BSD-3-Clause
#include "pose/PoseSearch.h"

#include "base/sequences/Sequences.h"
#include "pose/PoseTolerances.h"
#include "pose/Stopwatch.h"
#include "scene/preparation/SearchRegion.h"

#include <algorithm>

namespace meam
{
namespace
{
constexpr std::size_t RefinedOfCopy =
  6;                              // for each copy that is wanted so many candidates are refined first, best first,
constexpr std::size_t Growth = 2; // and then so many times as many, until enough copies are sure
constexpr std::size_t Lot = 80;   // where all are wanted so many at a time, until a lot finds no further place,
constexpr double Hopeful = -5.0;  // which is one by a refined pose with so much log odds: it may come to be right
constexpr double Competes = 0.5;  // of the diameter: a copy whose middle is so far outside of a region reaches into it
// Where few poses are asked for, of a bin full of parts, some of the reference points find enough that are sure: of all
// of them so many vote first, others only where these do not do.
constexpr double SharesOfReferences[] = { 0.06, 0.2, 1.0 };
constexpr double VotingTime = 0.6; // of a time limit: up to refined poses; the rest finishes them
}

void searchByShares(const DetectionSettings& settings, const Progress& progress,
  const std::function<bool(double share, int wanted, const Deadline& ofVotes, const Progress& progress)>& search)
{
  // The order by votes, or by what fits of edges, does not tell what is sure.
  const int asked = settings.screening ? settings.selection.maximumPoses : 0;
  const int wanted = asked > 0 ? asked + SpareCopies : 0;
  const Deadline ofVotes = settings.deadline.after(VotingTime);
  double from = 0.0;
  for (const double share : SharesOfReferences)
  {
    const bool isSkipped = share < 1.0 && wanted == 0 && !settings.deadline.isSet();
    if (!isSkipped && search(share, wanted, ofVotes, subProgress(progress, from, share)))
    {
      return;
    }
    from = isSkipped ? from : share;
  }
}

PoseSearch::PoseSearch(const Scene& scene, const TrainedModel& model, const DetectionSettings& settings,
  DetectionReport& told, const PoseObserver& observer)
  : InScene(scene)
  , Model(model)
  , Settings(settings)
  , Told(told)
  , Observer(observer)
{
}

void PoseSearch::upTo(double share, int wanted, const Progress& progress)
{
  Stopwatch watch;
  int votersBefore = 0;
  if (this->Search)
  {
    votersBefore = this->Search->references();
  }
  else
  {
    this->Search.emplace(this->InScene, this->Model, this->Settings.detection);
  }
  Poses candidates = this->Search->upTo(share, subProgress(progress, 0.0, 0.5));
  this->Told.work.references += this->Search->references() - votersBefore;
  if (const auto& region = this->Settings.region)
  {
    const double reach = Competes * this->Model.diameter;
    eraseIf(candidates, [&](const Pose& pose) { return !region->isNear(this->middleInScan(pose), reach); });
  }
  this->Told.times.detection += watch.lap();
  this->rank(std::move(candidates), wanted, subProgress(progress, 0.5, 1.0));
}

void PoseSearch::rank(Poses poses, int wanted, const Progress& progress)
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
  const bool haveEvidence = settings.candidateVerification.method == VerificationMethod::VisibleEvidence;
  work.verified += static_cast<int>(haveEvidence ? this->Candidates.size() - knownBefore : count);
  const std::optional<EvidenceRates> ofScan = haveEvidence ? std::optional(rates) : std::nullopt;
  this->returned(PoseStage::CandidateVerification, poses);
  spent.verification += watch.lap();
  poses = selectPoses(poses, scene, model, settings.candidateSelection, subProgress(progress, 0.4, 0.5));
  this->returned(PoseStage::CandidateSelection, poses);
  spent.selection += watch.lap();
  PoseVerificationSettings verification = settings.verification;
  verification.evidence.rates = ofScan; // of all candidates; few are left
  this->Rates = ofScan;
  this->Told.rates = ofScan;
  bool isEnough = false;
  int places = 0;
  // No fewer than before: at a time limit nothing is lost that was found.
  std::size_t most = wanted > 0     ? RefinedOfCopy * wanted
                     : haveEvidence ? std::max(Lot, this->Verified.size())
                                    : poses.size();
  for (double from = 0.0; from < 1.0 && !isEnough; most = wanted > 0 ? most * Growth : most + Lot)
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
    const int placesBefore = places;
    places = this->places(Hopeful);
    isEnough = wanted > 0 ? this->sure() >= wanted : places == placesBefore;
  }
}

int PoseSearch::sure() const { return this->places(SureLogOdds); }

int PoseSearch::places(double leastLogOdds) const
{
  const Eigen::Vector3d middle = this->Model.visibility->middle().cast<double>();
  const double apart = SamePoseDistance * this->Model.diameter;
  std::vector<const Pose*> found;
  for (const Pose& pose : this->Verified)
  {
    const auto isOf = [&](const Pose* other)
    { return translationError(pose.T_scene_model, other->T_scene_model, middle) < apart; };
    if (pose.evidence >= leastLogOdds && this->isWanted(pose) && std::none_of(found.begin(), found.end(), isOf))
    {
      found.push_back(&pose);
    }
  }
  return static_cast<int>(found.size());
}

Poses PoseSearch::finish(PoseSelectionSettings selection, const Progress& progress)
{
  this->returned(PoseStage::Verification, this->Verified);
  selection.evidence.rates = this->Rates;
  if (this->Settings.region)
  {
    selection.isWanted = [this](const Pose& pose) { return this->isWanted(pose); };
  }
  Stopwatch watch;
  this->Told.work.selected += static_cast<int>(this->Verified.size());
  this->Selection = selection;
  this->Instances.reset();
  Poses telling;
  if (selection.method == SelectionMethod::Instances)
  {
    this->Instances.emplace(this->Verified, this->InScene, this->Model, selection, progress);
    telling = this->Instances->telling();
  }
  this->Told.times.selection += watch.lap();
  return telling;
}

Poses PoseSearch::ranked(const std::vector<bool>& onOthers)
{
  Stopwatch watch;
  const Poses poses = this->Instances ? withinLimits(this->Instances->poses(onOthers), this->Selection)
                                      : selectPoses(this->Verified, this->InScene, this->Model, this->Selection);
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

Poses PoseSearch::select(const PoseSelectionSettings& selection, const Progress& progress)
{
  this->finish(selection, progress);
  Poses poses = this->ranked();
  report(progress, 1.0);
  return poses;
}

Poses PoseSearch::selectWanted(const PoseSelectionSettings& selection, const Progress& progress)
{
  Poses poses = this->select(selection, progress);
  eraseIf(poses, [this](const Pose& pose) { return !this->isWanted(pose); });
  return poses;
}

void PoseSearch::returned(PoseStage stage, const Poses& poses)
{
  if (this->Observer)
  {
    this->Returned[stage] = poses;
  }
}

Eigen::Vector3d PoseSearch::middleInScan(const Pose& pose) const
{
  const Eigen::Vector3d middle = this->Model.visibility->middle().cast<double>();
  return this->InScene.T_local_scene().inverse() * pose.T_scene_model * middle;
}

bool PoseSearch::isWanted(const Pose& pose) const
{
  return !this->Settings.region || this->Settings.region->contains(this->middleInScan(pose));
}
}
