// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/BlockedPoints.h"
#include "features/PairFeature.h"

#include <cstdint>

namespace meam
{
/// Angles about a direction as whole numbers: a full turn is 2^15, so sums wrap by a mask.
constexpr int TurnBits = 15; // of the 32 of an entry, which name the sheet of votes, too
constexpr std::uint32_t TurnMask = (1u << TurnBits) - 1;

/// How a referred point lies to a reference: its angle about the reference's direction in the low TurnBits bits, and
/// the bit above them when d runs against a tangent.
using PairTurn = std::uint32_t;

/// Votes that are computed at once.
constexpr int VoteBlock = 16; // of 32 bits, those of the widest register

/// Bits of an entry of the table that name the sheet of votes.
constexpr int SheetBits = 32 - TurnBits;
constexpr std::uint32_t SheetMask = (1u << SheetBits) - 1;

/// An entry of the table as voting reads it. In its upper TurnBits bits the turn which, added to that of a scene pair
/// along its tangent, gives alpha; below them the sheet of votes: 2 * reference, and one more when d runs against the
/// reference's tangent. `turn`: of the model's pair, only its angle.
constexpr std::uint32_t voteEntry(std::uint32_t reference, bool against, PairTurn turn)
{
  return ((against ? turn : 0u - turn) << SheetBits) | (2 * reference + (against ? 1u : 0u));
}

/// The entry as if d ran along the reference's tangent.
constexpr std::uint32_t withoutSense(std::uint32_t entry)
{
  const std::uint32_t sheet = entry & SheetMask, turn = entry >> SheetBits;
  return voteEntry(sheet / 2, false, sheet % 2 == 1 ? turn : 0u - turn);
}

/// Keys and turns of one reference point with many referred points, computed for several points at a time with the
/// widest vectors the processor has; the result is the same with all of them.
class PairKeys
{
public:
  /// Points with unit directions, in blocks of BlockedPoints::Size; `quantizer` cuts their features.
  PairKeys(const Points& referred, const Points& directions, const PairFeatureQuantizer& quantizer);

  /// For the referred points of `count` blocks, BlockedPoints::Size of each: the keys, -1 for a pair longer than d_max
  /// or without length and where the last block has no point; and the turns.
  void compute(const PairFrame& reference, const int* blocks, int count, int* keys, PairTurn* turns) const;

private:
  PairFeatureQuantizer Quantizer;
  SoAPoints Referred;
  SoAPoints Directions;
};
}
