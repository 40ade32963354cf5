// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "pose/verification/ProbabilityCalibration.h"

#include <vector>

namespace meam
{
/// What each kind of measurement says for a pose: the logarithm of how much likelier it is with the part there than
/// with anything else, up to a common factor. Neighbours tell the same: what counts is how many patches they fill.
struct EvidenceWeights
{
  double patch = 0.1;       ///< of the diameter, the side of a square, as the sensor sees it, that counts once
  double there = 1.0;       ///< a patch of surface where it should be, that faces the right way
  double unclear = 0.3;     ///< where it should be, with too little around it to tell which way it faces
  double turned = -0.5;     ///< where it should be, that faces elsewhere
  double past = -2.5;       ///< that the sensor looked past, at something near behind it
  double farPast = -8.0;    ///< and at something far behind it
  double hidden = -0.1;     ///< with something before it: beyond manyHidden by its logarithm, for one thing hides many
  double manyHidden = 5.0;  ///< patches
  double enclosed = -6.0;   ///< of the part's body behind the bin's floor or a wall, seen or not
  double unmeasured = -0.1; ///< where nothing was measured (gaps of one cell of the depth map aside), or only the
                            ///< part's own lower side beside it
  // Of the logarithms that the scan's own rates say (EvidenceRates):
  double outline = 0.7; ///< of a patch's side of outline
  double edge = 0.1;    ///< of one edge point
  /// What edges and outline say together, for they tell much the same, grows beyond this by its logarithm.
  double manyLines = 16.0;
};

/// How often something that a pose predicts is found in this scan.
struct EvidenceRate
{
  double found;  ///< where the part is
  double chance; ///< anywhere

  /// What finding it `found` times and missing it `missing` times says.
  double logOf(double found, double missing) const;
};

/// Of glossy parts, or of parts on parts of the same colour, few edges are found; where a sensor smooths the depth, or
/// parts lie on each other, few outlines end.
struct EvidenceRates
{
  EvidenceRate edges{ 0.75, 0.3 };   ///< of an edge point, an edge
  EvidenceRate outline{ 0.9, 0.55 }; ///< of a patch's side of outline, that the measured surface ends there
};

/// What was counted of a pose.
struct EvidenceCounts
{
  // Areas as the sensor sees them, in patches
  double there = 0.0, unclear = 0.0, turned = 0.0, past = 0.0, farPast = 0.0;
  double hidden = 0.0, enclosed = 0.0, unmeasured = 0.0;
  // Lengths of outline, in sides of a patch, beyond which the measured surface is farther away, or goes on as if it
  // were the part
  double ends = 0.0, goesOn = 0.0;
  // Edge points
  double edgesFound = 0.0, edgesMissing = 0.0;
  double edgesOfBin = 0.0; ///< found on lines that are longer than the part: they say nothing

  /// What the surface says.
  double ofSurface(const EvidenceWeights& weights) const;
  /// What the edges say.
  double ofEdges(const EvidenceWeights& weights, const EvidenceRates& rates) const;
  /// What edges and outline say together.
  double ofLines(const EvidenceWeights& weights, const EvidenceRates& rates) const;
  /// All together.
  double sum(const EvidenceWeights& weights, const EvidenceRates& rates) const;
};

struct EvidenceRatesSettings
{
  EvidenceRates usual;
  double usualEdges = 150.0;  ///< so many edge points the usual rates count: of few candidates nothing can be told
  double usualOutline = 90.0; ///< the same in sides of patches
  int steps = 4;              ///< of how likely the candidates are, and what that says of edges and outlines
  double leastGain = 0.02;    ///< that something is found more often where the part is
  double leastEnds = 0.75;    ///< of a part's outline end, whatever the candidates say: there may be none of the part
};

/// The rates of a scan, from what was counted of its candidates, by expectation maximization: each tells how often
/// something is found where the part is as far as it is `likely` to be right, from the sum of its evidence by the rates
/// of the step before, and how often it is found anywhere as far as it is wrong.
EvidenceRates evidenceRates(const std::vector<EvidenceCounts>& candidates, const EvidenceWeights& weights,
  const LogisticRegression& likely, const EvidenceRatesSettings& settings = {});
}
