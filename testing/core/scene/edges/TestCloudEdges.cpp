// SPDX-License-Identifier: BSD-3-Clause
#include "TestGrids.h"
#include "scene/edges/CloudEdges.h"

#include <set>

namespace
{
std::vector<meam::GridEdge> creases(const meam::OrganizedCloud& cloud, double angle = 30.0, int threads = 0)
{
  return meam::findCreases(cloud, meam::gridScale(cloud), angle, threads);
}
}

TEST(CloudEdges, aJumpIsOnItsNearerSide)
{
  const auto cloud = grids::surface(20, 15, [](int x, int) { return x < 10 ? 480.0 : 500.0; });
  const auto edges = meam::findDepthEdges(cloud, 3.0);
  ASSERT_EQ(edges.size(), 15u);
  for (std::size_t i = 0; i < edges.size(); ++i)
  {
    EXPECT_EQ(edges[i].point, static_cast<int>(20 * i + 9)); // in the order of the grid
    EXPECT_NEAR(std::abs(edges[i].direction.y()), 1.0f, 0.2f);
  }
  EXPECT_TRUE(meam::findDepthEdges(cloud, 20.0).empty()); // of 20 mm it is no jump any more
}

TEST(CloudEdges, theShadowOfAJumpIsBridged)
{
  // 20 mm deep; four columns have no depth, so that the next is five steps away.
  const auto cloud = grids::surface(20, 15, [](int x, int) { return x < 8 ? 480.0 : x < 12 ? NAN : 500.0; });
  EXPECT_EQ(meam::findDepthEdges(cloud, 3.9).size(), 15u);
  EXPECT_TRUE(meam::findDepthEdges(cloud, 4.1).empty());
}

TEST(CloudEdges, slopesHolesAndSinglePointsAreNoJumps)
{
  EXPECT_TRUE(meam::findDepthEdges(grids::surface(20, 15, [](int x, int) { return 500.0 + 2.0 * x; }), 3.0).empty());
  EXPECT_TRUE(
    meam::findDepthEdges(grids::surface(20, 15, [](int x, int) { return x == 8 ? NAN : 500.0; }), 3.0).empty());
  EXPECT_TRUE(
    meam::findDepthEdges(grids::surface(20, 15, [](int x, int y) { return x == 8 && y == 7 ? 450.0 : 500.0; }), 3.0)
      .empty());
}

TEST(CloudEdges, steepWallsAreNoJumpsButEndInOne)
{
  // 8 mm a pixel, as a bin's wall at a grazing angle falls.
  const auto wall = [](int x) { return 400.0 + 8.0 * x; };
  EXPECT_TRUE(meam::findDepthEdges(grids::surface(20, 15, [&](int x, int) { return wall(x); }), 3.0).empty());
  // The rim above it: a flat surface that the wall begins beside.
  const auto rim = grids::surface(20, 15, [&](int x, int) { return x < 10 ? 400.0 : wall(x - 9); });
  for (const auto& edge : meam::findDepthEdges(rim, 3.0))
  {
    EXPECT_EQ(edge.point % 20, 9);
  }
}

TEST(CloudEdges, aRoofHasACreaseAlongItsRidge)
{
  // Both sides fall by 45 degrees, the ridge runs along column 30.
  const auto cloud = grids::surface(60, 40, [](int x, int) { return 500.0 + std::abs(x - 30); });
  const auto edges = creases(cloud);
  std::set<int> rows;
  for (const auto& edge : edges)
  {
    EXPECT_EQ(edge.point % 60, 30);
    EXPECT_NEAR(std::abs(edge.direction.y()), 1.0f, 1e-3f);
    rows.insert(edge.point / 60);
  }
  EXPECT_GE(rows.size(), 30u); // windows at the border of the grid are cut off
  EXPECT_TRUE(creases(cloud, 91.0).empty());
  EXPECT_FALSE(creases(cloud, 89.0).empty());
}

TEST(CloudEdges, creasesStandNoise)
{
  const auto roof = grids::surface(
    60, 60, [](int x, int) { return 500.0 + std::abs(x - 30); }, 0.3);
  std::set<int> rows;
  for (const auto& edge : creases(roof))
  {
    EXPECT_NEAR(edge.point % 60, 30, 2);
    rows.insert(edge.point / 60);
  }
  EXPECT_GE(rows.size(), 40u);
  for (const double noise : { 0.1, 0.5, 2.0 })
  {
    EXPECT_LE(creases(grids::surface(
                        100, 100, [](int, int) { return 500.0; }, noise))
                .size(),
      20u)
      << noise;
  }
}

TEST(CloudEdges, roundSurfacesAndJumpsAreNoCreases)
{
  // Windows three steps to the left and to the right of a cylinder's top are turned by 29 degrees; a roof of that
  // angle has a crease.
  const auto cylinder = [](int x, int) { return 500.0 - std::sqrt(144.0 - (x - 9.0) * (x - 9.0)); };
  const auto roof = [](int x, int) { return 500.0 + 0.26 * std::abs(x - 9.0); };
  EXPECT_TRUE(creases(grids::surface(19, 40, cylinder), 25.0).empty());
  EXPECT_FALSE(creases(grids::surface(19, 40, roof), 25.0).empty());
  EXPECT_TRUE(creases(grids::surface(60, 40, [](int x, int) { return x < 30 ? 400.0 : 500.0; })).empty());
}

TEST(CloudEdges, theNumberOfThreadsDoesNotMatter)
{
  const auto cloud = grids::surface(
    80, 60, [](int x, int y) { return 500.0 + std::abs(x - 30) + (y > 40 ? 30.0 : 0.0); }, 0.2);
  const auto same = [](const std::vector<meam::GridEdge>& a, const std::vector<meam::GridEdge>& b)
  {
    return a.size() == b.size() &&
           std::equal(a.begin(), a.end(), b.begin(),
             [](const auto& p, const auto& q) { return p.point == q.point && p.direction == q.direction; });
  };
  EXPECT_TRUE(same(creases(cloud, 30.0, 1), creases(cloud, 30.0, 3)));
  EXPECT_TRUE(same(meam::findDepthEdges(cloud, 5.0, 1), meam::findDepthEdges(cloud, 5.0, 3)));
}
