// SPDX-License-Identifier: BSD-3-Clause
#include "base/Random.h"
#include "scene/edges/ImageEdges.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

namespace
{
constexpr int Width = 200;
constexpr int Height = 150;

/// An image of the values at (column, row), with noise of the given standard deviation.
meam::Image picture(const std::function<double(int, int)>& value, double noise = 0.0)
{
  meam::Image image{ Width, Height, 1, {} };
  meam::Random random(1);
  for (int row = 0; row < Height; ++row)
  {
    for (int column = 0; column < Width; ++column)
    {
      const double seen = value(column, row) + (noise > 0.0 ? noise * random.normal() : 0.0);
      image.pixels.push_back(static_cast<std::uint8_t>(std::lround(std::min(std::max(seen, 0.0), 255.0))));
    }
  }
  return image;
}

/// Edge pixels beside the border of columns 99 and 100, as a share of the rows; and elsewhere, of all pixels.
std::pair<double, double> stepAndElsewhere(const meam::Image& image)
{
  int step = 0;
  int elsewhere = 0;
  for (const meam::EdgePixel& pixel : meam::findImageEdges(image))
  {
    (std::abs(pixel.column - 99.5) <= 2.0 ? step : elsewhere) += 1;
  }
  return { step / static_cast<double>(Height), elsewhere / static_cast<double>(Width * Height) };
}

std::function<double(int, int)> stepOf(double left, double right)
{
  return [=](int column, int) { return column < 100 ? left : right; };
}
}

TEST(ImageEdges, theStepIsFoundAndNothingElse)
{
  struct Case
  {
    const char* name;
    double left, right, noise;
  };
  for (const Case& c : { Case{ "high contrast", 50, 200, 0 }, Case{ "high contrast, noise", 50, 200, 5 },
         Case{ "dark", 4, 16, 0.7 }, Case{ "bright", 238, 250, 0.7 }, Case{ "saturated on one side", 120, 300, 6 },
         Case{ "low contrast", 120, 130, 0.5 }, Case{ "strong noise", 60, 200, 15 } })
  {
    const auto [step, elsewhere] = stepAndElsewhere(picture(stepOf(c.left, c.right), c.noise));
    EXPECT_GE(step, 0.9) << c.name;
    EXPECT_LE(elsewhere, 0.001) << c.name;
  }
}

TEST(ImageEdges, flatNoiseHasNextToNoEdges)
{
  for (const double noise : { 0.5, 2.0, 5.0, 10.0, 20.0 })
  {
    const auto edges = meam::findImageEdges(picture(stepOf(120, 120), noise));
    EXPECT_LE(edges.size(), Width * Height / 1000u) << noise;
  }
}

TEST(ImageEdges, whiteAreasDoNotHideTheNoiseOfTheRest)
{
  // Two thirds are saturated and without noise: the median gradient of all pixels is zero.
  const meam::Image image = picture([](int column, int) { return column < 133 ? 400.0 : 128.0; }, 8.0);
  const std::vector<meam::EdgePixel> edges = meam::findImageEdges(image);
  const auto isElsewhere = [](const meam::EdgePixel& pixel) { return std::abs(pixel.column - 132.5) > 3.0; };
  EXPECT_LE(std::count_if(edges.begin(), edges.end(), isElsewhere), 10);
}

TEST(ImageEdges, shadingIsNoEdge)
{
  EXPECT_TRUE(meam::findImageEdges(picture([](int column, int) { return 20.0 + column; })).empty());
}

TEST(ImageEdges, oneColourHasNoEdges)
{
  for (const double value : { 0.0, 128.0, 255.0 })
  {
    EXPECT_TRUE(meam::findImageEdges(picture(stepOf(value, value))).empty());
  }
}

TEST(ImageEdges, directionsRunAlongTheEdge)
{
  for (const double degrees : { 0.0, 30.0, 45.0, 77.0, 90.0, 135.0 })
  {
    // Grey values as an optic gives them: a border that is two pixels wide.
    const Eigen::Vector2f along(std::cos(degrees * M_PI / 180.0), std::sin(degrees * M_PI / 180.0));
    const meam::Image image = picture(
      [&](int column, int row)
      {
        const float beside = along.x() * (row - 75.3f) - along.y() * (column - 100.2f);
        return 50.0 + 150.0 * std::min(std::max(0.5f * beside + 0.5f, 0.0f), 1.0f);
      });
    const auto edges = meam::findImageEdges(image);
    EXPECT_GE(edges.size(), 100u);
    for (const meam::EdgePixel& pixel : edges)
    {
      if (std::min(pixel.column, pixel.row) < 4 || pixel.column >= Width - 4 || pixel.row >= Height - 4)
      {
        continue; // the border goes on in another direction outside the image
      }
      EXPECT_NEAR(pixel.direction.norm(), 1.0f, 1e-5f);
      EXPECT_GE(std::abs(pixel.direction.dot(along)), std::cos(4.0f * M_PI / 180.0f)) << degrees;
    }
  }
}

TEST(ImageEdges, badInput)
{
  EXPECT_THROW(meam::findImageEdges({}), meam::Error);
  EXPECT_THROW(meam::findImageEdges({ 4, 4, 2, std::vector<std::uint8_t>(32) }), meam::Error);
  EXPECT_THROW(meam::findImageEdges({ 4, 4, 3, std::vector<std::uint8_t>(16) }), meam::Error);
  meam::ImageEdgeSettings settings;
  settings.smoothing = 51.0;
  EXPECT_THROW(meam::findImageEdges({ 4, 4, 1, std::vector<std::uint8_t>(16) }, settings), meam::Error);
}
