// SPDX-License-Identifier: BSD-3-Clause
#include "pose/PoseDetection.h"

#include "Parallel.h"
#include "PointGrid.h"
#include "Random.h"
#include "pose/VoteAccumulator.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace meam
{
namespace
{
constexpr int LeastReferences = 50;     // that a few copies are found by in a small scene
constexpr int BlockSize = 512;          // pairs whose keys are computed at once
constexpr double CellShare = 0.25;       // of the diameter

/// `share` of the numbers below `count`, at least `least` where there are so many, chosen by `seed`, ascending.
std::vector<int> chooseShare(int count, double share, int least, unsigned seed)
{
  std::vector<int> indices(count);
  std::iota(indices.begin(), indices.end(), 0);
  const int wanted = std::min(count, std::max(least, static_cast<int>(std::ceil(share * count))));
  if (wanted < count)
  {
    Random random(seed);
    for (int i = 0; i < wanted; ++i)
    {
      std::swap(indices[i], indices[i + random.index(count - i)]);
    }
    indices.resize(wanted);
    std::sort(indices.begin(), indices.end());
  }
  return indices;
}

/// Votes of the scene's pairs, reference by reference.
class Voting
{
public:
  Voting(const TrainedModel& model, const PointCloud& referred)
    : Model(model)
    , Grid(referred.points, CellShare * model.diameter)
    , Pairs(referred.subset(this->Grid.order()), model.quantizer())
  {
  }

  /// All pairs of one reference point vote.
  void vote(const TangentFrame& reference, VoteAccumulator& accumulator) const
  {
    this->Grid.forEachRange(reference.Origin, this->Model.diameter,
      [&](int begin, int end)
      {
        for (; begin < end; begin += BlockSize)
        {
          this->voteBlock(reference, begin, std::min(end, begin + BlockSize), accumulator);
        }
      });
  }

private:
  void voteBlock(const TangentFrame& reference, int begin, int end, VoteAccumulator& accumulator) const
  {
    // Three passes, so that what the next one reads is on its way: keys, where their buckets are, votes.
    int keys[BlockSize];
    PairTurn turns[BlockSize];
    this->Pairs.compute(reference, begin, end, keys, turns);
    const PairTable& table = this->Model.table;
    const std::uint32_t* starts = table.voteStarts.data();
    int pairs = 0;
    for (int k = 0; k < end - begin; ++k)
    {
      keys[pairs] = keys[k];
      turns[pairs] = turns[k];
      pairs += keys[k] >= 0 ? 1 : 0;
    }
    for (int k = 0; k < pairs; ++k)
    {
      __builtin_prefetch(starts + 2 * keys[k]);
    }
    VoteBucket buckets[BlockSize];
    int filled = 0;
    for (int k = 0; k < pairs; ++k)
    {
      const std::uint32_t* bucket = starts + 2 * keys[k];
      buckets[filled] = { bucket[0], bucket[1], bucket[2], turns[k] };
      __builtin_prefetch(table.votes.data() + buckets[filled].begin);
      filled += buckets[filled].begin < buckets[filled].end ? 1 : 0;
    }
    accumulator.vote(table.votes.data(), buckets, filled, table.mostOfOne);
  }

  const TrainedModel& Model;
  PointGrid Grid;
  PairKeys Pairs;
};
}

PoseDetectionSettings paperDetectionSettings()
{
  PoseDetectionSettings settings;
  settings.referenceShare = 0.05;
  settings.referredShare = 0.2;
  return settings;
}

Poses detectPoses(const PointCloud& edges, const TrainedModel& model, const PoseDetectionSettings& settings,
  const Progress& progress)
{
  requirePoints(edges.points, "The scene's edge cloud");
  if (edges.tangents.size() != edges.size())
  {
    throw Error("The scene's edge points have no tangents: estimate them before detection.");
  }
  requireSameUnits(edges.points, model.diameter);
  if (!(settings.referenceShare > 0.0 && settings.referenceShare <= 1.0) ||
    !(settings.referredShare > 0.0 && settings.referredShare <= 1.0))
  {
    throw Error("The shares of reference and referred points must be in (0, 1].");
  }
  if (settings.peaksPerReference < 1)
  {
    throw Error("At least one peak of each reference point is needed.");
  }
  const int modelPoints = static_cast<int>(model.edges.size());
  const double angleStep = model.settings.angleStep * M_PI / 180.0;
  const int count = static_cast<int>(edges.size());
  const std::vector<int> references = chooseShare(count, settings.referenceShare, LeastReferences, settings.seed);
  const Voting voting(model, edges.subset(chooseShare(count, settings.referredShare, 1, settings.seed + 1)));

  const int threads = std::min(numberOfThreads(settings.threads), static_cast<int>(references.size()));
  std::vector<VoteAccumulator> accumulators(threads, VoteAccumulator(modelPoints, angleStep));
  std::vector<std::vector<VotePeak>> peaks(references.size());
  parallelFor(static_cast<int>(references.size()), threads, progress,
    [&](int begin, int end, int thread)
    {
      VoteAccumulator& accumulator = accumulators[thread];
      for (int r = begin; r < end; ++r)
      {
        accumulator.clear();
        voting.vote(TangentFrame(edges.points[references[r]], edges.tangents[references[r]]), accumulator);
        peaks[r] = accumulator.peaks(settings.peaksPerReference);
      }
    });

  Poses poses;
  for (std::size_t r = 0; r < peaks.size(); ++r)
  {
    const TangentFrame scene(edges.points[references[r]], edges.tangents[references[r]]);
    for (const VotePeak& peak : peaks[r])
    {
      Pose pose;
      pose.T_scene_model =
        alignFrames(TangentFrame(model.edges.points[peak.modelPoint], model.edges.tangents[peak.modelPoint]), scene,
          peak.flip, peak.alpha);
      pose.T_scene_model = nearestEqual(pose.T_scene_model, Eigen::Isometry3d::Identity(), model.symmetries);
      pose.votes = peak.votes;
      pose.viewId = __builtin_ctz(model.edgeViews[peak.modelPoint]);
      poses.push_back(pose);
    }
  }
  report(progress, 1.0);
  return poses;
}
}
