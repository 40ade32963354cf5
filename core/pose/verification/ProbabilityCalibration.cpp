// SPDX-License-Identifier: BSD-3-Clause
#include "pose/verification/ProbabilityCalibration.h"

#include <cmath>

namespace meam
{
double LogisticRegression::probability(double poseScore, double poseCertainty) const
{
  return 1.0 / (1.0 + std::exp(-this->constant - this->score * poseScore) * std::pow(poseCertainty, -this->certainty));
}
}
