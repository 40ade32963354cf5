// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "model/PairFeature.h"

#include <cstdint>
#include <vector>

namespace meam
{
/// Angles about a tangent as whole numbers: a full turn is 2^15, so sums wrap by a mask.
constexpr int TurnBits = 15;
constexpr std::uint32_t TurnMask = (1u << TurnBits) - 1;

/// How a referred point lies to a reference: its angle about the reference's tangent in the low TurnBits bits, and
/// the bit above them when d runs against that tangent.
using PairTurn = std::uint32_t;

/// Votes that are computed at once.
constexpr int VoteBlock = 16;

/// Keys and turns of one reference point with many referred points, computed for several points at a time with the
/// widest vectors the processor has; the result is the same with all of them.
class PairKeys
{
public:
  /// Points with tangents; `quantizer` cuts their features.
  PairKeys(const PointCloud& referred, const PairFeatureQuantizer& quantizer);

    /// For the referred points [begin, end): `keys[k]` of the pair with point begin + k, -1 for a pair longer than d_max
  /// or without length; `turns[k]` likewise.
  void compute(const TangentFrame& reference, int begin, int end, int* keys, PairTurn* turns) const;

private:
  PairFeatureQuantizer Quantizer;
  std::vector<float> X, Y, Z, TangentX, TangentY, TangentZ; ///< and room at the end
};
}
