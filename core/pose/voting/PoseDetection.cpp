// SPDX-License-Identifier: BSD-3-Clause
#include "pose/voting/PoseDetection.h"

#include "base/Parallel.h"
#include "base/sequences/Sequences.h"
#include "pose/voting/PairVoting.h"
#include "pose/voting/VoteAccumulator.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>

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

using Candidates = std::vector<Candidate>;

/// Those of each reference point, one or more where it found pairs. `references`: of the round's points.
std::vector<Candidates> candidatesOf(const VotingRound& round, const PairVoting& voting,
  const std::vector<int>& references, const Symmetries& symmetries, const PoseDetectionSettings& settings,
  const Progress& progress)
{
  const PartPairs& part = round.part;
  const int count = static_cast<int>(references.size());
  std::vector<Candidates> found(count);
  if (count == 0 || part.table.votingPoints == 0)
  {
    return found;
  }
  const int threads = std::min(numberOfThreads(settings.threads), count);
  std::vector<VoteAccumulator> accumulators(
    threads, VoteAccumulator(part.table.votingPoints, part.angleStep, settings.smoothPeaks));
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
  return found;
}

/// The pose with the appearance model of the edge point that it was taken for.
Pose edgePose(const Candidate& candidate, const TrainedModel& model)
{
  Pose pose = candidate.pose;
  pose.viewId = __builtin_ctz(model.edgeViews[candidate.modelPoint]);
  return pose;
}

/// The pose with the appearance model that shows what the sensor sees.
Pose surfacePose(const Candidate& candidate, const Scene& scene, const TrainedModel& model)
{
  Pose pose = candidate.pose;
  pose.viewId = model.visibility->view(pose.T_scene_model, scene.sensor);
  return pose;
}
}

/// Of edge points and of the surface, as far as there are both.
struct CandidateSearch::Rounds
{
  std::vector<VotingRound> rounds;
  std::vector<PairVoting> votings;              ///< of each
  std::vector<std::map<int, Candidates>> found; ///< of each, by the reference points that have voted

  Rounds(const Scene& scene, const TrainedModel& model, const PoseDetectionSettings& settings)
    : rounds(votingRounds(scene, model, settings))
    , found(rounds.size())
  {
    std::transform(this->rounds.begin(), this->rounds.end(), std::back_inserter(this->votings),
      [&](const VotingRound& round) { return PairVoting(round, settings); });
  }

  Progress ofRound(std::size_t k, const Progress& progress) const
  {
    constexpr double edgeWork = 0.6; // of the progress of both rounds
    return subProgress(progress, k == 0 ? 0.0 : edgeWork, k + 1 == this->rounds.size() ? 1.0 : edgeWork);
  }

  void add(std::size_t k, const Candidates& candidates, const Scene& scene, const TrainedModel& model, Poses& to) const
  {
    for (const Candidate& candidate : candidates)
    {
      to.push_back(this->rounds[k].byEdges ? edgePose(candidate, model) : surfacePose(candidate, scene, model));
    }
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

Poses CandidateSearch::upTo(double share, const Progress& progress)
{
  Rounds& prepared = *this->Prepared;
  Poses poses;
  for (std::size_t k = 0; k < prepared.rounds.size(); ++k)
  {
    const VotingRound& round = prepared.rounds[k];
    std::map<int, Candidates>& found = prepared.found[k];
    const auto last = round.references.begin() + std::lround(share * static_cast<double>(round.references.size()));
    const std::vector<int> references(
      round.references.begin() + std::min<std::ptrdiff_t>(found.size(), last - round.references.begin()), last);
    const std::vector<Candidates> more = candidatesOf(
      round, prepared.votings[k], references, this->Model.symmetries, this->Settings, prepared.ofRound(k, progress));
    for (std::size_t i = 0; i < references.size(); ++i)
    {
      found[references[i]] = more[i];
    }
    for (const auto& [reference, candidates] : found)
    {
      prepared.add(k, candidates, this->InScene, this->Model, poses);
    }
  }
  report(progress, 1.0);
  return poses;
}

int CandidateSearch::references() const
{
  std::size_t count = 0;
  for (const std::map<int, Candidates>& ofRound : this->Prepared->found)
  {
    count += ofRound.size();
  }
  return static_cast<int>(count);
}

Poses CandidateSearch::near(const Eigen::Vector3f& place, double radius, const Progress& progress) const
{
  const Rounds& prepared = *this->Prepared;
  Poses poses;
  for (std::size_t k = 0; k < prepared.rounds.size(); ++k)
  {
    const Points& points = prepared.rounds[k].points.points;
    const std::vector<int> within =
      indicesWhere(points.size(), [&](int i) { return (points[i] - place).norm() <= radius; });
    for (const Candidates& candidates : candidatesOf(prepared.rounds[k], prepared.votings[k], within,
           this->Model.symmetries, this->Settings, prepared.ofRound(k, progress)))
    {
      prepared.add(k, candidates, this->InScene, this->Model, poses);
    }
  }
  report(progress, 1.0);
  return poses;
}

Poses detectPoses(const LocalCloud& sceneEdges, const TrainedModel& model, const PoseDetectionSettings& settings,
  const Progress& progress)
{
  const VotingRound round = edgeRound(sceneEdges, model, settings);
  const PairVoting voting(round, settings);
  std::vector<int> references = round.references;
  std::sort(references.begin(), references.end());
  Poses poses;
  for (const Candidates& candidates : candidatesOf(round, voting, references, model.symmetries, settings, progress))
  {
    std::transform(candidates.begin(), candidates.end(), std::back_inserter(poses),
      [&](const Candidate& candidate) { return edgePose(candidate, model); });
  }
  report(progress, 1.0);
  return poses;
}

Poses detectPoses(
  const Scene& scene, const TrainedModel& model, const PoseDetectionSettings& settings, const Progress& progress)
{
  return CandidateSearch(scene, model, settings).upTo(1.0, progress);
}
}
