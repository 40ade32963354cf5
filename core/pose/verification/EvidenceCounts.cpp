// SPDX-License-Identifier: BSD-3-Clause
#include "pose/verification/EvidenceCounts.h"

#include <algorithm>
#include <cmath>

namespace meam
{
namespace
{
/// A sum that beyond about `many` grows by its logarithm.
double saturated(double sum, double many) { return std::copysign(many * std::log1p(std::abs(sum) / many), sum); }
}

double EvidenceRate::logOf(double foundTimes, double missingTimes) const
{
  return foundTimes * std::log(this->found / this->chance) +
         missingTimes * std::log((1.0 - this->found) / (1.0 - this->chance));
}

double EvidenceCounts::ofSurface(const EvidenceWeights& weights) const
{
  return weights.there * this->there + weights.unclear * this->unclear + weights.turned * this->turned +
         weights.past * this->past + weights.farPast * this->farPast +
         weights.hidden * saturated(this->hidden, weights.manyHidden) + weights.enclosed * this->enclosed +
         weights.unmeasured * this->unmeasured;
}

double EvidenceCounts::ofEdges(const EvidenceWeights& weights, const EvidenceRates& rates) const
{
  return weights.edge * rates.edges.logOf(this->edgesFound, this->edgesMissing);
}

double EvidenceCounts::ofLines(const EvidenceWeights& weights, const EvidenceRates& rates) const
{
  const double all = this->ofEdges(weights, rates) + weights.outline * rates.outline.logOf(this->ends, this->goesOn);
  return saturated(all, weights.manyLines);
}

double EvidenceCounts::sum(const EvidenceWeights& weights, const EvidenceRates& rates) const
{
  return this->ofSurface(weights) + this->ofLines(weights, rates);
}

EvidenceRates evidenceRates(const std::vector<EvidenceCounts>& candidates, const EvidenceWeights& weights,
  const LogisticRegression& likely, const EvidenceRatesSettings& settings)
{
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
    const double gain = settings.leastGain;
    const double chance = std::min(wrongFound / ofWrong, 1.0 - 2.0 * gain);
    return EvidenceRate{ std::clamp(rightFound / ofRight, std::max(leastFound, chance + gain), 1.0 - gain), chance };
  };
  EvidenceRates rates = settings.usual;
  for (int step = 0; step < settings.steps; ++step)
  {
    std::transform(candidates.begin(), candidates.end(), right.begin(),
      [&](const EvidenceCounts& counts) { return probabilityOf(likely.logOdds(counts.sum(weights, rates))); });
    rates.edges = rateOf(
      &EvidenceCounts::edgesFound, &EvidenceCounts::edgesMissing, settings.usual.edges, settings.usualEdges, 0.0);
    rates.outline = rateOf(&EvidenceCounts::ends, &EvidenceCounts::goesOn, settings.usual.outline,
      settings.usualOutline, settings.leastEnds);
  }
  return rates;
}
}
