// SPDX-License-Identifier: BSD-3-Clause
#include "pose/voting/PoseDetection.h"

#include "base/Parallel.h"
#include "pose/voting/PairVoting.h"
#include "pose/voting/VoteAccumulator.h"

#include <algorithm>
#include <limits>
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
std::vector<Candidate> candidatesOf(const VotingRound& round, const std::vector<int>& references,
  const Symmetries& symmetries, const PoseDetectionSettings& settings, const Progress& progress)
{
  const PartPairs& part = round.part;
  const int count = static_cast<int>(references.size());
  if (count == 0 || part.table.votingPoints == 0)
  {
    return {};
  }
  const PairVoting voting(round, settings);
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

/// Candidates of some of the points of each round: `referencesOf(round)`.
template <typename References>
Poses detectBy(const Scene& scene, const TrainedModel& model, const PoseDetectionSettings& settings,
  References&& referencesOf, const Progress& progress)
{
  constexpr double edgeWork = 0.6; // of the progress of both rounds
  const std::vector<VotingRound> rounds = votingRounds(scene, model, settings);
  Poses poses;
  for (const VotingRound& round : rounds)
  {
    const bool isLast = &round == &rounds.back();
    const Progress ofRound = subProgress(progress, &round == &rounds.front() ? 0.0 : edgeWork, isLast ? 1.0 : edgeWork);
    const auto candidates = candidatesOf(round, referencesOf(round), model.symmetries, settings, ofRound);
    const Poses found = round.byEdges ? edgePoses(candidates, model) : surfacePoses(candidates, scene, model);
    poses.insert(poses.end(), found.begin(), found.end());
  }
  report(progress, 1.0);
  return poses;
}
}

PoseDetectionSettings paperDetectionSettings()
{
  PoseDetectionSettings settings;
  settings.referenceShare = 0.2; // tuned for each part there, from 5 to 20 %: the most
  settings.referredShare = 0.2;
  settings.features = Features::Edges;
  return settings;
}

PoseDetectionSettings originalDetectionSettings()
{
  PoseDetectionSettings settings;
  settings.features = Features::Surface;
  settings.referenceShare = 0.2;
  settings.longestBucket = std::numeric_limits<double>::infinity();
  settings.smoothPeaks = false;
  return settings;
}

Poses detectPoses(const LocalCloud& sceneEdges, const TrainedModel& model, const PoseDetectionSettings& settings,
  const Progress& progress)
{
  const VotingRound round = edgeRound(sceneEdges, model, settings);
  Poses poses = edgePoses(candidatesOf(round, round.references, model.symmetries, settings, progress), model);
  report(progress, 1.0);
  return poses;
}

Poses detectPoses(
  const Scene& scene, const TrainedModel& model, const PoseDetectionSettings& settings, const Progress& progress)
{
  return detectBy(
    scene, model, settings, [](const VotingRound& round) { return round.references; }, progress);
}

Poses detectPosesNear(const Eigen::Vector3f& place, double radius, const Scene& scene, const TrainedModel& model,
  const PoseDetectionSettings& settings, const Progress& progress)
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
  return detectBy(scene, model, settings, near, progress);
}
}
