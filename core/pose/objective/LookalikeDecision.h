// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

namespace meam
{
/// What contradicts a pose that all else speaks for: a part that looks alike, longer, shorter or mirrored, fits as well
/// but there. In patches.
struct Contradictions
{
  double continuing = 0.0; ///< measured surface that goes on smoothly and is explained by no pose (SurfaceContinuation)
  double past = 0.0;       ///< predicted surface that the sensor saw past

  /// Logarithm of how much likelier they are of the part than of one that looks alike.
  double logRatio() const;
};

/// Of poses, how likely each is of the part and not of one that looks alike, [0, 1]. How many of the poses are, is
/// decided by the scan, by expectation maximization: where most of what is in full sight contradicts the poses there,
/// what is half hidden is none of the part either. `weights`: [0, 1], how likely something is there at all.
std::vector<double> sharesOfPart(const std::vector<Contradictions>& poses, const std::vector<double>& weights);
}
