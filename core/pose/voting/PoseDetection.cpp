// SPDX-License-Identifier: BSD-3-Clause
#include "pose/voting/PoseDetection.h"

#include "base/Parallel.h"
#include "pose/voting/PairVoting.h"
#include "pose/voting/VoteAccumulator.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numeric>

namespace meam
{
namespace
{
/// A pose by the vote of a reference point, and the part's point that it was taken for.
struct Candidate
{
  Pose pose;
  int modelPoint = -1;
};

/// One or more for each reference point that found pairs, in their order. `references`: of the round's points.
std::vector<Candidate> candidatesOf(const VotingRound& round, const PairVoting& voting,
  const std::vector<int>& references, const Symmetries& symmetries, const PoseDetectionSettings& settings,
  const Progress& progress)
{
  const PartPairs& part = round.part;
  const int count = static_cast<int>(references.size());
  if (count == 0 || part.table.votingPoints == 0)
  {
    return {};
  }
  const int threads = std::min(numberOfThreads(settings.threads), count);
  std::vector<VoteAccumulator> accumulators(
    threads, VoteAccumulator(part.table.votingPoints, part.angleStep, settings.smoothPeaks));
  std::vector<std::vector<Candidate>> found(count);
  parallelFor(count, threads, progress,
    [&](int begin, int end, int thread)
    {
      VoteAccumulator& accumulator = accumulators[thread];
      for (int r = begin; r < end; ++r)
      {
        const PairFrame scene(round.points.points[references[r]], round.points.directions[references[r]]);
        accumulator.clear();
        voting.vote(scene, accumulator);
        for (const VotePeak& peak : accumulator.peaks(settings.peaksPerReference))
        {
          const PairFrame model(part.points[peak.modelPoint], part.directions[peak.modelPoint]);
          Candidate candidate{ {}, peak.modelPoint };
          candidate.pose.T_scene_model =
            nearestEqual(alignFrames(model, scene, peak.flip, peak.alpha), Eigen::Isometry3d::Identity(), symmetries);
          candidate.pose.votes = peak.votes;
          found[r].push_back(candidate);
        }
      }
    });
  std::vector<Candidate> all;
  for (const std::vector<Candidate>& ofOne : found)
  {
    all.insert(all.end(), ofOne.begin(), ofOne.end());
  }
  return all;
}

/// Their poses, with the appearance model of the edge point that each was taken for.
Poses edgePoses(const std::vector<Candidate>& candidates, const TrainedModel& model)
{
  Poses poses;
  for (const Candidate& candidate : candidates)
  {
    poses.push_back(candidate.pose);
    poses.back().viewId = __builtin_ctz(model.edgeViews[candidate.modelPoint]);
  }
  return poses;
}

/// Their poses, with the appearance model that shows what the sensor sees.
Poses surfacePoses(const std::vector<Candidate>& candidates, const Scene& scene, const TrainedModel& model)
{
  Poses poses;
  for (const Candidate& candidate : candidates)
  {
    poses.push_back(candidate.pose);
    poses.back().viewId = model.visibility->view(candidate.pose.T_scene_model, scene.sensor);
  }
  return poses;
}

/// Those of a round between two shares of all, ascending.
std::vector<int> referencesOf(const VotingRound& round, double from, double to)
{
  const auto at = [&](double share)
  { return round.references.begin() + std::lround(share * static_cast<double>(round.references.size())); };
  std::vector<int> references(at(from), at(to));
  std::sort(references.begin(), references.end());
  return references;
}
}

/// Of edge points and of the surface, as far as there are both.
struct CandidateSearch::Rounds
{
  std::vector<VotingRound> rounds;
  std::vector<PairVoting> votings; ///< of each

  Rounds(const Scene& scene, const TrainedModel& model, const PoseDetectionSettings& settings)
    : rounds(votingRounds(scene, model, settings))
  {
    std::transform(this->rounds.begin(), this->rounds.end(), std::back_inserter(this->votings),
      [&](const VotingRound& round) { return PairVoting(round, settings); });
  }

  /// Of some of the points of each round: `referencesOf(round)`.
  template <typename References>
  Poses candidates(const Scene& scene, const TrainedModel& model, const PoseDetectionSettings& settings,
    References&& referencesOf, const Progress& progress) const
  {
    constexpr double edgeWork = 0.6; // of the progress of both rounds
    Poses poses;
    for (std::size_t k = 0; k < this->rounds.size(); ++k)
    {
      const VotingRound& round = this->rounds[k];
      const bool isLast = k + 1 == this->rounds.size();
      const Progress ofRound = subProgress(progress, k == 0 ? 0.0 : edgeWork, isLast ? 1.0 : edgeWork);
      const auto candidates =
        candidatesOf(round, this->votings[k], referencesOf(round), model.symmetries, settings, ofRound);
      const Poses found = round.byEdges ? edgePoses(candidates, model) : surfacePoses(candidates, scene, model);
      poses.insert(poses.end(), found.begin(), found.end());
    }
    report(progress, 1.0);
    return poses;
  }
};

CandidateSearch::CandidateSearch(const Scene& scene, const TrainedModel& model, const PoseDetectionSettings& settings)
  : InScene(scene)
  , Model(model)
  , Settings(settings)
  , Prepared(std::make_unique<Rounds>(scene, model, settings))
{
}

CandidateSearch::~CandidateSearch() = default;

Poses CandidateSearch::candidates(double from, double to, const Progress& progress) const
{
  return this->Prepared->candidates(
    this->InScene, this->Model, this->Settings, [&](const VotingRound& round) { return referencesOf(round, from, to); },
    progress);
}

Poses CandidateSearch::candidatesNear(const Eigen::Vector3f& place, double radius, const Progress& progress) const
{
  const auto near = [&](const VotingRound& round)
  {
    std::vector<int> indices;
    for (std::size_t i = 0; i < round.points.points.size(); ++i)
    {
      if ((round.points.points[i] - place).norm() <= radius)
      {
        indices.push_back(static_cast<int>(i));
      }
    }
    return indices;
  };
  return this->Prepared->candidates(this->InScene, this->Model, this->Settings, near, progress);
}

Poses detectPoses(const LocalCloud& sceneEdges, const TrainedModel& model, const PoseDetectionSettings& settings,
  const Progress& progress)
{
  const VotingRound round = edgeRound(sceneEdges, model, settings);
  const PairVoting voting(round, settings);
  Poses poses =
    edgePoses(candidatesOf(round, voting, referencesOf(round, 0.0, 1.0), model.symmetries, settings, progress), model);
  report(progress, 1.0);
  return poses;
}

Poses detectPoses(
  const Scene& scene, const TrainedModel& model, const PoseDetectionSettings& settings, const Progress& progress)
{
  return CandidateSearch(scene, model, settings).candidates(0.0, 1.0, progress);
}
}
