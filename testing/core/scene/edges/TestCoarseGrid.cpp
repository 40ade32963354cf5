// SPDX-License-Identifier: BSD-3-Clause
#include "scene/edges/CoarseGrid.h"

#include "TestGrids.h"

TEST(CoarseGrid, halvesToMeans)
{
  const auto cloud = grids::surface(5, 4, [](int x, int y) { return 500.0 + x + 10.0 * y; });
  const meam::OrganizedCloud half = meam::halved(cloud, 100.0);
  ASSERT_EQ(half.width, 2);
  ASSERT_EQ(half.height, 2);
  EXPECT_TRUE(half.points[0].isApprox(Eigen::Vector3f(0.5f, 0.5f, 505.5f)));
  EXPECT_TRUE(half.points[3].isApprox(Eigen::Vector3f(2.5f, 2.5f, 527.5f)));
}

TEST(CoarseGrid, keepsTheNearerSurfaceAndLeavesOutWhatWasNotMeasured)
{
  const auto cloud = grids::surface(4, 2,
    [](int x, int y) {
      return x == 0 ? 500.0 : x == 1 ? 510.0 : y == 0 ? NAN : 7.0;
    });
  const meam::OrganizedCloud half = meam::halved(cloud, 3.0);
  EXPECT_TRUE(half.points[0].isApprox(Eigen::Vector3f(0.0f, 0.5f, 500.0f))) << "the two that are nearer";
  EXPECT_TRUE(half.points[1].isApprox(Eigen::Vector3f(2.5f, 1.0f, 7.0f)));
  EXPECT_FALSE(meam::halved(grids::surface(2, 2, [](int, int) { return NAN; }), 3.0).points[0].allFinite());
}

TEST(CoarseGrid, pointsStandForEachOther)
{
  const auto cloud = grids::surface(5, 5, [](int x, int y) { return x == 2 && y == 2 ? 500.0 : 510.0; });
  const meam::OrganizedCloud half = meam::halved(cloud, 3.0);
  EXPECT_EQ(meam::placeInHalf(2 * 5 + 3, half, cloud), 3);
  EXPECT_EQ(meam::placeInHalf(4 * 5 + 4, half, cloud), 3) << "of the row and the column that are left out the last";
  const std::vector<meam::GridEdge> full = meam::onFullGrid({ { 3, Eigen::Vector2f::UnitY() } }, half, cloud);
  ASSERT_EQ(full.size(), 1u);
  EXPECT_EQ(full[0].point, 2 * 5 + 2) << "the one that is nearer than the others";
  EXPECT_EQ(full[0].direction, Eigen::Vector2f::UnitY());
}
