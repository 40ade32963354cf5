// SPDX-License-Identifier: BSD-3-Clause
#include "pose/verification/ProbabilityCalibration.h"

#include <gtest/gtest.h>

#include <cmath>

TEST(ProbabilityCalibration, IsLogisticInWhatWasCountedAndTheLogarithmOfTheCertainty)
{
  const meam::LogisticRegression regression{ -4.0, 8.0, 2.0 };
  const auto probability = [&](double counted, double certainty)
  { return meam::probabilityOf(regression.logOdds(counted, certainty)); };
  EXPECT_DOUBLE_EQ(regression.logOdds(0.75, 1.0), 2.0);
  EXPECT_DOUBLE_EQ(probability(0.5, 1.0), 0.5);
  EXPECT_DOUBLE_EQ(probability(0.75, 1.0), 1.0 / (1.0 + std::exp(-2.0)));
  EXPECT_DOUBLE_EQ(probability(0.5, 0.5), 0.2) << "a quarter of the odds";
  EXPECT_EQ(probability(1.0, 0.0), 0.0);
}
