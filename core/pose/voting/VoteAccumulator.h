// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "features/PairKeys.h"

#include <cstdint>
#include <vector>

namespace meam
{
/// A peak among the votes of one scene reference point.
struct VotePeak
{
  int votes = 0; ///< of the bin, and of its two neighbours where they count
  int modelPoint = -1;
  bool flip = false;  ///< the stored tangents run against each other
  double alpha = 0.0; ///< radians
};

/// What one scene pair votes for: the entries [begin, end) of PairTable::votes.
struct VoteBucket
{
  std::uint32_t begin;
  std::uint32_t end;
  PairTurn turn; ///< of the scene pair
};

/// A number for each of some sheets of the accumulator; a model point has two sheets, one for each flip.
struct alignas(32) SheetGroup
{
  static constexpr int Sheets = 16;       ///< of 16 bits, as many as a vector register holds
  static constexpr int MostVotes = 21845; ///< of a bin: three fit into 16 bits
  std::uint16_t of[Sheets] = {};
};
static_assert(
  sizeof(SheetGroup) == SheetGroup::Sheets * sizeof(std::uint16_t), "groups follow each other without gaps");

/// Votes of one reference point in the space (m_r, flip, alpha), paper Section 5.1. A tangent has no sign; the sign of
/// d along it decides whether the stored tangents agree (alpha = beta_s - beta_m) or not (alpha = beta_s + beta_m).
class VoteAccumulator
{
public:
  /// `angleStep`: of alpha, radians. `smooth`: peaks are of sums of three neighbouring bins, else of single ones.
  VoteAccumulator(int modelPoints, double angleStep, bool smooth = true);

  void clear();

  /// The scene pairs of `buckets` vote for entries of the table. A model point has at most `mostOfOne` in a bucket.
  /// VoteBlock words after the last entry are read.
  void vote(const std::uint32_t* entries, const VoteBucket* buckets, int count, int mostOfOne = 1);

  /// The best supported turns, each at another model point or flip; best first, of equals the first. Without votes
  /// none.
  std::vector<VotePeak> peaks(int count);

  /// Votes for a turn of a model point (radians): of its bin, and of the two beside it where they count.
  int votesFor(int modelPoint, bool flip, double alpha) const;

private:
  int Turns; ///< bins of a sheet
  bool Smooth;
  std::int64_t Cast = 0;           ///< no bin has more votes
  std::vector<SheetGroup> Largest; ///< peak of each sheet
  std::vector<SheetGroup> Counts;  ///< group by group, and in each group bin by bin
};
}
