// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/BlockedPoints.h"
#include "features/PairKeys.h"
#include "features/PairTable.h"
#include "pose/voting/PoseDetection.h"

#include <vector>

namespace meam
{
class VoteAccumulator;

/// Points with unit directions: edge points with tangents, or surface points with normals.
struct DirectedPoints
{
  Points points;
  Points directions;

  DirectedPoints subset(const std::vector<int>& indices) const;
};

/// The pairs of a part that a scene's pairs are looked up among. Refers to the trained model.
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

/// Who votes in a scene, and for what. Refers to the trained model.
struct VotingRound
{
  bool byEdges;
  PartPairs part;
  DirectedPoints points;       ///< all that can be reference points, local frame
  std::vector<int> references; ///< those of them that are, spread over the scene: as good as any for the first
  DirectedPoints referred;
};

/// The round of a scene's edge points with tangents. Throws Error for settings out of range, and when the scene is
/// empty, has no tangents, or is in another unit than the model.
VotingRound edgeRound(const LocalCloud& edges, const TrainedModel& model, const PoseDetectionSettings& settings);

/// The round of a scene's edge points, and that of its surface, as far as the model holds pairs of both. Throws Error
/// for the same reasons, and for a model of surface points alone when the scene has no surface.
std::vector<VotingRound> votingRounds(
  const Scene& scene, const TrainedModel& model, const PoseDetectionSettings& settings);

/// Votes of a scene's pairs, reference by reference. Keeps a reference to the round; calls may run in parallel.
class PairVoting
{
public:
  PairVoting(const VotingRound& round, const PoseDetectionSettings& settings);

  /// All pairs of one reference point vote.
  void vote(const PairFrame& reference, VoteAccumulator& accumulator) const;

private:
  static constexpr int MostPairs = 512; ///< whose keys are computed at once

  /// Votes of `count` pairs. Leaves in `keys` and `turns` what it pleases.
  void cast(int* keys, PairTurn* turns, int count, VoteAccumulator& accumulator) const;

  const PartPairs& Part;
  BlockedPoints Blocks;
  PairKeys Pairs;
  PairTurn TurnsUsed;                  ///< bits of a scene pair's turn
  std::vector<std::uint32_t> OwnVotes; ///< in place of the table's, when senses are ignored
};
}
