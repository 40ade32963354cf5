// SPDX-License-Identifier: BSD-3-Clause
#include "pose/voting/PoseDetection.h"

#include "base/BlockedPoints.h"
#include "base/Parallel.h"
#include "base/PointGrid.h"
#include "pose/voting/VoteAccumulator.h"
#include "scene/Units.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numeric>

namespace meam
{
namespace
{
/// A number that looks random, from a place and a seed (finalizer of MurmurHash3).
std::uint64_t hashOf(const Eigen::Vector3f& point, double cell, unsigned seed)
{
  std::uint64_t hash = seed;
  for (int axis = 0; axis < 3; ++axis)
  {
    hash ^= static_cast<std::uint64_t>(static_cast<std::int64_t>(std::floor(point[axis] / cell)));
    hash = (hash ^ (hash >> 33)) * 0xff51afd7ed558ccdull;
    hash = (hash ^ (hash >> 33)) * 0xc4ceb9fe1a85ec53ull;
    hash ^= hash >> 33;
  }
  return hash;
}

/// Indices of `share` of the points, at least `least` where there are so many, ascending. Places are chosen, so the
/// order of the points has no part in it.
std::vector<int> chooseShare(const Points& points, double share, int least, double cell, unsigned seed)
{
  const int count = static_cast<int>(points.size());
  std::vector<int> indices(count);
  std::iota(indices.begin(), indices.end(), 0);
  const int wanted = std::min(count, std::max(least, static_cast<int>(std::ceil(share * count))));
  if (wanted < count)
  {
    std::vector<std::uint64_t> hashes;
    hashes.reserve(points.size());
    for (const auto& point : points)
    {
      hashes.push_back(hashOf(point, cell, seed));
    }
    std::nth_element(indices.begin(), indices.begin() + wanted, indices.end(),
      [&](int a, int b) { return hashes[a] != hashes[b] ? hashes[a] < hashes[b] : a < b; });
    indices.resize(wanted);
    std::sort(indices.begin(), indices.end());
  }
  return indices;
}

/// Votes of the scene's pairs, reference by reference.
class Voting
{
public:
  Voting(const TrainedModel& model, const PointCloud& referred, const PoseDetectionSettings& settings)
    : Model(model)
    , Blocks(referred.points, settings.threads)
    , Pairs(referred.subset(this->Blocks.order()), model.quantizer())
    , TurnsUsed(settings.signedTangents ? ~PairTurn{ 0 } : PairTurn{ TurnMask })
  {
    if (!settings.signedTangents)
    {
      const std::vector<std::uint32_t>& votes = model.table.votes;
      std::transform(votes.begin(), votes.end(), std::back_inserter(this->OwnVotes), withoutSense);
    }
  }

  /// All pairs of one reference point vote.
  void vote(const TangentFrame& reference, VoteAccumulator& accumulator) const
  {
    int keys[MostPairs];
    PairTurn turns[MostPairs];
    const std::vector<int> blocks = this->Blocks.within(reference.Origin, this->Model.diameter);
    const int most = MostPairs / BlockedPoints::Size;
    for (int begin = 0; begin < static_cast<int>(blocks.size()); begin += most)
    {
      const int count = std::min(most, static_cast<int>(blocks.size()) - begin);
      this->Pairs.compute(reference, blocks.data() + begin, count, keys, turns);
      this->cast(keys, turns, count * BlockedPoints::Size, accumulator);
    }
  }

private:
  static constexpr int MostPairs = 512; ///< whose keys are computed at once

  /// Votes of `count` pairs. Leaves in `keys` and `turns` what it pleases.
  void cast(int* keys, PairTurn* turns, int count, VoteAccumulator& accumulator) const
  {
    // Passes, so that what the next one reads is on its way: where buckets are, votes.
    const PairTable& table = this->Model.table;
    const std::uint32_t* offsets = table.offsets.data();
    const std::uint32_t* votes = this->OwnVotes.empty() ? table.votes.data() : this->OwnVotes.data();
    int pairs = 0;
    for (int k = 0; k < count; ++k)
    {
      __builtin_prefetch(offsets + std::max(keys[k], 0));
      keys[pairs] = keys[k];
      turns[pairs] = turns[k];
      pairs += keys[k] >= 0 ? 1 : 0;
    }
    VoteBucket buckets[MostPairs];
    int filled = 0;
    for (int k = 0; k < pairs; ++k)
    {
      buckets[filled] = { offsets[keys[k]], offsets[keys[k] + 1], turns[k] & this->TurnsUsed };
      __builtin_prefetch(votes + buckets[filled].begin);
      filled += buckets[filled].begin < buckets[filled].end ? 1 : 0;
    }
    accumulator.vote(votes, buckets, filled, table.mostOfOne);
  }

  const TrainedModel& Model;
  BlockedPoints Blocks;
  PairKeys Pairs;
  PairTurn TurnsUsed;                  ///< bits of a scene pair's turn
  std::vector<std::uint32_t> OwnVotes; ///< in place of the table's, when senses are ignored
};

/// The pose that lays the frame of the peak's model point on `scene`.
Pose poseOf(const VotePeak& peak, const TrainedModel& model, const TangentFrame& scene)
{
  const TangentFrame part(model.edges.points[peak.modelPoint], model.edges.tangents[peak.modelPoint]);
  Pose pose;
  pose.T_scene_model = alignFrames(part, scene, peak.flip, peak.alpha);
  pose.T_scene_model = nearestEqual(pose.T_scene_model, Eigen::Isometry3d::Identity(), model.symmetries);
  pose.votes = peak.votes;
  pose.viewId = __builtin_ctz(model.edgeViews[peak.modelPoint]);
  return pose;
}
}

PoseDetectionSettings paperDetectionSettings()
{
  PoseDetectionSettings settings;
  settings.referenceShare = 0.05;
  settings.referredShare = 0.2;
  return settings;
}

Poses detectPoses(const LocalCloud& sceneEdges, const TrainedModel& model, const PoseDetectionSettings& settings,
  const Progress& progress)
{
  requirePoints(sceneEdges.cloud.points, "The scene's edge cloud");
  if (sceneEdges.cloud.tangents.size() != sceneEdges.cloud.size())
  {
    throw Error("The scene's edge points have no tangents: estimate them before detection.");
  }
  PointCloud edges = finitePoints(sceneEdges.cloud);
  requireSameUnits(edges.points, model.diameter);
  const double referenceShare = settings.referenceShare > 0.0 ? settings.referenceShare
                                : sceneEdges.fromScan         ? settings.scanReferenceShare
                                                              : settings.boundaryReferenceShare;
  if (!(referenceShare > 0.0 && referenceShare <= 1.0) ||
      !(settings.referredShare > 0.0 && settings.referredShare <= 1.0))
  {
    throw Error("The shares of reference and referred points must be in (0, 1].");
  }
  if (settings.peaksPerReference < 1)
  {
    throw Error("At least one peak of each reference point is needed.");
  }
  const int least = sceneEdges.fromScan ? settings.leastScanReferences : settings.leastReferences;
  const double angleStep = model.settings.angleStep * M_PI / 180.0;
  for (Eigen::Vector3f& tangent : edges.tangents)
  {
    tangent = tangent.x() < 0.0f ? Eigen::Vector3f(-tangent) : tangent; // the sign is that of the first axis
  }
  const double cell = settings.choiceCell * model.diameter;
  std::vector<int> references;
  PointCloud referred;
  inParallel(settings.threads,
    { [&] { references = chooseShare(edges.points, referenceShare, least, cell, settings.seed); },
      [&]
      {
        referred = edges.subset(thinPoints(edges.points, model.votingLeaf()));
        referred = referred.subset(chooseShare(referred.points, settings.referredShare, 1, cell, settings.seed + 1));
      } });
  const Voting voting(model, referred, settings);

  const int threads = std::min(numberOfThreads(settings.threads), static_cast<int>(references.size()));
  std::vector<VoteAccumulator> accumulators(
    threads, VoteAccumulator(model.votingEdges, angleStep, settings.smoothPeaks));
  std::vector<Poses> found(references.size());
  parallelFor(static_cast<int>(references.size()), threads, progress,
    [&](int begin, int end, int thread)
    {
      VoteAccumulator& accumulator = accumulators[thread];
      for (int r = begin; r < end; ++r)
      {
        const TangentFrame scene(edges.points[references[r]], edges.tangents[references[r]]);
        accumulator.clear();
        voting.vote(scene, accumulator);
        for (const VotePeak& peak : accumulator.peaks(settings.peaksPerReference))
        {
          found[r].push_back(poseOf(peak, model, scene));
        }
      }
    });

  Poses poses;
  poses.reserve(found.size());
  for (const Poses& ofOne : found)
  {
    poses.insert(poses.end(), ofOne.begin(), ofOne.end());
  }
  report(progress, 1.0);
  return poses;
}
}
