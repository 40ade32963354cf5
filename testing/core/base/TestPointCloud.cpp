// SPDX-License-Identifier: BSD-3-Clause
#include "TestParts.h"
#include "base/Error.h"
#include "base/PointCloud.h"

TEST(PointCloud, SubsetTakesEveryArrayThatIsThere)
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

TEST(PointCloud, PointsAreRequired)
{
  EXPECT_THROW(meam::requirePoints({}, "The scene"), meam::Error);
  EXPECT_THROW(meam::requirePoints({ { parts::NaN, 0, 0 } }, "The scene"), meam::Error);
  EXPECT_NO_THROW(meam::requirePoints({ { parts::NaN, 0, 0 }, { 1, 2, 3 } }, "The scene"));
}

TEST(PointCloud, InvalidPointsAreLeftOut)
{
  meam::PointCloud cloud;
  cloud.points = { { 1, 2, 3 }, { 0, parts::NaN, 0 }, { -1, 5, 3 } };
  cloud.pointIds = { 0, 1, 2 };
  EXPECT_EQ(meam::finitePoints(cloud).pointIds, std::vector<int>({ 0, 2 }));
}
