// SPDX-License-Identifier: BSD-3-Clause
#include "base/Random.h"
#include "base/sequences/Sequences.h"
#include "simulation/StereoMatching.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace
{
constexpr int Width = 40;
constexpr int Height = 30;

/// A value for each pixel.
template <typename Function>
std::vector<double> image(Function&& valueAt)
{
  return meam::ofIndices<double>(Width * Height, [&](int i) { return valueAt(i % Width, i / Width); });
}
}

TEST(StereoMatching, whatIsLinearStaysAsItIs)
{
  const std::vector<double> plane = image([](int x, int y) { return 3.0 + 0.25 * x - 0.5 * y; });
  const std::vector<double> means = meam::boxMeans(plane, Width, Height, 7);
  for (std::size_t i = 0; i < plane.size(); ++i)
  {
    ASSERT_NEAR(means[i], plane[i], 1e-10);
  }
}

TEST(StereoMatching, aStepBecomesARampAsWideAsTheWindow)
{
  const std::vector<double> step = image([](int x, int) { return x < 20 ? 0.0 : 10.0; });
  const std::vector<double> means = meam::boxMeans(step, Width, Height, 5);
  const double ramp[] = { 0, 0, 2, 4, 6, 8, 10, 10 };
  for (int k = 0; k < 8; ++k)
  {
    EXPECT_NEAR(means[15 * Width + 16 + k], ramp[k], 1e-10);
  }
}

TEST(StereoMatching, noiseIsAlikeNearbyAndAsLargeAsBefore)
{
  meam::Random random(1);
  std::vector<double> noise(400 * 300);
  for (double& value : noise)
  {
    value = random.normal();
  }
  const std::vector<double> alike = meam::correlated(noise, 400, 300, 5);
  // Of two pixels the squares share so many pixels of 25: all, the neighbor's, none.
  for (const auto& [shift, shared] : { std::pair(0, 25), std::pair(1, 20), std::pair(2, 15), std::pair(7, 0) })
  {
    double product = 0.0;
    for (std::size_t i = 0; i + shift < alike.size(); ++i)
    {
      product += alike[i] * alike[i + shift];
    }
    EXPECT_NEAR(product / alike.size(), shared / 25.0, 0.03);
  }
}

TEST(StereoMatching, aBandBesideAJumpIsHiddenFromTheSecondEye)
{
  // In front of disparity 2 something of 5.5 from column 20 to 29: 3.5 pixels of shift.
  const std::vector<double> jump = image([](int x, int) { return x >= 20 && x < 30 ? 5.5 : 2.0; });
  const std::vector<bool> hidden = meam::halfOccluded(jump, Width);
  for (int i = 0; i < Width * Height; ++i)
  {
    EXPECT_EQ(hidden[i], i % Width >= 17 && i % Width < 20);
  }
  // Of a surface that falls away from the eye nothing is hidden, of one that turns away from it all is.
  const std::vector<bool> facing = meam::halfOccluded(image([](int x, int) { return 40.0 - 0.9 * x; }), Width);
  EXPECT_EQ(std::count(facing.begin(), facing.end(), true), 0);
  const std::vector<bool> averted = meam::halfOccluded(image([](int x, int) { return 1.1 * x; }), Width);
  EXPECT_EQ(std::count(averted.begin(), averted.end(), true), (Width - 1) * Height);
}
