// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "pose/verification/EvidenceCounts.h"

#include <vector>

namespace meam
{
/// One kind of what was counted, and what it adds to the logarithm of the odds that a copy is there.
struct EvidenceTerm
{
  const char* what; ///< "surface where it should be"
  const char* unit; ///< "patches"
  double amount;
  double adds;
};

/// How likely a copy is where this was counted at a final pose, as logarithms of odds. Poses are searched for by
/// EvidenceCounts::sum, in which each point counts; what is said of them is this: points beside each other tell the
/// same, so that edges and outlines count by their shares, and edges by how many of a part's are found in this scan.
struct PlaceOdds
{
  double before = 0.0;             ///< log odds without any term
  std::vector<EvidenceTerm> terms; ///< all kinds that add something
  /// Of both; where more than nothing is left it grows by its logarithm.
  double sum() const;
};

/// Without surfaces edges are all that counts: by the usual rates, for alone they cannot tell this scan's.
PlaceOdds placeOdds(const EvidenceCounts& counts, const EvidenceRates& rates, bool haveSurfaces);
}
