// SPDX-License-Identifier: BSD-3-Clause
#include "pose/verification/ProbabilityCalibration.h"

#include <cmath>

namespace meam
{
double LogisticRegression::logOdds(double sum, double poseCertainty) const
{
  return this->constant + this->counted * sum + this->certainty * std::log(poseCertainty);
}

double probabilityOf(double logOdds) { return 1.0 / (1.0 + std::exp(-logOdds)); }
}
