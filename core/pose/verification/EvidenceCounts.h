// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

namespace meam
{
/// Of the diameter, the side of a square, as the sensor sees it, that counts once: neighbours tell the same.
inline constexpr double PatchSize = 0.1;
/// Of the diameter: the surface of a thinner sheet is like what it lies on.
inline constexpr double ThickSheet = 0.06;

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

/// What was counted of a pose. Poses are searched for by its sum: the logarithm of how much likelier it is with the
/// part there than with anything else, up to a common factor.
struct EvidenceCounts
{
  // Areas as the sensor sees them, in patches
  double there = 0.0, unclear = 0.0, turned = 0.0, past = 0.0, farPast = 0.0;
  double hidden = 0.0, enclosed = 0.0, unmeasured = 0.0;
  double inSight = 0.0; ///< of all that nothing hides, at the border of what is seen, too
  // Lengths of outline, in sides of a patch, beyond which the measured surface is farther away, or goes on as if it
  // were the part
  double ends = 0.0, goesOn = 0.0;
  // Edge points
  double edgesFound = 0.0, edgesMissing = 0.0;
  double edgesOfBin = 0.0; ///< found on lines that are longer than the part: they say nothing

  double ofSurface() const;
  double ofEdges(const EvidenceRates& rates) const;
  /// Of edges and outline together.
  double ofLines(const EvidenceRates& rates) const;
  /// All together.
  double sum(const EvidenceRates& rates) const;
};

/// A sum that beyond about `many` grows by its logarithm.
double logSaturated(double sum, double many);

/// The rates of a scan, from what was counted of its candidates, by expectation maximization: each tells how often
/// something is found where the part is as far as it is likely to be right, from the sum of its evidence by the rates
/// of the step before, and how often it is found anywhere as far as it is wrong. Here what the surface of a
/// sheet says for a candidate counts min(1, thickness / ThickSheet), `thickness` in diameters
/// (TrainedModel::sheetThickness), for it is like what it lies on.
EvidenceRates evidenceRates(const std::vector<EvidenceCounts>& candidates, double thickness);
}
