// SPDX-License-Identifier: BSD-3-Clause
#include "pose/objective/LookalikeDecision.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numeric>

namespace meam
{
namespace
{
// By logistic regression over poses in simulated bins of the example parts and of siblings of theirs
// (testing/evaluation/siblings.py, seed 901).
constexpr double OfNothing = 1.5;      // where nothing contradicts
constexpr double OfContinuing = -3.0;  // of much surface that goes on,
constexpr double MuchContinuing = 0.5; // patches: from there on more says little more
constexpr double OfPast = -2.7;        // of a patch,
constexpr double MostPast = 1.5;       // and of no more
constexpr double OfMisfit = -2.7;      // of a surface far off the part,
constexpr double FarOff = 2.0;         // times what is expected: from there on more says little more
// Patches that an uneven scan makes of a right pose where it excuses everything.
constexpr double ExcusedContinuing = 1.0;
constexpr double ExcusedPast = 1.0;

/// Of the copies in a scan, so many are of the part, and how likely that is before anything is seen.
struct Filling
{
  double part;
  double prior;
};
constexpr Filling Fillings[] = { { 0.97, 0.88 }, { 0.5, 0.02 }, { 0.03, 0.1 } }; // all, half, none but by mistake
/// What copies of one scan have in common is no news the second time: all together count as so many.
constexpr double Independent = 8.0;

double saturated(double amount, double much) { return 1.0 - std::exp(-std::max(amount, 0.0) / much); }
}

double Contradictions::logRatio(double excused) const
{
  return OfNothing + OfContinuing * saturated(this->continuing - excused * ExcusedContinuing, MuchContinuing) +
         OfPast * std::clamp(this->past - excused * ExcusedPast, 0.0, MostPast) +
         OfMisfit * saturated(this->misfit - 1.0, FarOff);
}

std::vector<double> sharesOfPart(
  const std::vector<Contradictions>& poses, const std::vector<double>& weights, double excused)
{
  std::vector<double> ratios;
  std::transform(poses.begin(), poses.end(), std::back_inserter(ratios),
    [&](const Contradictions& one) { return std::exp(one.logRatio(excused)); });
  const double copies = std::accumulate(weights.begin(), weights.end(), 0.0);
  const double counting = copies > Independent ? Independent / copies : 1.0;
  std::vector<double> shares(poses.size(), 0.0);
  double all = 0.0;
  for (const auto& [part, prior] : Fillings)
  {
    double logLikelihood = 0.0;
    for (std::size_t k = 0; k < poses.size(); ++k)
    {
      logLikelihood += counting * weights[k] * std::log(part * ratios[k] + 1.0 - part);
    }
    const double posterior = prior * std::exp(logLikelihood); // at most Independent terms: no overflow
    all += posterior;
    for (std::size_t k = 0; k < poses.size(); ++k)
    {
      shares[k] += posterior * part * ratios[k] / (part * ratios[k] + 1.0 - part);
    }
  }
  for (double& share : shares)
  {
    share /= all;
  }
  return shares;
}
}
