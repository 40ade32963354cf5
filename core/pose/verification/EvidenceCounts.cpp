// SPDX-License-Identifier: BSD-3-Clause
#include "pose/verification/EvidenceCounts.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace meam
{
double EvidenceRate::logOf(double foundTimes, double missingTimes) const
{
  return foundTimes * std::log(this->found / this->chance) +
         missingTimes * std::log((1.0 - this->found) / (1.0 - this->chance));
}

double EvidenceCounts::ofSurface(const EvidenceWeights& weights) const
{
  return weights.there * this->there + weights.unclear * this->unclear + weights.turned * this->turned +
         weights.past * this->past + weights.farPast * this->farPast + weights.hidden * this->hidden +
         weights.enclosed * this->enclosed + weights.unmeasured * this->unmeasured;
}

double EvidenceCounts::ofEdges(const EvidenceWeights& weights, const EvidenceRates& rates) const
{
  return weights.edge * rates.edges.logOf(this->edgesFound, this->edgesMissing);
}

double EvidenceCounts::ofLines(const EvidenceWeights& weights, const EvidenceRates& rates) const
{
  const double all = this->ofEdges(weights, rates) + weights.outline * rates.outline.logOf(this->ends, this->goesOn);
  return std::copysign(weights.manyLines * std::log1p(std::abs(all) / weights.manyLines), all);
}

double EvidenceCounts::sum(const EvidenceWeights& weights, const EvidenceRates& rates) const
{
  return this->ofSurface(weights) + this->ofLines(weights, rates);
}

EvidenceRates evidenceRates(
  const std::vector<EvidenceCounts>& candidates, const EvidenceWeights& weights, const EvidenceRatesSettings& settings)
{
  using Count = double EvidenceCounts::*;
  std::vector<int> order(candidates.size());
  std::iota(order.begin(), order.end(), 0);
  const auto rate = [&](std::size_t best, Count found, Count missing, double usual, double usualCount)
  {
    double foundTimes = usualCount * usual, all = usualCount;
    for (std::size_t k = 0; k < best; ++k)
    {
      const EvidenceCounts& counts = candidates[order[k]];
      foundTimes += counts.*found;
      all += counts.*found + counts.*missing;
    }
    return foundTimes / all;
  };
  const auto edgeRate = [&](std::size_t best, double usual)
  { return rate(best, &EvidenceCounts::edgesFound, &EvidenceCounts::edgesMissing, usual, settings.usualEdges); };
  const auto outlineRate = [&](std::size_t best, double usual)
  { return rate(best, &EvidenceCounts::ends, &EvidenceCounts::goesOn, usual, settings.usualOutline); };
  const double gain = settings.leastGain;
  const EvidenceRates& usual = settings.usual;
  EvidenceRates rates;
  rates.edges.chance = std::min(edgeRate(candidates.size(), usual.edges.chance), 1.0 - 2.0 * gain);
  rates.edges.found =
    std::max(std::min(settings.firstGain * rates.edges.chance, usual.edges.found), rates.edges.chance + gain);
  rates.outline.chance = std::min(outlineRate(candidates.size(), usual.outline.chance), 1.0 - 2.0 * gain);
  rates.outline.found = std::max(usual.outline.found, rates.outline.chance + gain);
  std::vector<double> sums(candidates.size());
  for (int step = 0; step < settings.steps; ++step)
  {
    std::transform(candidates.begin(), candidates.end(), sums.begin(),
      [&](const EvidenceCounts& counts) { return counts.sum(weights, rates); });
    std::stable_sort(order.begin(), order.end(), [&](int a, int b) { return sums[a] > sums[b]; });
    const auto supported = static_cast<std::size_t>(std::ceil(settings.supportedShare * candidates.size()));
    rates.edges.found = std::clamp(edgeRate(supported, usual.edges.found), rates.edges.chance + gain, 1.0 - gain);
    rates.outline.found = std::clamp(outlineRate(supported, usual.outline.found),
      std::max(settings.leastEnds, rates.outline.chance + gain), 1.0 - gain);
  }
  return rates;
}
}
