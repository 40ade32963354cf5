// SPDX-License-Identifier: BSD-3-Clause
#include "pose/voting/PoseDetection.h"

#include "base/BlockedPoints.h"
#include "base/Parallel.h"
#include "base/PointGrid.h"
#include "features/NormalEstimation.h"
#include "pose/voting/VoteAccumulator.h"
#include "scene/Units.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
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

/// Points with unit directions: edge points with tangents, or surface points with normals.
struct DirectedPoints
{
  Points points;
  Points directions;

  DirectedPoints subset(const std::vector<int>& indices) const
  {
    DirectedPoints result;
    for (const int i : indices)
    {
      result.points.push_back(this->points[i]);
      result.directions.push_back(this->directions[i]);
    }
    return result;
  }
};

/// The pairs of a part that a scene's pairs are looked up among.
struct PartPairs
{
  const Points& points;
  const Points& directions;
  const PairTable& table;
  PairFeatureQuantizer quantizer;
  double angleStep;          ///< of the votes' turn, radians
  double diameter;           ///< of the part, mm
  std::size_t longestBucket; ///< entries; a pair that fits more of the part's tells nothing
};

/// Votes of the scene's pairs, reference by reference.
class Voting
{
public:
  Voting(const PartPairs& part, const DirectedPoints& referred, const PoseDetectionSettings& settings)
    : Part(part)
    , Blocks(referred.points, settings.threads)
    , Pairs(keysOf(referred.subset(this->Blocks.order()), part.quantizer))
    , TurnsUsed(settings.signedTangents ? ~PairTurn{ 0 } : PairTurn{ TurnMask })
  {
    if (!settings.signedTangents)
    {
      const std::vector<std::uint32_t>& votes = part.table.votes;
      std::transform(votes.begin(), votes.end(), std::back_inserter(this->OwnVotes), withoutSense);
    }
  }

  /// All pairs of one reference point vote.
  void vote(const PairFrame& reference, VoteAccumulator& accumulator) const
  {
    int keys[MostPairs];
    PairTurn turns[MostPairs];
    const std::vector<int> blocks = this->Blocks.within(reference.Origin, this->Part.diameter);
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

  static PairKeys keysOf(const DirectedPoints& points, const PairFeatureQuantizer& quantizer)
  {
    return { points.points, points.directions, quantizer };
  }

  /// Votes of `count` pairs. Leaves in `keys` and `turns` what it pleases.
  void cast(int* keys, PairTurn* turns, int count, VoteAccumulator& accumulator) const
  {
    // Passes, so that what the next one reads is on its way: where buckets are, votes.
    const PairTable& table = this->Part.table;
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
      const std::size_t length = buckets[filled].end - buckets[filled].begin;
      filled += length > 0 && length <= this->Part.longestBucket ? 1 : 0;
    }
    accumulator.vote(votes, buckets, filled, table.mostOfOne);
  }

  const PartPairs& Part;
  BlockedPoints Blocks;
  PairKeys Pairs;
  PairTurn TurnsUsed;                  ///< bits of a scene pair's turn
  std::vector<std::uint32_t> OwnVotes; ///< in place of the table's, when senses are ignored
};

/// A pose by the vote of a reference point, and the part's point that it was taken for.
struct Candidate
{
  Pose pose;
  int modelPoint = -1;
};

/// One or more for each reference point that found pairs, in their order.
std::vector<Candidate> candidatesOf(const PartPairs& part, const DirectedPoints& references,
  const DirectedPoints& referred, const Symmetries& symmetries, const PoseDetectionSettings& settings,
  const Progress& progress)
{
  const int count = static_cast<int>(references.points.size());
  if (count == 0 || part.table.votingPoints == 0)
  {
    return {};
  }
  const Voting voting(part, referred, settings);
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
        const PairFrame scene(references.points[r], references.directions[r]);
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

void requireSettings(const PoseDetectionSettings& settings)
{
  const auto isShare = [](double share) { return share > 0.0 && share <= 1.0; };
  if (!(settings.referenceShare >= 0.0 && settings.referenceShare <= 1.0) || !isShare(settings.referredShare) ||
      !isShare(settings.boundaryReferenceShare) || !isShare(settings.scanReferenceShare) ||
      !isShare(settings.surfaceReferenceShare) || !isShare(settings.boundarySurfaceShare))
  {
    throw Error("The shares of reference and referred points must be in (0, 1].");
  }
  if (settings.peaksPerReference < 1)
  {
    throw Error("At least one peak of each reference point is needed.");
  }
}

/// Points of the scene's surface, one in a cube, that have a normal.
DirectedPoints surfacePointsOf(const Scene& scene, double leaf, const PoseDetectionSettings& settings)
{
  const Points& means = scene.depth.means();
  const std::vector<int> thinned = thinPoints(means, leaf);
  NormalEstimationSettings estimation = settings.normals;
  estimation.threads = settings.threads;
  const Points normals = estimateNormals(means, scene.surface, thinned, scene.sensor, scene.partDiameter, estimation);
  DirectedPoints result;
  for (std::size_t k = 0; k < thinned.size(); ++k)
  {
    if (!normals[k].isZero())
    {
      result.points.push_back(means[thinned[k]]);
      result.directions.push_back(normals[k]);
    }
  }
  return result;
}
}

PoseDetectionSettings paperDetectionSettings()
{
  PoseDetectionSettings settings;
  settings.referenceShare = 0.05;
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
  requirePoints(sceneEdges.cloud.points, "The scene's edge cloud");
  if (sceneEdges.cloud.tangents.size() != sceneEdges.cloud.size())
  {
    throw Error("The scene's edge points have no tangents: estimate them before detection.");
  }
  const PointCloud finite = finitePoints(sceneEdges.cloud);
  requireSameUnits(finite.points, model.diameter);
  requireSettings(settings);
  const double share = settings.referenceShare > 0.0 ? settings.referenceShare
                       : sceneEdges.fromScan         ? settings.scanReferenceShare
                                                     : settings.boundaryReferenceShare;
  const int least = sceneEdges.fromScan ? settings.leastScanReferences : settings.leastReferences;
  DirectedPoints edges{ finite.points, finite.tangents };
  for (Eigen::Vector3f& tangent : edges.directions)
  {
    tangent = tangent.x() < 0.0f ? Eigen::Vector3f(-tangent) : tangent; // the sign is that of the first axis
  }
  const double cell = settings.choiceCell * model.diameter;
  DirectedPoints references, referred;
  inParallel(settings.threads,
    { [&] { references = edges.subset(chooseShare(edges.points, share, least, cell, settings.seed)); },
      [&]
      {
        referred = edges.subset(thinPoints(edges.points, model.votingLeaf()));
        referred = referred.subset(chooseShare(referred.points, settings.referredShare, 1, cell, settings.seed + 1));
      } });
  const PartPairs part{ model.edges.points, model.edges.tangents, model.table, model.quantizer(),
    model.settings.angleStep * M_PI / 180.0, model.diameter, std::numeric_limits<std::size_t>::max() };
  Poses poses;
  for (const Candidate& candidate : candidatesOf(part, references, referred, model.symmetries, settings, progress))
  {
    poses.push_back(candidate.pose);
    poses.back().viewId = __builtin_ctz(model.edgeViews[candidate.modelPoint]);
  }
  report(progress, 1.0);
  return poses;
}

Poses detectPoses(
  const Scene& scene, const TrainedModel& model, const PoseDetectionSettings& settings, const Progress& progress)
{
  requireSettings(settings);
  requireSameUnits(scene.edgePoints().points, model.diameter);
  const bool withEdges = hasEdges(settings.features) && hasEdges(model.settings.features);
  const bool haveSurface = hasSurface(settings.features) && hasSurface(model.settings.features);
  if (!withEdges && !haveSurface)
  {
    const bool holdsEdges = hasEdges(model.settings.features);
    throw Error(
      "The model holds pairs of " + std::string(holdsEdges ? "edge" : "surface") +
      " points alone, and poses are looked for by " + (holdsEdges ? "surface" : "edge") +
      " points: train it with Features set to Both, or set Features to Both here (the preset Paper takes edge "
      "points alone).");
  }
  const bool withSurface = haveSurface && scene.hasSurface();
  if (!withEdges && !withSurface)
  {
    throw Error("Poses are looked for by surface points alone, and the scene has no surface: give the points that the "
                "sensor measured, or a model of edge points, too, with Features set to Both.");
  }
  Poses poses;
  if (withEdges)
  {
    poses = detectPoses(scene.edges, model, settings, subProgress(progress, 0.0, withSurface ? 0.6 : 1.0));
  }
  if (withSurface)
  {
    const DirectedPoints surface = surfacePointsOf(scene, model.settings.surface.leafSize * model.diameter, settings);
    const bool isScan = scene.edges.fromScan;
    const double share = settings.referenceShare > 0.0 ? settings.referenceShare
                         : isScan                      ? settings.surfaceReferenceShare
                                                       : settings.boundarySurfaceShare;
    const int least = isScan ? settings.leastSurfaceReferences : settings.leastBoundarySurface;
    const DirectedPoints references = surface.subset(
      chooseShare(surface.points, share, least, settings.choiceCell * model.diameter, settings.seed + 2));
    const double longest = settings.longestBucket * model.surfaceTable.votingPoints;
    const std::size_t longestBucket =
      std::isfinite(longest) ? static_cast<std::size_t>(longest) : std::numeric_limits<std::size_t>::max();
    const PartPairs part{ model.surfacePairPoints.points, model.surfacePairPoints.normals, model.surfaceTable,
      model.surfaceQuantizer(), model.settings.surface.angleStep * M_PI / 180.0, model.diameter, longestBucket };
    for (const Candidate& candidate :
      candidatesOf(part, references, surface, model.symmetries, settings, subProgress(progress, 0.6, 1.0)))
    {
      poses.push_back(candidate.pose);
      poses.back().viewId = model.visibility->view(candidate.pose.T_scene_model, scene.sensor);
    }
  }
  report(progress, 1.0);
  return poses;
}
}
