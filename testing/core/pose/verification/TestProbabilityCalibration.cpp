// SPDX-License-Identifier: BSD-3-Clause
#include "pose/verification/ProbabilityCalibration.h"

#include <gtest/gtest.h>

#include <cmath>

TEST(ProbabilityCalibration, IsLogisticInWhatWasCounted)
{
  const meam::LogisticRegression regression{ -4.0, 8.0 };
  EXPECT_DOUBLE_EQ(regression.logOdds(0.75), 2.0);
  EXPECT_DOUBLE_EQ(meam::probabilityOf(regression.logOdds(0.5)), 0.5);
  EXPECT_DOUBLE_EQ(meam::probabilityOf(regression.logOdds(0.75)), 1.0 / (1.0 + std::exp(-2.0)));
}

TEST(ProbabilityCalibration, APoseIsRightWhenItsPlaceAndItsRotationAre)
{
  const auto both = [](double ofPlace, double certainty)
  { return meam::probabilityOf(meam::withCertainty(std::log(ofPlace / (1.0 - ofPlace)), certainty)); };
  EXPECT_DOUBLE_EQ(both(0.5, 1.0), 0.5);
  EXPECT_DOUBLE_EQ(both(0.5, 0.5), 0.25);
  EXPECT_NEAR(both(0.9, 0.2), 0.18, 1e-12);
  EXPECT_EQ(both(0.5, 0.0), 0.0);
  EXPECT_DOUBLE_EQ(meam::withCertainty(800.0, 1.0), 800.0);
  EXPECT_NEAR(meam::probabilityOf(meam::withCertainty(800.0, 0.3)), 0.3, 1e-12) << "the place is sure";
  EXPECT_EQ(meam::probabilityOf(meam::withCertainty(-800.0, 0.3)), 0.0);
}
