// SPDX-License-Identifier: BSD-3-Clause
#include "base/sequences/Quantiles.h"

#include <gtest/gtest.h>

TEST(Quantiles, OfValuesInAnyOrder)
{
  std::vector<double> values{ 5, 1, 4, 2, 3, 6 };
  EXPECT_EQ(meam::medianOf(values), 4.0) << "of an even number the larger of the two in the middle";
  EXPECT_EQ(meam::quantileOf(values, 0.5), 3.0) << "of the five steps between them two and a half";
  EXPECT_EQ(meam::quantileOf(values, 0.0), 1.0);
  EXPECT_EQ(meam::quantileOf(values, 1.0), 6.0);
  EXPECT_EQ(meam::nthOf(values, 1), 2.0);
}

TEST(Quantiles, OfNoValuesAreZero)
{
  std::vector<float> none;
  EXPECT_EQ(meam::medianOf(none), 0.0f);
  EXPECT_EQ(meam::quantileOf(none, 0.3), 0.0f);
}
