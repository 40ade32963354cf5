// SPDX-License-Identifier: BSD-3-Clause
#include "pose/objective/LookalikeDecision.h"

#include <algorithm>
#include <cmath>

namespace meam
{
namespace
{
// Of simulated bins of the example parts and of siblings of theirs (testing/evaluation/siblings.py, seed 901). What the
// sensor saw past counts less than it does there: real parts differ from their CAD file.
constexpr double Nothing = 1.2;     // where nothing contradicts
constexpr double Continuing = -4.0; // of much surface that goes on,
constexpr double Much = 0.5;        // patches: from there on more says little more
constexpr double Past = -1.0;       // of a patch,
constexpr double MostPast = 2.0;    // and of no more

// What is known before a scan: so many poses of the part, and of others that look alike.
constexpr double PriorOfPart = 19.0;
constexpr double PriorOfLookalikes = 1.0;
constexpr int Steps = 10; // of the share and of what it says of each pose
}

double Contradictions::logRatio() const
{
  return Nothing + Continuing * (1.0 - std::exp(-this->continuing / Much)) + Past * std::min(this->past, MostPast);
}

std::vector<double> sharesOfPart(const std::vector<Contradictions>& poses, const std::vector<double>& weights)
{
  std::vector<double> shares(poses.size(), 1.0);
  double part = PriorOfPart / (PriorOfPart + PriorOfLookalikes);
  for (int step = 0; step < Steps; ++step)
  {
    double ofPart = PriorOfPart, all = PriorOfPart + PriorOfLookalikes;
    for (std::size_t k = 0; k < poses.size(); ++k)
    {
      const double odds = part / (1.0 - part) * std::exp(poses[k].logRatio());
      shares[k] = odds / (1.0 + odds);
      ofPart += weights[k] * shares[k];
      all += weights[k];
    }
    part = ofPart / all;
  }
  return shares;
}
}
