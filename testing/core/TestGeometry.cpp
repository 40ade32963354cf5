// SPDX-License-Identifier: BSD-3-Clause
#include "Geometry.h"

#include "TestParts.h"

#include "Error.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace
{
const float NaN = std::numeric_limits<float>::quiet_NaN();
}

TEST(Geometry, SubsetTakesEveryArrayThatIsThere)
{
  meam::PointCloud cloud;
  cloud.points = { { 0, 0, 0 }, { 1, 0, 0 }, { 2, 0, 0 } };
  cloud.pointIds = { 7, 8, 9 };
  const meam::PointCloud part = cloud.subset({ 2, 0 });
  ASSERT_EQ(part.size(), 2u);
  EXPECT_EQ(part.points[0], Eigen::Vector3f(2, 0, 0));
  EXPECT_EQ(part.pointIds, std::vector<int>({ 9, 7 }));
  EXPECT_TRUE(part.normals.empty());
}

TEST(Geometry, PointsAreRequired)
{
  EXPECT_THROW(meam::requirePoints({}, "The scene"), meam::Error);
  EXPECT_THROW(meam::requirePoints({ { NaN, 0, 0 } }, "The scene"), meam::Error);
  EXPECT_NO_THROW(meam::requirePoints({ { NaN, 0, 0 }, { 1, 2, 3 } }, "The scene"));
}

TEST(Geometry, InvalidPointsAreLeftOut)
{
  meam::PointCloud cloud;
  cloud.points = { { 1, 2, 3 }, { 0, NaN, 0 }, { -1, 5, 3 } };
  cloud.pointIds = { 0, 1, 2 };
  EXPECT_EQ(meam::finitePoints(cloud).pointIds, std::vector<int>({ 0, 2 }));
  const Eigen::AlignedBox3f box = meam::bounds(cloud.points);
  EXPECT_EQ(box.min(), Eigen::Vector3f(-1, 2, 3));
  EXPECT_EQ(box.max(), Eigen::Vector3f(1, 5, 3));
}

TEST(Geometry, BoundsOfAnyNumberOfPointsSomeOfWhichAreInvalid)
{
  EXPECT_TRUE(meam::bounds({}).isEmpty());
  EXPECT_TRUE(meam::bounds({ { NaN, 0, 0 }, { 0, 0, INFINITY } }).isEmpty());
  std::mt19937 random(5);
  std::uniform_real_distribution<float> coordinate(-9.0f, 9.0f);
  for (int count = 1; count < 40; ++count)
  {
    meam::Points points;
    Eigen::AlignedBox3f expected;
    for (int i = 0; i < count; ++i)
    {
      const Eigen::Vector3f point(coordinate(random), coordinate(random), coordinate(random));
      points.push_back(point);
      expected.extend(point);
      points.push_back({ i % 2 ? NaN : 1e9f, i % 3 ? 1e9f : INFINITY, i % 2 ? 1e9f : -INFINITY });
    }
    const Eigen::AlignedBox3f box = meam::bounds(points);
    EXPECT_EQ(box.min(), expected.min()) << count;
    EXPECT_EQ(box.max(), expected.max()) << count;
    points.pop_back();
    EXPECT_EQ(meam::bounds(points).min(), expected.min()) << "an odd number, a valid one last";
    EXPECT_EQ(meam::bounds(points).max(), expected.max());
  }
}

TEST(Geometry, FrameIsRightHandedWithTheAxisFirst)
{
  for (const Eigen::Vector3f& axis : { Eigen::Vector3f(1, 0, 0), Eigen::Vector3f(0, 0, -1),
         Eigen::Vector3f(1, 2, -3).normalized().eval() })
  {
    const Eigen::Matrix3f frame = meam::frameAround(axis);
    EXPECT_TRUE(frame.col(0).isApprox(axis));
    EXPECT_TRUE(frame.isUnitary(1e-6f));
    EXPECT_NEAR(frame.determinant(), 1.0f, 1e-6f);
  }
}

TEST(Geometry, MetresAgainstMillimetresIsAnError)
{
  const meam::Points metres = { { 0, 0, 0 }, { 0.3f, 0.2f, 0.1f } };
  const meam::Points millimetres = { { 0, 0, 0 }, { 300, 200, 100 } };
  EXPECT_THROW(meam::requireSameUnits(metres, 60.0), meam::Error);
  EXPECT_THROW(meam::requireSameUnits(millimetres, 0.06), meam::Error);
  EXPECT_NO_THROW(meam::requireSameUnits(millimetres, 60.0));
}

TEST(Geometry, AnUnlikelyExtentIsAWarningThatNamesTheFactor)
{
  const auto spanning = [](float length) { return meam::Points{ { 0, 0, 0 }, { length, 0, 0 } }; };
  EXPECT_TRUE(meam::unitsWarning(spanning(300), 60.0).empty());
  EXPECT_NE(meam::unitsWarning(spanning(30), 60.0).find("factor is 10. Scale the scene"), std::string::npos); // centimetres
  EXPECT_NE(meam::unitsWarning(spanning(0.3f), 60.0).find("factor is 1000. Scale the scene"), std::string::npos);
  EXPECT_NE(meam::unitsWarning(spanning(600), 2.0).find("factor is 10. Scale the part"), std::string::npos);
  EXPECT_NE(meam::unitsWarning(spanning(3000), 2.0).find("factor is 1000. Scale the part"), std::string::npos);
}

TEST(Geometry, ThePrincipalFrameOfPointsOnALine)
{
  // Their mean is (3, 0, 2); along x they are skewed towards greater values.
  const Eigen::Isometry3d frame =
    meam::principalFrame(meam::Points{ { 0, 0, 2 }, { NaN, 0, 2 }, { 1, 0, 2 }, { 8, 0, 2 }, { 1, INFINITY, 2 } });
  EXPECT_TRUE((frame * Eigen::Vector3d(3, 0, 2)).isZero(1e-9));
  EXPECT_TRUE((frame * Eigen::Vector3d(8, 0, 2)).isApprox(Eigen::Vector3d(5, 0, 0), 1e-9));
}

TEST(Geometry, ThePrincipalFrameMovesWithThePoints)
{
  std::mt19937 random(4);
  std::gamma_distribution<float> skewed(2.0f, 1.0f);
  meam::Points points;
  for (int i = 0; i < 300; ++i)
  {
    points.push_back({ 9.0f * skewed(random), 4.0f * skewed(random), skewed(random) });
  }
  const Eigen::Isometry3d frame = meam::principalFrame(points);
  EXPECT_NEAR(frame.linear().determinant(), 1.0, 1e-9);
  EXPECT_GT(std::abs(frame.linear()(0, 0)), 0.9) << "most extent along x";
  const meam::Points inFrame = meam::moved(points, frame);
  const Eigen::Isometry3d T = parts::motion(random, 100.0);
  meam::Points elsewhere = meam::moved(points, T);
  elsewhere.push_back(Eigen::Vector3f::Constant(NAN));
  const meam::Points again = meam::moved(elsewhere, meam::principalFrame(elsewhere));
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    EXPECT_LT((inFrame[i] - again[i]).norm(), 1e-3f);
  }
  EXPECT_TRUE(meam::principalFrame(meam::Points{}).isApprox(Eigen::Isometry3d::Identity()));
}
