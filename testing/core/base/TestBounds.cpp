// SPDX-License-Identifier: BSD-3-Clause
#include "base/Bounds.h"

#include "TestParts.h"
#include "base/PointCloud.h"

TEST(Bounds, BoundsOfAnyNumberOfPointsSomeOfWhichAreInvalid)
{
  EXPECT_TRUE(meam::bounds({}).isEmpty());
  EXPECT_TRUE(meam::bounds({ { parts::NaN, 0, 0 }, { 0, 0, INFINITY } }).isEmpty());
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
      points.push_back({ i % 2 ? parts::NaN : 1e9f, i % 3 ? 1e9f : INFINITY, i % 2 ? 1e9f : -INFINITY });
    }
    const Eigen::AlignedBox3f box = meam::bounds(points);
    EXPECT_EQ(box.min(), expected.min()) << count;
    EXPECT_EQ(box.max(), expected.max()) << count;
    points.pop_back();
    EXPECT_EQ(meam::bounds(points).min(), expected.min()) << "an odd number, a valid one last";
    EXPECT_EQ(meam::bounds(points).max(), expected.max());
  }
}
