// SPDX-License-Identifier: BSD-3-Clause
#include "scene/Units.h"

#include "base/Error.h"

#include <gtest/gtest.h>

TEST(Units, MetresAgainstMillimetresIsAnError)
{
  const meam::Points metres = { { 0, 0, 0 }, { 0.3f, 0.2f, 0.1f } };
  const meam::Points millimetres = { { 0, 0, 0 }, { 300, 200, 100 } };
  EXPECT_THROW(meam::requireSameUnits(metres, 60.0), meam::Error);
  EXPECT_THROW(meam::requireSameUnits(millimetres, 0.06), meam::Error);
  EXPECT_NO_THROW(meam::requireSameUnits(millimetres, 60.0));
}

TEST(Units, AnUnlikelyExtentIsAWarningThatNamesTheFactor)
{
  const auto spanning = [](float length) { return meam::Points{ { 0, 0, 0 }, { length, 0, 0 } }; };
  EXPECT_TRUE(meam::unitsWarning(spanning(300), 60.0).empty());
  EXPECT_NE(
    meam::unitsWarning(spanning(30), 60.0).find("factor is 10. Scale the scene"), std::string::npos); // centimetres
  EXPECT_NE(meam::unitsWarning(spanning(0.3f), 60.0).find("factor is 1000. Scale the scene"), std::string::npos);
  EXPECT_NE(meam::unitsWarning(spanning(600), 2.0).find("factor is 10. Scale the part"), std::string::npos);
  EXPECT_NE(meam::unitsWarning(spanning(3000), 2.0).find("factor is 1000. Scale the part"), std::string::npos);
}

TEST(Units, WhenNothingSureWasFoundAFactorOfTenIsSuspected)
{
  const auto spanning = [](float length) { return meam::Points{ { 0, 0, 0 }, { length, 0, 0 } }; };
  const auto says = [&](float extent, double pointDistance)
  { return meam::unitsWarning(spanning(extent), 100.0, pointDistance); };
  EXPECT_NE(says(3000, 6.0).find("factor is 10. Scale the scene by 0.1, or the part by 10"), std::string::npos);
  EXPECT_NE(says(150, 0.1).find("factor is 10. Scale the scene by 10, or the part by 0.1"), std::string::npos);
  EXPECT_EQ(says(3000, 0.6), ""); // small parts in a large bin, seen finely
  EXPECT_EQ(says(500, 6.0), "");  // seen coarsely
  EXPECT_EQ(says(3000, 0.0), ""); // what is sure was found
}

TEST(Units, PointsOfNoPartSpanTooLittle)
{
  EXPECT_TRUE(meam::spansTooLittle({}, 100.0));
  EXPECT_TRUE(meam::spansTooLittle({ { 0, 0, 0 }, { 3, 0, 0 } }, 100.0));
  EXPECT_FALSE(meam::spansTooLittle({ { 0, 0, 0 }, { 80, 0, 0 } }, 100.0));
}
