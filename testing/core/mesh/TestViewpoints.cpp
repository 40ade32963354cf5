// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/Viewpoints.h"

#include "base/Error.h"

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

TEST(Viewpoints, OfTheCubesDirectionsThoseInsideTheConeStay)
{
  const Eigen::Vector3d up(0, 0, 2);
  EXPECT_EQ(meam::viewDirections(6, up, 89.0), meam::Points{ Eigen::Vector3f::UnitZ() });
  EXPECT_EQ(meam::viewDirections(6, up, 90.0).size(), 5u); // the border belongs to the cone
  EXPECT_EQ(meam::viewDirections(14, up, 54.0).size(), 1u);
  EXPECT_EQ(meam::viewDirections(14, up, 55.0).size(), 5u); // the upper corners at 54.7 degrees
  EXPECT_EQ(meam::viewDirections(26, up, 50.0).size(), 5u); // the upper edge middles at 45 degrees
  EXPECT_EQ(meam::viewDirections(6, { 0, -1, 0 }, 10.0), meam::Points{ -Eigen::Vector3f::UnitY() });
}

TEST(Viewpoints, AnyOtherNumberIsSpreadInsideTheCone)
{
  for (const Eigen::Vector3d& axis : { Eigen::Vector3d(1, 1, 1), Eigen::Vector3d(0, 0, -1) })
  {
    const meam::Points directions = meam::viewDirections(20, axis, 40.0);
    ASSERT_EQ(directions.size(), 20u);
    float farthest = 1.0f;
    for (std::size_t i = 0; i < directions.size(); ++i)
    {
      farthest = std::min(farthest, directions[i].dot(axis.cast<float>().normalized()));
      for (std::size_t j = 0; j < i; ++j)
      {
        EXPECT_GT((directions[i] - directions[j]).norm(), 0.15f);
      }
    }
    EXPECT_GE(farthest, std::cos(40.0 * M_PI / 180.0));
    EXPECT_LT(farthest, std::cos(37.0 * M_PI / 180.0));
  }
}

TEST(Viewpoints, NoneIsAnError)
{
  EXPECT_THROW(meam::viewDirections(0), meam::Error);
  EXPECT_THROW(meam::viewDirections(1, { 1, 0, 0 }, 45.0), meam::Error); // above is not inside
  EXPECT_THROW(meam::viewDirections(6, { 1, 1, 1 }, 50.0), meam::Error);
  EXPECT_THROW(meam::viewDirections(6, { 0, 0, 0 }, 50.0), meam::Error);
  EXPECT_THROW(meam::viewDirections(6, { NAN, 0, 1 }, 50.0), meam::Error);
  EXPECT_THROW(meam::viewDirections(9, { 0, 0, 1 }, 0.0), meam::Error);
  EXPECT_THROW(meam::viewDirections(9, { 0, 0, 1 }, 181.0), meam::Error);
}
