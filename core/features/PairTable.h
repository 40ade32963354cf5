// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "features/PairFeature.h"
#include "features/PairKeys.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace meam
{
/// A pair of a part's points under the key of its feature.
struct PairEntry
{
  std::uint32_t key;
  std::uint32_t reference; ///< index of the reference point
  std::uint32_t referred;  ///< index of the referred point
  float angle;             ///< of the referred point about the reference's direction, radians
  std::uint32_t viewBits;  ///< bit v: both points are seen in view v
};

/// All pairs of a part's points with directions, sorted by the key of their feature. Bucket k is the entries
/// [offsets[k], offsets[k + 1]).
struct PairTable
{
  std::vector<std::uint32_t> offsets;
  std::vector<std::uint32_t> references; ///< index of the reference point
  std::vector<std::uint32_t> referreds;  ///< index of the referred point
  std::vector<float> angles;             ///< of the referred point about the reference's direction, radians
  std::vector<std::uint32_t> viewBits;   ///< bit v: both points are on the edge seen in view v

  // As voting reads it, made by deriveVotes():
  std::vector<std::uint32_t> votes; ///< voteEntry of each; VoteBlock zeros follow the last
  int mostOfOne = 1;                ///< entries of one reference point in a bucket
  int votingPoints = 0;             ///< so many of the points make pairs

  std::size_t size() const { return this->references.size(); }
  std::size_t bytes() const { return (this->offsets.size() + 4 * this->size()) * sizeof(std::uint32_t); }

  /// Makes what voting looks up and what files do not hold. `points` and `directions` are those of the pairs.
  void deriveVotes(const Points& points, const Points& directions, PairFeatureKind kind);
};

/// The table of pairs in the order in which they come, those of a key together.
PairTable makePairTable(const std::vector<PairEntry>& entries, std::int64_t numberOfKeys);
}
