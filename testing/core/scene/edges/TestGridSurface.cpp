// SPDX-License-Identifier: BSD-3-Clause
#include "TestGrids.h"
#include "scene/edges/GridSurface.h"

TEST(GridSurface, distanceAndNoiseAreMeasured)
{
  for (const double noise : { 0.0, 0.1, 1.0 })
  {
    const meam::GridScale scale = meam::gridScale(grids::surface(
      200, 150, [](int x, int y) { return 500.0 + 0.7 * x - 0.3 * y; }, noise));
    EXPECT_FLOAT_EQ(scale.pointDistance, 1.0);
    EXPECT_NEAR(scale.noise, noise, 0.03 * noise + 1e-4);
  }
  const meam::GridScale nothing = meam::gridScale(grids::surface(10, 10, [](int x, int) { return x % 2 ? NAN : 1.0; }));
  EXPECT_EQ(nothing.pointDistance, 0.0);
  EXPECT_EQ(nothing.noise, 0.0);
}

TEST(GridSurface, windowsGrowWithTheNoise)
{
  EXPECT_EQ((meam::GridScale{ 1.0, 0.0 }.windowRadius()), 2);
  EXPECT_GT((meam::GridScale{ 1.0, 1.0 }.windowRadius()), 2);
  EXPECT_LE((meam::GridScale{ 1.0, 1e9 }.windowRadius()), 10);
  EXPECT_LE((meam::GridScale{ 0.0, 0.0 }.windowRadius()), 10);
  EXPECT_DOUBLE_EQ((meam::GridScale{ 2.0, 0.1 }.depthJump()), 6.5);
}

TEST(GridSurface, aPlaneIsFoundExactly)
{
  const auto cloud = grids::surface(20, 20, [](int x, int y) { return 500.0 + 0.5 * x - 0.25 * y; });
  for (const auto& [row, column] : { std::pair(10, 10), std::pair(0, 0), std::pair(19, 7) })
  {
    const meam::GridPlane plane = meam::fitPlane(cloud, row, column, {}, 5.0);
    ASSERT_TRUE(plane.valid());
    EXPECT_TRUE(plane.middle.isApprox(cloud.points[row * 20 + column], 1e-5f));
    EXPECT_TRUE(plane.alongColumn.isApprox(Eigen::Vector3f(1.0f, 0.0f, 0.5f), 1e-3f));
    EXPECT_TRUE(plane.alongRow.isApprox(Eigen::Vector3f(0.0f, 1.0f, -0.25f), 1e-3f));
    EXPECT_TRUE(plane.lifted({ 1.0f, 2.0f }).isApprox(Eigen::Vector3f(1.0f, 2.0f, 0.0f).normalized(), 1e-3f));
  }
}

TEST(GridSurface, theOtherSideOfAJumpDoesNotCount)
{
  const auto cloud = grids::surface(20, 20, [](int x, int) { return x < 10 ? 400.0 : 500.0 + x; });
  const meam::GridPlane nearer = meam::fitPlane(cloud, 10, 9, {}, 5.0);
  EXPECT_TRUE(nearer.alongColumn.isApprox(Eigen::Vector3f(1.0f, 0.0f, 0.0f), 1e-3f));
  const meam::GridPlane farther = meam::fitPlane(cloud, 10, 10, {}, 5.0);
  EXPECT_TRUE(farther.alongColumn.isApprox(Eigen::Vector3f(1.0f, 0.0f, 1.0f), 1e-3f));
}

TEST(GridSurface, aWindowCanFollowAnEdge)
{
  // Only the diagonal has depth, three points wide: a square window of 2 sees 5 x 5, a long one more of it.
  const auto cloud = grids::surface(40, 40, [](int x, int y) { return std::abs(x - y) <= 1 ? 500.0 + x : NAN; });
  const meam::GridWindow window{ 6, 1, Eigen::Vector2f(1.0f, 1.0f).normalized() };
  const meam::GridPlane plane = meam::fitPlane(cloud, 20, 20, window, 50.0);
  ASSERT_TRUE(plane.valid());
  EXPECT_TRUE(plane.lifted({ 1.0f, 1.0f }).isApprox(Eigen::Vector3f(1.0f, 1.0f, 1.0f).normalized(), 1e-3f));
}

TEST(GridSurface, severalPlanesAtOnceAreThoseOneByOne)
{
  // A step, a hole and noise; windows of all directions and sizes, some beyond the grid, around points with depth and
  // without.
  const auto cloud = grids::surface(
    60, 50, [](int x, int y) { return x == 31 && y % 5 ? NAN
                                      : x < 20         ? 400.0 + 0.3 * y
                                                       : 500.0 - 0.7 * x; }, 0.4);
  meam::Random random(7);
  std::vector<int> points;
  std::vector<meam::GridWindow> windows;
  for (int i = 0; i < 3001; ++i)
  {
    points.push_back(static_cast<int>(random.index(cloud.size())));
    const float angle = static_cast<float>(random.uniform() * M_PI);
    const int radius = 1 + static_cast<int>(random.index(5));
    windows.push_back({ 2 * radius, radius, { std::cos(angle), std::sin(angle) } });
  }
  std::vector<meam::GridPlane> planes(points.size());
  meam::fitPlanes(cloud, points.data(), windows.data(), static_cast<int>(points.size()), 5.0, planes.data());
  int valid = 0;
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    const meam::GridPlane one = meam::fitPlane(cloud, points[i] / 60, points[i] % 60, windows[i], 5.0);
    EXPECT_EQ(planes[i].alongColumn, one.alongColumn) << i;
    EXPECT_EQ(planes[i].alongRow, one.alongRow) << i;
    EXPECT_TRUE(planes[i].middle == one.middle || !one.valid()) << i;
    valid += one.valid() ? 1 : 0;
  }
  EXPECT_GT(valid, 2900);
}

TEST(GridSurface, tooFewPointsAreNoPlane)
{
  EXPECT_FALSE(meam::fitPlane(grids::surface(9, 9, [](int, int) { return NAN; }), 4, 4, {}, 5.0).valid());
  EXPECT_FALSE(
    meam::fitPlane(grids::surface(9, 9, [](int x, int) { return x == 4 ? 1.0 : NAN; }), 4, 4, { 4, 4 }, 5.0).valid());
}

TEST(GridSurface, TheScaleIsToldWhereRegularPixelsWereNotMeasured)
{
  // So many pixels that one of three in a row, and of three rows, tells the scale: just these were not measured.
  const meam::GridScale scale = meam::gridScale(grids::surface(
    700, 700, [](int x, int y) { return x % 3 == 0 && y % 3 == 0 ? NAN : 500.0; }, 0.2));
  EXPECT_NEAR(scale.noise, 0.2, 0.01);
  EXPECT_GT(scale.pointDistance, 0.0);
}
