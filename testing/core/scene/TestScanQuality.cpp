// SPDX-License-Identifier: BSD-3-Clause
#include "base/Error.h"
#include "TestGrids.h"
#include "scene/ScanQuality.h"

#include <cmath>
#include <limits>

namespace
{
constexpr float none = std::numeric_limits<float>::quiet_NaN();

/// Points 0.5 mm apart whose depth is `depth(row, column)`.
template <typename Depth>
meam::OrganizedCloud scan(int width, int height, Depth&& depth)
{
  return grids::grid(
    width, height, [&](int column, int row) { return Eigen::Vector3d(0.5 * column, 0.5 * row, depth(row, column)); });
}

float wave(int column) { return 600.0f + 8.0f * std::sin(0.02f * column); } // a radius of 78 mm
}

TEST(ScanQuality, NoiseOfItsOwnInEachPoint)
{
  meam::Random random(1);
  const auto cloud =
    scan(400, 300, [&](int, int column) { return wave(column) + 0.2f * static_cast<float>(random.normal()); });
  const meam::ScanQuality quality = meam::measureQuality(cloud);
  EXPECT_NEAR(quality.noise, 0.2, 0.004);
  EXPECT_EQ(quality.smoothing, 1.0);
  EXPECT_EQ(quality.depthStep, 0.0);
  EXPECT_NEAR(quality.pointDistance, 0.5, 1e-6);
  EXPECT_EQ(quality.coverage, 1.0);
  EXPECT_EQ(quality.jumpGap, 0.0);
  EXPECT_EQ(quality.flying, 0.0);
}

TEST(ScanQuality, BendsAreNoNoise)
{
  const meam::ScanQuality quality = meam::measureQuality(scan(400, 300, [](int, int column) { return wave(column); }));
  EXPECT_LT(quality.noise, 1e-3);
}

TEST(ScanQuality, NoiseOfTheMeanOverFivePoints)
{
  meam::Random random(2);
  std::vector<float> noise(400 * 300 + 5);
  for (float& one : noise)
  {
    one = static_cast<float>(std::sqrt(5.0) * 0.3 * random.normal());
  }
  const auto cloud = scan(400, 300,
    [&](int row, int column)
    {
      const float* first = &noise[row * 400 + column];
      return wave(column) + (first[0] + first[1] + first[2] + first[3] + first[4]) / 5.0f;
    });
  const meam::ScanQuality quality = meam::measureQuality(cloud);
  EXPECT_NEAR(quality.noise, 0.3, 0.03);
  EXPECT_GE(quality.smoothing, 4.0);
  EXPECT_LE(quality.smoothing, 6.0);
}

TEST(ScanQuality, StepsOfDepth)
{
  meam::Random random(3);
  const auto cloud = scan(400, 300,
    [&](int, int column)
    { return 0.25f * std::round((wave(column) + 0.1f * static_cast<float>(random.normal())) / 0.25f); });
  const meam::ScanQuality quality = meam::measureQuality(cloud);
  EXPECT_NEAR(quality.depthStep, 0.25, 1e-4);
  EXPECT_GE(quality.noise, 0.25 / std::sqrt(12.0) - 1e-9);
  EXPECT_LT(quality.noise, 0.2);
}

/// In each row two jumps: one with two points without depth, one with a point that hangs between.
TEST(ScanQuality, GapsAndFlyingPointsAtJumps)
{
  const auto cloud = scan(200, 100,
    [](int, int column)
    {
      return column < 60                    ? 600.0f
             : column == 60 || column == 61 ? none
             : column < 120                 ? 580.0f
             : column == 120                ? 590.0f
                                            : 600.0f;
    });
  const meam::ScanQuality quality = meam::measureQuality(cloud);
  EXPECT_DOUBLE_EQ(quality.jumpGap, 1.0); // 2 and 0
  EXPECT_DOUBLE_EQ(quality.flying, 0.5);
  EXPECT_DOUBLE_EQ(quality.coverage, 0.99);
}

TEST(ScanQuality, DoesNotDependOnThreads)
{
  meam::Random random(4);
  const auto cloud =
    scan(640, 480, [&](int, int column) { return wave(column) + 0.2f * static_cast<float>(random.normal()); });
  const meam::ScanQuality one = meam::measureQuality(cloud, 1), two = meam::measureQuality(cloud, 2);
  EXPECT_EQ(one.noise, two.noise);
  EXPECT_EQ(one.pointDistance, two.pointDistance);
  EXPECT_EQ(one.flying, two.flying);
}

TEST(ScanQuality, SaysWhatItIsInASentence)
{
  EXPECT_EQ(meam::describe(meam::ScanQuality{ 0.5, 0.123, 4.0, 0.25, 1.5, 0.5, 0.99 }),
    "Points 0.50 mm apart; noise 0.12 mm, alike over 4 points; depth in steps of 0.250 mm; depth at 99 % of the "
    "points; "
    "at depth jumps 1.5 points without depth, and in 50 % of them a stray point between.");
}

TEST(ScanQuality, NotKnownWithoutNeighbours)
{
  EXPECT_FALSE(meam::measureQuality({ 100, 1, meam::Points(100, Eigen::Vector3f::Zero()) }).isKnown());
  EXPECT_FALSE(meam::measureQuality(scan(20, 20, [](int, int) { return none; })).isKnown());
  EXPECT_THROW(meam::measureQuality({ 10, 10, meam::Points(99, Eigen::Vector3f::Zero()) }), meam::Error);
}
