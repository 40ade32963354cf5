// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "pose/verification/EvidenceCounts.h"

#include <vector>

namespace meam
{
/// One kind of what was counted, and what it adds to the logarithm of the odds that a copy is there.
struct EvidenceTerm
{
  const char* what; ///< "visible surface"
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
  double searched = 0.0;           ///< log odds that the pose was searched for by,
  double shareOfSearch = 0.0;      ///< [0, 1], and how much of the sum they are: much where a scan shows few edges
  /// Of all; what more than nothing the terms leave grows by its logarithm.
  double sum() const;
};

/// By surface and edges. `searched`: log odds that the pose was searched for by; `thickness`: in
/// diameters, of a sheet (TrainedModel::sheetThickness).
PlaceOdds placeOdds(const EvidenceCounts& counts, const EvidenceRates& rates, double searched, double thickness);

/// By edges alone, which cannot tell how many are found in this scan.
PlaceOdds placeOddsOfEdges(const EvidenceCounts& counts);
}
