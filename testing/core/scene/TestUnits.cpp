// SPDX-License-Identifier: BSD-3-Clause
#include "scene/Units.h"

#include "TestFiles.h"

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
  const auto says = [&](float extent, double diameter, const std::string& what)
  {
    const std::string warning = meam::unitsWarning(spanning(extent), diameter);
    EXPECT_NE(warning.find("factor is " + what), std::string::npos) << warning;
  };
  says(30, 60, "10 (centimetres), or 25.4 (inches). Scale the scene"); // a scene of 300 mm, or of 762
  says(12, 60, "25.4 (inches), or 10 (centimetres). Scale the scene"); // of 305 mm, or of 120
  says(8, 60, "25.4 (inches). Scale the scene");
  says(0.3f, 60, "1000 (metres). Scale the scene");
  says(600, 2, "25.4 (inches), or 10 (centimetres). Scale the part"); // a part of 51 mm, or of 20
  says(3000, 2, "1000 (metres), or 25.4 (inches). Scale the part");
}

TEST(Units, AnErrorNamesTheFactor)
{
  const auto says = [](float extent, double diameter) {
    return files::errorOf([&] { meam::requireSameUnits({ { 0, 0, 0 }, { extent, 0, 0 } }, diameter); });
  };
  EXPECT_EQ(says(0.3f, 60.0), "The scene spans 0.3 but the part's diameter is 60: their units differ, and the likely "
                              "factor is 1000 (metres). Scale the scene to the part's unit (Scale of its reader).");
  EXPECT_EQ(says(300, 0.06), "The scene spans 300 but the part's diameter is only 0.06: their units differ, and the "
                             "likely factor is 1000 (metres). Scale the part to the scene's unit (CADScale).");
  EXPECT_NE(says(6, 60.0).find("25.4 (inches)"), std::string::npos);
  EXPECT_NE(says(0, 60.0).find("1000 (metres)"), std::string::npos);
}

TEST(Units, AFactorOfTenIsSuspectedByTheExtentAndThePoints)
{
  const auto spanning = [](float length) { return meam::Points{ { 0, 0, 0 }, { length, 0, 0 } }; };
  const auto says = [&](float extent, double pointDistance, bool isSure = false)
  { return meam::unitsWarning(spanning(extent), 100.0, pointDistance, isSure); };
  EXPECT_NE(
    says(3000, 6.0).find(
      "factor is 10 (centimetres). Scale the scene down by it (Scale of its reader), or the part up (CADScale)."),
    std::string::npos);
  EXPECT_NE(
    says(150, 0.1).find("factor is 10 (centimetres), or 25.4 (inches). Scale the scene up by it"), std::string::npos);
  EXPECT_EQ(says(3000, 0.6), ""); // small parts in a large bin, seen finely
  EXPECT_EQ(says(500, 6.0), "");  // seen coarsely
  EXPECT_NE(says(3000, 3.0, true), "") << "in what is ten times as large likely poses are found, too";
  EXPECT_EQ(says(150, 0.1, true), "");
  EXPECT_EQ(says(3000, 0.0), ""); // not known
}

TEST(Units, PointsOfNoPartSpanTooLittle)
{
  EXPECT_TRUE(meam::spansTooLittle({}, 100.0));
  EXPECT_TRUE(meam::spansTooLittle({ { 0, 0, 0 }, { 3, 0, 0 } }, 100.0));
  EXPECT_FALSE(meam::spansTooLittle({ { 0, 0, 0 }, { 80, 0, 0 } }, 100.0));
}
