// SPDX-License-Identifier: BSD-3-Clause
#include "pose/diagnosis/PoseDiagnosis.h"

#include "base/sequences/Sequences.h"
#include "pose/PoseTolerances.h"
#include "pose/objective/BodyOverlap.h"
#include "pose/objective/SurfaceContinuation.h"
#include "pose/refinement/FinalAlignment.h"
#include "pose/search/Suppression.h"
#include "scene/preparation/SearchRegion.h"

#include <algorithm>
#include <cmath>
#include <iterator>

namespace meam
{
namespace
{
constexpr double FoundAngle = 5.0;    // degrees: what comes out and is turned by more is another rotation
constexpr double LeastVisible = 0.25; // share of the part's side towards the sensor: with less visible it is hidden
constexpr double LeastThere = 0.5;    // share of the unhidden surface: more seen past or unmeasured, and that is why
constexpr double LeastEnclosed = 1.0; // patches of its body behind the bin's floor or a wall: more, and that is why
constexpr double AtOrigin = 0.01; // of the diameter: what a pose's translation is rounded by, when somebody types it
constexpr double LookedFor = 0.5; // of the diameter: points this near to a picked one, or to a middle, all vote
constexpr PlaceTolerance SameResult{ 1e-3, 1e-2 }; // mm and degrees, of a search that is run again
constexpr int PeaksLookedFor = 3; // candidates of each of them, when a place is looked for by a picked point

/// The settings without a limit on what comes out, or where.
DetectionSettings withoutLimits(DetectionSettings settings)
{
  settings.selection.maximumPoses = 0;
  settings.selection.minimumProbability = 0.0;
  settings.region = nullptr;
  return settings;
}

Pose poseAt(const Eigen::Isometry3d& T)
{
  Pose pose;
  pose.T_scene_model = T;
  return pose;
}

PrecisePoints inScene(const Points& points, const Eigen::Isometry3d& T_local_scene)
{
  const Eigen::Isometry3d toScene = T_local_scene.inverse();
  return mapped<Eigen::Vector3d>(
    points, [&](const Eigen::Vector3f& point) -> Eigen::Vector3d { return toScene * point.cast<double>(); });
}
}

double distanceFrom(const TrainedModel& model, const Eigen::Isometry3d& T_scene_model, const Eigen::Vector3d& point)
{
  const Eigen::Vector3d inModel = T_scene_model.inverse() * point;
  return inModel.norm() < AtOrigin * model.diameter ? 0.0 : model.surfaceDistance.at(inModel.cast<float>());
}

PoseDiagnosis::PoseDiagnosis(
  const Scene& scene, const TrainedModel& model, const DetectionSettings& detection, bool fit, const Progress& progress)
  : InScene(scene)
  , Model(model)
  , Detection(detection)
  , Fit(fit)
  , Trace(scene, model, this->Detection, progress)
{
}

Diagnosis PoseDiagnosis::atPose(const Eigen::Isometry3d& T_scene_model, const Progress& progress)
{
  const Poses local = toLocalFrame({ poseAt(T_scene_model) }, this->InScene.T_local_scene(), this->Model.symmetries);
  const Eigen::Isometry3d& T = local.front().T_scene_model;
  return this->at(this->Fit ? this->fitted(T) : T, progress);
}

Diagnosis PoseDiagnosis::ofFound(const Pose& pose, int rank, const Progress& progress)
{
  const Pose local = toLocalFrame({ pose }, this->InScene.T_local_scene(), this->Model.symmetries).front();
  return this->at(local.T_scene_model, progress, &local, rank);
}

Diagnosis PoseDiagnosis::atPoint(
  const Eigen::Vector3d& point, const Progress& progress, const Poses& found, const std::vector<int>& ranks)
{
  const Eigen::Vector3d place = this->InScene.T_local_scene() * point;
  const auto distanceTo = [&](const Pose& pose) { return distanceFrom(this->Model, pose.T_scene_model, place); };
  const auto isOn = [&](const Pose& pose) { return distanceTo(pose) < OnSurface * this->Model.diameter; };
  const auto firstOn = [&](const Poses& poses) { return std::find_if(poses.begin(), poses.end(), isOn); };
  const auto isLikely = [](const Pose& pose) { return claimOf(pose, false) >= LikelyFound; };
  const Poses& ranked = this->Trace.ranked();
  const auto own = firstOn(ranked);
  const Poses given = toLocalFrame(found, this->InScene.T_local_scene(), this->Model.symmetries);
  const auto nearest = std::min_element(
    given.begin(), given.end(), [&](const Pose& a, const Pose& b) { return distanceTo(a) < distanceTo(b); });
  if (nearest != given.end() && isOn(*nearest) && (isLikely(*nearest) || own == ranked.end() || !isLikely(*own)))
  {
    return this->at(nearest->T_scene_model, progress, &*nearest, ranks.at(nearest - given.begin()));
  }
  if (own != ranked.end())
  {
    Diagnosis of = this->at(own->T_scene_model, progress);
    of.isOfFound = true;
    return of;
  }
  PoseDetectionSettings voting = this->Detection.detection;
  voting.peaksPerReference = std::max(voting.peaksPerReference, PeaksLookedFor);
  const Poses candidates =
    CandidateSearch(this->InScene, this->Model, voting)
      .near(place.cast<float>(), LookedFor * this->Model.diameter, subProgress(progress, 0.0, 0.3));
  const Poses nearby = rankCandidates(
    candidates, this->InScene, this->Model, withoutLimits(this->Detection), nullptr, subProgress(progress, 0.3, 0.6));
  const auto best = firstOn(nearby);
  const auto notWanted = firstOn(this->Trace.unlimited());
  const bool isKeptBack = notWanted != this->Trace.unlimited().end();
  if (isKeptBack || best != nearby.end())
  {
    const bool takesBest = best != nearby.end() && (!isKeptBack || best->evidence > notWanted->evidence);
    return this->at((takesBest ? best : notWanted)->T_scene_model, subProgress(progress, 0.6, 1.0));
  }
  Diagnosis nothing;
  const bool isOutside = this->Detection.region && !this->Detection.region->contains(point);
  nothing.cause = isOutside ? LossCause::Outside : LossCause::NoPose;
  nothing.lostIn = PoseStage::Voting;
  report(progress, 1.0);
  return nothing;
}

Diagnosis PoseDiagnosis::at(
  const Eigen::Isometry3d& T_local_model, const Progress& progress, const Pose* found, int rank)
{
  Diagnosis diagnosis;
  const Eigen::Isometry3d& T_local_scene = this->InScene.T_local_scene();
  diagnosis.evidence = evidenceAt(T_local_model, this->InScene, this->Model, this->Detection.verification.evidence);
  diagnosis.edgePoints = inScene(diagnosis.evidence.points.edges, T_local_scene);
  diagnosis.surfacePoints = inScene(diagnosis.evidence.points.surface, T_local_scene);
  this->continueSurface(diagnosis, T_local_model);
  diagnosis.surfaceShare = surfaceShares(
    { poseAt(T_local_model) }, this->InScene, this->Model, this->Detection.screening.value_or(PoseScreeningSettings()))
                             .front();
  diagnosis.votes =
    votesForPose(T_local_model, this->InScene, this->Model, this->Detection.detection, subProgress(progress, 0.0, 0.4));
  this->score(diagnosis, T_local_model);
  this->count(diagnosis, T_local_model);
  if (found)
  {
    this->takeFound(diagnosis, *found, rank);
  }
  else
  {
    diagnosis.cause = this->causeOf(diagnosis, T_local_model, subProgress(progress, 0.4, 1.0));
  }
  this->explain(diagnosis, T_local_model);
  report(progress, 1.0);
  return diagnosis;
}

Eigen::Isometry3d PoseDiagnosis::fitted(const Eigen::Isometry3d& T_local_model) const
{
  Pose pose = refinePoses({ poseAt(T_local_model) }, this->InScene, this->Model, this->Detection.refinement).front();
  pose = alignRobustly(pose, this->InScene, this->Model);
  const PoseVerificationSettings verification = this->verification();
  if (verification.evidence.rates) // else poses are not judged by their evidence
  {
    const EvidenceCollector collector(this->InScene, this->Model, verification.evidence);
    const PatternSearch search(
      collector, *verification.evidence.rates, this->Model, this->Detection.selection.search.pattern);
    pose.T_scene_model = search.best(pose.T_scene_model).T_scene_model;
  }
  if (!offsetBetween(pose.T_scene_model, T_local_model, this->Model).within(this->tolerance()))
  {
    return T_local_model;
  }
  const Poses both = verifyPoses({ poseAt(T_local_model), pose }, this->InScene, this->Model, verification);
  return both.empty() ? T_local_model : both.front().T_scene_model;
}

void PoseDiagnosis::score(Diagnosis& diagnosis, const Eigen::Isometry3d& T_local_model) const
{
  constexpr int mark = -1; // votes that no other pose has
  Poses poses = this->Trace.posesOf(PoseStage::Verification);
  poses.push_back(poseAt(T_local_model));
  poses.back().votes = mark;
  const Poses scored = verifyPoses(poses, this->InScene, this->Model, this->verification());
  const auto place = std::find_if(scored.begin(), scored.end(), [](const Pose& pose) { return pose.votes == mark; });
  Pose result = poses.back();
  if (place != scored.end())
  {
    result = *place;
    diagnosis.placeRank = static_cast<int>(place - scored.begin()) + 1;
  }
  diagnosis.bestEvidence = scored.empty() ? 0.0 : scored.front().evidence;
  result.votes = 0;
  for (const PointVotes& point : diagnosis.votes)
  {
    result.votes = std::max(result.votes, point.isReference ? point.votes : 0);
  }
  diagnosis.place = toSceneFrame({ result }, this->InScene.T_local_scene(), this->Model.symmetries).front();
}

void PoseDiagnosis::count(Diagnosis& diagnosis, const Eigen::Isometry3d& T_local_model) const
{
  for (const auto& [stage, poses] : this->Trace.stages())
  {
    const std::vector<int> here = posesAt(poses, T_local_model, this->tolerance(), this->Model);
    diagnosis.stages.push_back(
      { stage, static_cast<int>(poses.size()), static_cast<int>(here.size()), here.empty() ? 0 : here.front() + 1 });
  }
}

void PoseDiagnosis::continueSurface(Diagnosis& diagnosis, const Eigen::Isometry3d& T_local_model) const
{
  const SurfaceContinuation continuation(this->InScene, this->Model);
  const Points beyond = continuation.beyond(T_local_model);
  diagnosis.unexplained = inScene(beyond, this->InScene.T_local_scene());
  std::vector<Eigen::Isometry3f> others;
  for (const Pose& other : this->Trace.unlimited())
  {
    if (claimOf(other, false) >= LikelyFound &&
        !offsetBetween(other.T_scene_model, T_local_model, this->Model).within(this->tolerance()))
    {
      others.push_back(other.T_scene_model.inverse().cast<float>());
    }
  }
  diagnosis.continuing = continuation.unexplained(beyond, others);
}

void PoseDiagnosis::takeFound(Diagnosis& diagnosis, const Pose& found, int rank) const
{
  diagnosis.rank = diagnosis.rankWithoutLimits = rank;
  diagnosis.probability = claimOf(found, this->Detection.selection.rotationCounts);
  diagnosis.found = found;
  diagnosis.isOfFound = true;
  // What contradicts it, and its other rotations, are known of this search's pose there.
  const Poses& all = this->Trace.unlimited();
  const std::vector<int> same = posesAt(all, found.T_scene_model, this->tolerance(), this->Model);
  if (!same.empty())
  {
    diagnosis.found->contradictions = all[same.front()].contradictions;
    diagnosis.found->alternatives = all[same.front()].alternatives;
  }
}

LossCause PoseDiagnosis::causeOf(Diagnosis& diagnosis, const Eigen::Isometry3d& T_local_model, const Progress& progress)
{
  const std::vector<StageCount>& stages = diagnosis.stages;
  if (stages.back().here > 0)
  {
    diagnosis.rank = diagnosis.rankWithoutLimits = stages.back().bestRank;
    diagnosis.offset =
      offsetBetween(this->Trace.ranked()[diagnosis.rank - 1].T_scene_model, T_local_model, this->Model);
    diagnosis.probability = claimOf(this->Trace.ranked()[diagnosis.rank - 1], this->Detection.selection.rotationCounts);
    if (diagnosis.offset.angle < FoundAngle)
    {
      return LossCause::None;
    }
    diagnosis.lostIn = PoseStage::Selection;
    return LossCause::Inaccurate;
  }
  const Eigen::Vector3d middle = T_local_model * this->Model.visibility->middle().cast<double>();
  if (this->Detection.region && !this->Detection.region->contains(this->InScene.T_local_scene().inverse() * middle))
  {
    diagnosis.lostIn = PoseStage::Voting;
    return LossCause::Outside;
  }
  const auto last =
    std::find_if(stages.rbegin(), stages.rend(), [](const StageCount& stage) { return stage.here > 0; });
  this->findTaker(diagnosis, T_local_model);
  // What selection turns or fits anew may come here from poses that were not here before.
  const std::vector<int> keptBack = posesAt(this->Trace.unlimited(), T_local_model, this->tolerance(), this->Model);
  if (!keptBack.empty())
  {
    return this->notWanted(diagnosis, keptBack.front() + 1, T_local_model);
  }
  diagnosis.lostIn = last == stages.rend() ? PoseStage::Voting : std::prev(last)->stage;
  const Poses& refined = this->Trace.posesOf(PoseStage::Refinement); // the first of those that may be
  std::size_t candidate = 0;
  if (*diagnosis.lostIn == PoseStage::Refinement)
  {
    const Poses& before = this->Trace.posesOf(PoseStage::CandidateSelection);
    candidate = posesAt(before, T_local_model, this->tolerance(), this->Model).front();
    if (candidate >= refined.size())
    {
      diagnosis.lostIn = PoseStage::CandidateSelection;
    }
  }
  if (*diagnosis.lostIn == PoseStage::Voting || *diagnosis.lostIn == PoseStage::Screening ||
      *diagnosis.lostIn == PoseStage::CandidateSelection)
  {
    diagnosis.isFoundByAllPoints = this->isFoundByAllPoints(T_local_model, progress);
  }
  LossCause cause = LossCause::LowScore;
  switch (*diagnosis.lostIn)
  {
    case PoseStage::Voting:
      cause = causeInVoting(diagnosis);
      break;
    case PoseStage::Screening:
      cause = this->causeInScreening(diagnosis, T_local_model);
      break;
    case PoseStage::CandidateSelection:
    {
      const Poses& all = this->Trace.allAlternatives();
      cause =
        posesAt(all, T_local_model, this->tolerance(), this->Model).empty() ? LossCause::Taken : LossCause::NotRefined;
      break;
    }
    case PoseStage::Refinement:
      diagnosis.offset = offsetBetween(refined[candidate].T_scene_model, T_local_model, this->Model);
      cause = LossCause::MovedAway;
      break;
    case PoseStage::Selection:
      cause = this->isTurnedAmong(this->Trace.unlimited(), T_local_model) ? LossCause::OtherRotation : LossCause::Taken;
      break;
    case PoseStage::CandidateVerification:
    case PoseStage::Verification:
      break;
  }
  if (cause == LossCause::Taken && diagnosis.takenBy > static_cast<int>(this->Trace.ranked().size()) &&
      diagnosis.takenShare > SharedByOne)
  {
    return this->notWanted(diagnosis, diagnosis.takenBy, T_local_model);
  }
  const PlaceEvidence& evidence = diagnosis.evidence;
  const double missing = evidence.surfaceShare(PointState::Violated) + evidence.surfaceShare(PointState::Unknown);
  const bool isEnclosed = evidence.points.counts.enclosed > LeastEnclosed;
  return diagnosis.place->visibleFraction < LeastVisible            ? LossCause::Hidden
         : isEnclosed                                               ? LossCause::Enclosed
         : evidence.surfaceShare(PointState::Violated) > LeastThere ? LossCause::NotThere
         : missing > LeastThere                                     ? LossCause::NotMeasured
                                                                    : cause;
}

void PoseDiagnosis::explain(Diagnosis& diagnosis, const Eigen::Isometry3d& T_local_model)
{
  const Poses& all = this->Trace.unlimited();
  if (diagnosis.rank > 0 && !diagnosis.found)
  {
    diagnosis.found = this->Trace.ranked()[diagnosis.rank - 1];
  }
  else if (diagnosis.rankWithoutLimits > 0 && !diagnosis.found)
  {
    diagnosis.found = all[diagnosis.rankWithoutLimits - 1];
  }
  const EvidenceSettings evidence = this->verification().evidence;
  if (evidence.rates)
  {
    const EvidenceCollector collector(this->InScene, this->Model, evidence);
    const Eigen::Isometry3d& T = diagnosis.found ? diagnosis.found->T_scene_model : T_local_model;
    const EvidenceCounts counts = collector.collect(T).counts;
    diagnosis.odds = collector.placeOdds(counts, *evidence.rates, collector.logOdds(counts, *evidence.rates));
    if (diagnosis.found)
    {
      const auto same = std::find_if(all.begin(), all.end(), // tables have no penalty
        [&](const Pose& pose) { return offsetBetween(pose.T_scene_model, T, this->Model).within(SameResult); });
      diagnosis.penalty = same != all.end() ? same->penalty : 0.0;
      diagnosis.odds.searched -= diagnosis.penalty;
      const double place = diagnosis.found->placeProbability;
      const double calibrated = std::log(place / (1.0 - place));
      const double logOdds = this->Model.calibration.place.countedOf(calibrated);
      diagnosis.moreByCalibration = calibrated - logOdds;
      diagnosis.lessByOthers = diagnosis.odds.sum() - logOdds;
      const auto cut = std::find_if(all.begin(), all.end(),
        [&](const Pose& other)
        {
          return !offsetBetween(other.T_scene_model, T, this->Model).within(this->tolerance()) &&
                 bodiesOverlap(this->Model, other.T_scene_model, T);
        });
      diagnosis.cutsInto = cut == all.end() ? 0 : static_cast<int>(cut - all.begin()) + 1;
    }
  }
  double nearest = this->Model.diameter;
  for (std::size_t k = 0; k < all.size(); ++k)
  {
    const PoseOffset offset = offsetBetween(all[k].T_scene_model, T_local_model, this->Model);
    if (offset.distance < nearest && !offset.within(this->tolerance()))
    {
      nearest = offset.distance;
      diagnosis.otherRank = static_cast<int>(k) + 1;
      diagnosis.otherOffset = offset;
      diagnosis.otherProbability = claimOf(all[k], this->Detection.selection.rotationCounts);
    }
  }
}

LossCause PoseDiagnosis::notWanted(Diagnosis& diagnosis, int rank, const Eigen::Isometry3d& T_local_model)
{
  const Pose& pose = this->Trace.unlimited()[rank - 1];
  diagnosis.lostIn = PoseStage::Selection;
  diagnosis.rankWithoutLimits = rank;
  diagnosis.offset = offsetBetween(pose.T_scene_model, T_local_model, this->Model);
  diagnosis.probability = claimOf(pose, this->Detection.selection.rotationCounts);
  return LossCause::NotWanted;
}

bool PoseDiagnosis::isFoundByAllPoints(const Eigen::Isometry3d& T_local_model, const Progress& progress) const
{
  const Eigen::Vector3f middle = T_local_model.cast<float>() * this->Model.visibility->middle();
  Poses candidates = CandidateSearch(this->InScene, this->Model, this->Detection.detection)
                       .near(middle, LookedFor * this->Model.diameter, subProgress(progress, 0.0, 0.4));
  const Poses& voted = this->Trace.posesOf(PoseStage::Voting);
  candidates.insert(candidates.end(), voted.begin(), voted.end());
  const Poses ranked = rankCandidates(
    candidates, this->InScene, this->Model, withoutLimits(this->Detection), nullptr, subProgress(progress, 0.4, 1.0));
  return !posesAt(ranked, T_local_model, this->tolerance(), this->Model).empty();
}

LossCause PoseDiagnosis::causeInVoting(const Diagnosis& diagnosis)
{
  const bool isElected = std::any_of(diagnosis.votes.begin(), diagnosis.votes.end(),
    [](const PointVotes& point) { return !point.isReference && point.rank == 1; });
  const bool hasFewEdges = diagnosis.evidence.edgeShare() <= EvidenceRates().edges.chance;
  return isElected && diagnosis.isFoundByAllPoints ? LossCause::NoReference
         : hasFewEdges                             ? LossCause::FewEdges
                                                   : LossCause::Outvoted;
}

LossCause PoseDiagnosis::causeInScreening(Diagnosis& diagnosis, const Eigen::Isometry3d& T_local_model) const
{
  const Poses& voted = this->Trace.posesOf(PoseStage::Voting);
  const auto here = mapped<Pose>(
    posesAt(voted, T_local_model, this->tolerance(), this->Model), [&](const int index) { return voted[index]; });
  const std::vector<double> shares = surfaceShares(here, this->InScene, this->Model, *this->Detection.screening);
  diagnosis.candidateShare = *std::max_element(shares.begin(), shares.end());
  return diagnosis.candidateShare < this->Detection.screening->leastSurface              ? LossCause::SurfaceMissing
         : this->isTurnedAmong(this->Trace.posesOf(PoseStage::Screening), T_local_model) ? LossCause::OtherRotation
                                                                                         : LossCause::Duplicate;
}

PoseVerificationSettings PoseDiagnosis::verification() const
{
  PoseVerificationSettings settings = this->Detection.verification;
  settings.evidence.rates = this->Trace.rates();
  return settings;
}

bool PoseDiagnosis::isTurnedAmong(const Poses& poses, const Eigen::Isometry3d& T_local_model) const
{
  return std::any_of(poses.begin(), poses.end(),
    [&](const Pose& pose)
    { return offsetUpToNear(pose.T_scene_model, T_local_model, this->Model).within(this->tolerance()); });
}

void PoseDiagnosis::findTaker(Diagnosis& diagnosis, const Eigen::Isometry3d& T_local_model)
{
  const Poses& ranked = this->Trace.unlimited();
  const auto explained = [&](const Eigen::Isometry3d& T)
  { return explainedPoints(this->InScene, this->Model, T, UnexplainedDistance * this->Model.diameter); };
  const ExplainedPoints points = explained(T_local_model);
  for (std::size_t k = 0; k < ranked.size() && !points.empty(); ++k)
  {
    const double share = static_cast<double>(sharedPoints(points, explained(ranked[k].T_scene_model))) /
                         static_cast<double>(points.size());
    if (share > diagnosis.takenShare)
    {
      diagnosis.takenBy = static_cast<int>(k) + 1;
      diagnosis.takenShare = share;
      diagnosis.takenEvidence = ranked[k].evidence;
    }
  }
}

PlaceTolerance PoseDiagnosis::tolerance() const { return { SamePoseDistance * this->Model.diameter, SamePoseAngle }; }
}
