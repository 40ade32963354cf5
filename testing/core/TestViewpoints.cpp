// SPDX-License-Identifier: BSD-3-Clause
#include "model/Viewpoints.h"

#include "Error.h"

#include <gtest/gtest.h>

TEST(Viewpoints, SixAreTheAxes)
{
  const meam::Points directions = meam::viewDirections(6);
  ASSERT_EQ(directions.size(), 6u);
  EXPECT_EQ(directions[0], Eigen::Vector3f::UnitZ());
  EXPECT_EQ(directions[1], -Eigen::Vector3f::UnitZ());
  EXPECT_EQ(directions[2], Eigen::Vector3f::UnitX());
  EXPECT_EQ(directions[5], -Eigen::Vector3f::UnitY());
}

TEST(Viewpoints, AnyNumberIsUnitDistinctAndBalanced)
{
  for (const int count : { 2, 6, 14, 26, 50, 200 })
  {
    const meam::Points directions = meam::viewDirections(count);
    ASSERT_EQ(static_cast<int>(directions.size()), count);
    Eigen::Vector3f sum = Eigen::Vector3f::Zero();
    for (int i = 0; i < count; ++i)
    {
      EXPECT_NEAR(directions[i].norm(), 1.0f, 1e-6f);
      sum += directions[i];
      for (int j = 0; j < i; ++j)
      {
        EXPECT_GT((directions[i] - directions[j]).norm(), 0.1f) << count << ": " << i << " and " << j;
      }
    }
    EXPECT_LT(sum.norm(), 0.5f) << count;
  }
}

TEST(Viewpoints, NoneIsAnError)
{
  EXPECT_THROW(meam::viewDirections(0), meam::Error);
}
