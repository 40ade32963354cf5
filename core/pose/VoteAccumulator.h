// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "model/PairKeys.h"

#include <cstdint>
#include <vector>

namespace meam
{
/// A peak among the votes of one scene reference point.
struct VotePeak
{
  int votes = 0; ///< of the bin and its two neighbours
  int modelPoint = -1;
  bool flip = false;  ///< the stored tangents run against each other
  double alpha = 0.0; ///< radians
};

/// Votes of one reference point in the space (m_r, flip, alpha), paper Section 5.1. A tangent has no sign; the sign of
/// d along it decides whether the stored tangents agree (alpha = beta_s - beta_m) or not (alpha = beta_s + beta_m).
class VoteAccumulator
{
public:
  /// `angleStep`: of alpha, radians.
  VoteAccumulator(int modelPoints, double angleStep);

  void clear();

  /// The entries [entry, end) of one bucket (PairTable::votes) vote for a scene pair with this turn.
  void vote(const std::uint32_t* entry, const std::uint32_t* end, PairTurn sceneTurn)
  {
    const std::uint32_t sceneAgainst = sceneTurn >> TurnBits;
    for (; entry != end; ++entry)
    {
      const std::uint32_t flip = ((*entry >> TurnBits) & 1u) ^ sceneAgainst;
      const std::uint32_t sign = 0u - (flip ^ 1u); // all ones for a difference
      const std::uint32_t turn = (sceneTurn + ((*entry ^ sign) - sign)) & TurnMask;
      const std::uint32_t bin = (turn * this->Turns) >> TurnBits;
      std::uint16_t& count = this->Counts[((*entry >> (TurnBits + 1)) * 2 + flip) * this->Stride + 1 + bin];
      count = static_cast<std::uint16_t>(count + (count < MostVotes ? 1 : 0));
    }
  }

  /// The best supported turns, summed over three neighbouring bins, each at another model point or flip; best
  /// first, of equals the first. Without votes none.
  std::vector<VotePeak> peaks(int count);

private:
  static constexpr int MostVotes = 21845; // of a bin: three fit into 16 bits

  std::uint32_t Turns;
  std::uint32_t Stride; ///< the bins of a sheet between copies of the last and the first
  std::vector<std::uint16_t> Counts;
  std::vector<std::uint16_t> Maxima; ///< of each sheet
};
}
