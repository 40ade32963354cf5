// SPDX-License-Identifier: BSD-3-Clause
#include "pose/voting/PairVoting.h"

#include "base/Parallel.h"
#include "base/PointGrid.h"
#include "base/Range.h"
#include "base/sequences/Sequences.h"
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
/// Of the points of an edge cloud or a surface, how many are reference points where their share is not given.
struct References
{
  double ofCopy;    ///< edge points for each copy that the scene's edges would make
  int leastEdges;   ///< that a few copies are found by in a small scene
  double ofSurface; ///< share of the surface's thinned points
  int leastSurface;
};
constexpr References OfScan{ 40.0, 3000, 0.07, 300 };   // many edges are not the part's, some are displaced
constexpr References OfBoundary{ 10.0, 100, 0.01, 50 }; // exact edges tell most by themselves
constexpr double ChoiceCell = 0.01; // of the diameter: choices fall on cubes, so that the order of points has no part

const References& usualReferences(const LocalCloud& edges, const PoseDetectionSettings& settings)
{
  return edges.fromScan && settings.moreInScans ? OfScan : OfBoundary;
}

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

/// Indices of `share` of the points, at least `least` where there are so many, in the order in which they are chosen,
/// spread over the scene. Places are chosen, so the order of the points has no part in it.
std::vector<int> chooseInOrder(const Points& points, double share, int least, double cell, unsigned seed)
{
  const int count = static_cast<int>(points.size());
  std::vector<int> indices(count);
  std::iota(indices.begin(), indices.end(), 0);
  const int wanted = std::min(count, std::max(least, static_cast<int>(std::ceil(share * count))));
  const auto hashes = mapped<std::uint64_t>(points, [&](const auto& point) { return hashOf(point, cell, seed); });
  std::partial_sort(indices.begin(), indices.begin() + wanted, indices.end(),
    [&](int a, int b) { return hashes[a] != hashes[b] ? hashes[a] < hashes[b] : a < b; });
  indices.resize(wanted);
  return indices;
}

/// The same, ascending.
std::vector<int> chooseShare(const Points& points, double share, int least, double cell, unsigned seed)
{
  std::vector<int> indices = chooseInOrder(points, share, least, cell, seed);
  std::sort(indices.begin(), indices.end());
  return indices;
}

void requireSettings(const PoseDetectionSettings& settings)
{
  requireWithin("share of the reference points", settings.referenceShare, 0.0, 1.0);
  requirePositive("share of the referred points", settings.referredShare, 1.0);
  requireWithin("number of peaks of a reference point", settings.peaksPerReference, 1, Unbounded);
}

/// Points of the scene's surface, one in a cube, that have a normal.
DirectedPoints surfacePointsOf(const Scene& scene, double leaf, int threads)
{
  const Points& means = scene.depth.means();
  const std::vector<int> thinned = thinPoints(means, leaf);
  const Points normals = estimateNormals(means, scene.surface, thinned, scene.sensor, scene.partDiameter, threads);
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

/// How many copies would show so many thinned edge points, by what an appearance model has of the part's, thinned
/// alike.
double copiesOf(const DirectedPoints& thinned, const TrainedModel& model)
{
  std::size_t shown = 0;
  std::uint32_t views = 0;
  for (int k = 0; k < model.table.votingPoints; ++k)
  {
    shown += static_cast<std::size_t>(__builtin_popcount(model.edgeViews[k]));
    views |= model.edgeViews[k];
  }
  return shown > 0 ? static_cast<double>(thinned.points.size()) * __builtin_popcount(views) / static_cast<double>(shown)
                   : 0.0;
}

PairKeys keysOf(const DirectedPoints& points, const PairFeatureQuantizer& quantizer)
{
  return { points.points, points.directions, quantizer };
}

VotingRound surfaceRound(const Scene& scene, const TrainedModel& model, const PoseDetectionSettings& settings)
{
  DirectedPoints surface = surfacePointsOf(scene, model.settings.surface.leafSize * model.diameter, settings.threads);
  const References& usual = usualReferences(scene.edges, settings);
  const double share = settings.referenceShare > 0.0 ? settings.referenceShare : usual.ofSurface;
  std::vector<int> references =
    chooseInOrder(surface.points, share, usual.leastSurface, ChoiceCell * model.diameter, settings.seed + 2);
  const double longest = settings.longestBucket * model.surfaceTable.votingPoints;
  const std::size_t longestBucket =
    std::isfinite(longest) ? static_cast<std::size_t>(longest) : std::numeric_limits<std::size_t>::max();
  const PartPairs part{ model.surfacePairPoints.points, model.surfacePairPoints.normals, model.surfaceTable,
    model.surfaceQuantizer(), model.settings.surface.angleStep * M_PI / 180.0, model.diameter, longestBucket };
  DirectedPoints referred = surface;
  return { false, part, std::move(surface), std::move(references), std::move(referred) };
}
}

DirectedPoints DirectedPoints::subset(const std::vector<int>& indices) const
{
  DirectedPoints result;
  for (const int i : indices)
  {
    result.points.push_back(this->points[i]);
    result.directions.push_back(this->directions[i]);
  }
  return result;
}

VotingRound edgeRound(const LocalCloud& sceneEdges, const TrainedModel& model, const PoseDetectionSettings& settings)
{
  requirePoints(sceneEdges.cloud.points, "The scene's edge cloud");
  if (sceneEdges.cloud.tangents.size() != sceneEdges.cloud.size())
  {
    throw Error("The scene's edge points have no tangents: estimate them before detection.");
  }
  const PointCloud finite = finitePoints(sceneEdges.cloud);
  requireSameUnits(finite.points, model.diameter);
  requireSettings(settings);
  DirectedPoints edges{ finite.points, finite.tangents };
  for (Eigen::Vector3f& tangent : edges.directions)
  {
    tangent = tangent.x() < 0.0f ? Eigen::Vector3f(-tangent) : tangent; // the sign is that of the first axis
  }
  DirectedPoints referred = edges.subset(thinPoints(edges.points, model.votingLeaf()));
  const References& usual = usualReferences(sceneEdges, settings);
  const double needed = settings.referenceShare > 0.0 ? 0.0 : usual.ofCopy * copiesOf(referred, model);
  const int least =
    std::max(usual.leastEdges, static_cast<int>(std::min(std::ceil(needed), static_cast<double>(edges.points.size()))));
  const double cell = ChoiceCell * model.diameter;
  std::vector<int> references = chooseInOrder(edges.points, settings.referenceShare, least, cell, settings.seed);
  referred = referred.subset(chooseShare(referred.points, settings.referredShare, 1, cell, settings.seed + 1));
  const PartPairs part{ model.edges.points, model.edges.tangents, model.table, model.quantizer(),
    model.settings.angleStep * M_PI / 180.0, model.diameter, std::numeric_limits<std::size_t>::max() };
  return { true, part, std::move(edges), std::move(references), std::move(referred) };
}

std::vector<VotingRound> votingRounds(
  const Scene& scene, const TrainedModel& model, const PoseDetectionSettings& settings)
{
  requireSettings(settings);
  requireSameUnits(scene.edgePoints().points, model.diameter);
  const bool withEdges = hasEdges(settings.features) && hasEdges(model.settings.features);
  const bool haveSurface = hasSurface(settings.features) && hasSurface(model.settings.features);
  if (!withEdges && !haveSurface)
  {
    const bool holdsEdges = hasEdges(model.settings.features);
    throw Error("The model holds pairs of " + std::string(holdsEdges ? "edge" : "surface") +
                " points alone, and poses are looked for by " + (holdsEdges ? "surface" : "edge") +
                " points: train it with both, or look for them by both (Features: Both; the preset Paper takes edge "
                "points alone).");
  }
  const bool withSurface = haveSurface && scene.hasSurface();
  if (!withEdges && !withSurface)
  {
    throw Error("Poses are looked for by surface points alone, and the scene has no surface: give the points that the "
                "sensor measured, or a model of edge points, too (Features: Both).");
  }
  std::vector<VotingRound> rounds;
  if (withEdges)
  {
    rounds.push_back(edgeRound(scene.edges, model, settings));
  }
  if (withSurface)
  {
    rounds.push_back(surfaceRound(scene, model, settings));
  }
  return rounds;
}

PairVoting::PairVoting(const VotingRound& round, const PoseDetectionSettings& settings)
  : Part(round.part)
  , Blocks(round.referred.points, settings.threads)
  , Pairs(keysOf(round.referred.subset(this->Blocks.order()), round.part.quantizer))
  , TurnsUsed(settings.signedTangents ? ~PairTurn{ 0 } : PairTurn{ TurnMask })
{
  if (!settings.signedTangents)
  {
    const std::vector<std::uint32_t>& votes = round.part.table.votes;
    std::transform(votes.begin(), votes.end(), std::back_inserter(this->OwnVotes), withoutSense);
  }
}

void PairVoting::vote(const PairFrame& reference, VoteAccumulator& accumulator) const
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

void PairVoting::cast(int* keys, PairTurn* turns, int count, VoteAccumulator& accumulator) const
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
}
