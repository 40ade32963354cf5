// SPDX-License-Identifier: BSD-3-Clause
#include "TestGrids.h"
#include "scene/preparation/BackgroundRemoval.h"

#include <algorithm>

namespace
{
/// A tilted floor with a block of 20 x 20 points, 30 mm high, and a plate of 10 x 10, 1 mm thick.
double bin(int x, int y)
{
  const double floor = 800.0 + 0.1 * x;
  if (x >= 10 && x < 30 && y >= 10 && y < 30)
  {
    return floor - 30.0;
  }
  return x >= 50 && x < 60 && y >= 20 && y < 30 ? floor - 1.0 : floor;
}

int count(const meam::BackgroundRemoval& removal, meam::Background reason)
{
  return static_cast<int>(std::count(removal.reasons.begin(), removal.reasons.end(), reason));
}
}

TEST(BackgroundRemoval, theFloorGoesAndTheBlockStays)
{
  for (const double noise : { 0.0, 0.5 })
  {
    const meam::BackgroundRemoval removal = meam::removeBackground(grids::surface(80, 60, bin, noise));
    ASSERT_EQ(removal.planes.size(), 1u);
    const Eigen::Vector3f normal(0.1f, 0.0f, -1.0f);
    EXPECT_GT(removal.planes[0].normal().dot(normal.normalized()), 0.9999f);
    EXPECT_NEAR(removal.planes[0].offset(), 800.0 / normal.norm(), 0.5);
    for (int row = 0; row < 60; ++row)
    {
      for (int column = 0; column < 80; ++column)
      {
        const bool onBlock = column >= 10 && column < 30 && row >= 10 && row < 30;
        if (onBlock)
        {
          ASSERT_EQ(removal.reasons[row * 80 + column], meam::Background::Kept);
          ASSERT_TRUE(removal.cloud.points[row * 80 + column].allFinite());
        }
      }
    }
    EXPECT_NEAR(count(removal, meam::Background::Plane), 80 * 60 - 400, 50); // the thin plate is within the tolerance
  }
}

TEST(BackgroundRemoval, theToleranceDecidesOnThinParts)
{
  meam::BackgroundRemovalSettings settings;
  settings.tolerance = 0.5;
  const auto removal = meam::removeBackground(grids::surface(80, 60, bin), nullptr, settings);
  EXPECT_EQ(count(removal, meam::Background::Plane), 80 * 60 - 400 - 100);
}

TEST(BackgroundRemoval, aPlaneWithTheSceneBehindItIsNoBackground)
{
  // The largest plane is the top of a box; the ground around it is rough.
  const auto scene = grids::surface(
    60, 60, [](int x, int y) { return x >= 10 && x < 50 && y >= 10 && y < 50 ? 700.0 : 800.0 + 7 * (x * y % 11); });
  const auto removal = meam::removeBackground(scene);
  EXPECT_TRUE(removal.planes.empty());
  EXPECT_EQ(count(removal, meam::Background::Kept), 3600);
}

TEST(BackgroundRemoval, smallPlanesStay)
{
  meam::BackgroundRemovalSettings settings;
  settings.leastShare = 95.0;
  EXPECT_TRUE(meam::removeBackground(grids::surface(80, 60, bin), nullptr, settings).planes.empty());
  settings.leastShare = 10.0;
  settings.planes = 0;
  EXPECT_TRUE(meam::removeBackground(grids::surface(80, 60, bin), nullptr, settings).planes.empty());
}

TEST(BackgroundRemoval, floorAndWallsAreSeveralPlanes)
{
  // A floor and two slanted walls, at the left and at the right.
  const auto scene = grids::surface(90, 60,
    [](int x, int y)
    {
      const double part = x >= 40 && x < 50 && y >= 20 && y < 40 ? 20.0 : 0.0;
      return 800.0 - part - 3.0 * std::max({ 0, 20 - x, x - 70 });
    });
  meam::BackgroundRemovalSettings settings;
  settings.planes = 3;
  const auto removal = meam::removeBackground(scene, nullptr, settings);
  EXPECT_EQ(removal.planes.size(), 3u);
  EXPECT_EQ(count(removal, meam::Background::Kept), 200);
}

TEST(BackgroundRemoval, regionAndMask)
{
  const auto scene = grids::surface(80, 60, bin);
  meam::BackgroundRemovalSettings settings;
  settings.planes = 0;
  settings.region = Eigen::AlignedBox3f(Eigen::Vector3f(10, 10, 0), Eigen::Vector3f(19, 19, 790));
  meam::Image mask{ 80, 60, 1, std::vector<std::uint8_t>(80 * 60, 255) };
  mask.pixels[15 * 80 + 15] = 0;
  const auto removal = meam::removeBackground(scene, &mask, settings);
  EXPECT_EQ(count(removal, meam::Background::Kept), 99);
  EXPECT_EQ(removal.reasons[15 * 80 + 15], meam::Background::Masked);
  EXPECT_EQ(removal.reasons[15 * 80 + 20], meam::Background::Outside);
  EXPECT_TRUE(removal.cloud.points[15 * 80 + 14].isApprox(scene.points[15 * 80 + 14]));
  EXPECT_FALSE(removal.cloud.points[15 * 80 + 15].allFinite());
  // Nothing left is no error.
  mask.pixels.assign(80 * 60, 0);
  EXPECT_EQ(count(meam::removeBackground(scene, &mask), meam::Background::Masked), 80 * 60);
}

TEST(BackgroundRemoval, pointsWithoutDepthStayAsTheyAre)
{
  const auto scene = grids::surface(80, 60, [](int x, int y) { return x == 3 ? NAN : bin(x, y); });
  const auto removal = meam::removeBackground(scene);
  EXPECT_EQ(removal.reasons[3], meam::Background::Kept);
  EXPECT_FALSE(removal.cloud.points[3].allFinite());
  EXPECT_EQ(removal.planes.size(), 1u);
}

TEST(BackgroundRemoval, badInput)
{
  const auto scene = grids::surface(8, 6, bin);
  EXPECT_THROW(meam::removeBackground({}), meam::Error);
  EXPECT_THROW(meam::removeBackground(grids::surface(8, 1, bin)), meam::Error);
  EXPECT_THROW(meam::removeBackground(grids::surface(8, 6, [](int, int) { return NAN; })), meam::Error);
  const meam::Image mask{ 6, 8, 1, std::vector<std::uint8_t>(48) };
  EXPECT_THROW(meam::removeBackground(scene, &mask), meam::Error);
  meam::BackgroundRemovalSettings settings;
  settings.tolerance = -1.0;
  EXPECT_THROW(meam::removeBackground(scene, nullptr, settings), meam::Error);
  settings = {};
  settings.leastShare = NAN;
  EXPECT_THROW(meam::removeBackground(scene, nullptr, settings), meam::Error);
}
