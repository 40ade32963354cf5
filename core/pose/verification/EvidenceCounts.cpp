// SPDX-License-Identifier: BSD-3-Clause
#include "pose/verification/EvidenceCounts.h"

#include "pose/verification/ProbabilityCalibration.h"

#include <algorithm>
#include <cmath>

namespace meam
{
namespace
{
// Weights of a patch of surface
constexpr double There = 1.0;       // where it should be, that faces the right way
constexpr double Unclear = 0.3;     // where it should be, with too little around it to tell which way it faces
constexpr double Turned = -0.5;     // where it should be, that faces elsewhere: another object's
constexpr double Past = -2.5;       // that the sensor looked past, at something near behind it
constexpr double FarPast = -8.0;    // and at something far behind it
constexpr double Hidden = -0.1;     // with something before it: beyond so many patches
constexpr double ManyHidden = 5.0;  // by its logarithm, for one thing hides many
constexpr double Enclosed = -6.0;   // of the part's body behind the bin's floor or a wall, seen or not
constexpr double Unmeasured = -0.1; // where nothing was measured (gaps of one cell of the depth map aside), or only
                                    // the part's own lower side beside it
// Of the logarithms that the scan's own rates say
constexpr double Outline = 0.7;    // of a patch's side of outline
constexpr double Edge = 0.1;       // of one edge point
constexpr double ManyLines = 16.0; // both together, for they tell much the same, grow beyond this by their logarithm

// Of the scan's own rates
constexpr double UsualEdges = 150.0;  // edge points that the usual rates count as: few candidates tell nothing
constexpr double UsualOutline = 90.0; // the same in sides of patches
constexpr int Steps = 4;              // of how likely the candidates are, and what that says of edges and outlines
constexpr double LeastGain = 0.02;    // that something is found more often where the part is
constexpr double LeastEnds = 0.75;    // of a part's outline end: there may be none of the part

}

double logSaturated(double sum, double many) { return std::copysign(many * std::log1p(std::abs(sum) / many), sum); }

double EvidenceRate::logOf(double foundTimes, double missingTimes) const
{
  return foundTimes * std::log(this->found / this->chance) +
         missingTimes * std::log((1.0 - this->found) / (1.0 - this->chance));
}

double EvidenceCounts::ofSurface() const
{
  return There * this->there + Unclear * this->unclear + Turned * this->turned + Past * this->past +
         FarPast * this->farPast + Hidden * logSaturated(this->hidden, ManyHidden) + Enclosed * this->enclosed +
         Unmeasured * this->unmeasured;
}

double EvidenceCounts::ofEdges(const EvidenceRates& rates) const
{
  return Edge * rates.edges.logOf(this->edgesFound, this->edgesMissing);
}

double EvidenceCounts::ofLines(const EvidenceRates& rates) const
{
  return logSaturated(this->ofEdges(rates) + Outline * rates.outline.logOf(this->ends, this->goesOn), ManyLines);
}

double EvidenceCounts::sum(const EvidenceRates& rates) const { return this->ofSurface() + this->ofLines(rates); }

EvidenceRates evidenceRates(const std::vector<EvidenceCounts>& candidates, double thickness)
{
  const double ofSheet = std::min(thickness / ThickSheet, 1.0);
  using Count = double EvidenceCounts::*;
  std::vector<double> right(candidates.size()); // probabilities
  const auto rateOf = [&](Count found, Count missing, const EvidenceRate& usual, double usualCount, double leastFound)
  {
    double rightFound = usualCount * usual.found, ofRight = usualCount;
    double wrongFound = usualCount * usual.chance, ofWrong = usualCount;
    for (std::size_t k = 0; k < candidates.size(); ++k)
    {
      const double foundTimes = candidates[k].*found, all = foundTimes + candidates[k].*missing;
      rightFound += right[k] * foundTimes;
      ofRight += right[k] * all;
      wrongFound += (1.0 - right[k]) * foundTimes;
      ofWrong += (1.0 - right[k]) * all;
    }
    const double chance = std::min(wrongFound / ofWrong, 1.0 - 2.0 * LeastGain);
    return EvidenceRate{ std::clamp(rightFound / ofRight, std::max(leastFound, chance + LeastGain), 1.0 - LeastGain),
      chance };
  };
  const EvidenceRates usual;
  EvidenceRates rates;
  for (int step = 0; step < Steps; ++step)
  {
    std::transform(candidates.begin(), candidates.end(), right.begin(),
      [&](const EvidenceCounts& counts)
      {
        const double surface = counts.ofSurface();
        return probabilityOf(
          CalibrationWithSurface.logOdds((surface > 0.0 ? ofSheet * surface : surface) + counts.ofLines(rates)));
      });
    rates.edges = rateOf(&EvidenceCounts::edgesFound, &EvidenceCounts::edgesMissing, usual.edges, UsualEdges, 0.0);
    rates.outline = rateOf(&EvidenceCounts::ends, &EvidenceCounts::goesOn, usual.outline, UsualOutline, LeastEnds);
  }
  return rates;
}
}
