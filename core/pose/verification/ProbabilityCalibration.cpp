// SPDX-License-Identifier: BSD-3-Clause
#include "pose/verification/ProbabilityCalibration.h"

#include <cmath>

namespace meam
{
double withCertainty(double logOdds, double certainty)
{
  // p = c / (1 + exp(-x)), so that p / (1 - p) = c / (1 - c + exp(-x)).
  return certainty < 1.0 ? std::log(certainty) - std::log(1.0 - certainty + std::exp(-logOdds)) : logOdds;
}
}
