// SPDX-License-Identifier: BSD-3-Clause
#include "Random.h"
#include "scene/SceneEdgeExtraction.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <set>

namespace
{
const float NaN = std::numeric_limits<float>::quiet_NaN();

/// A plane at z = 500, points 1 mm apart, x = column and y = row.
meam::OrganizedCloud plane(int width, int height)
{
  meam::OrganizedCloud cloud;
  cloud.width = width;
  cloud.height = height;
  for (int row = 0; row < height; ++row)
  {
    for (int column = 0; column < width; ++column)
    {
      cloud.points.emplace_back(column, row, 500);
    }
  }
  return cloud;
}

meam::Image greyImage(int width, int height, std::uint8_t value)
{
  return { width, height, 1, std::vector<std::uint8_t>(static_cast<std::size_t>(width) * height, value) };
}

/// Dark on the left, bright from column `edge` on.
meam::Image step(int width, int height, int edge)
{
  meam::Image image = greyImage(width, height, 50);
  for (std::size_t i = 0; i < image.pixels.size(); ++i)
  {
    image.pixels[i] = static_cast<int>(i) % width < edge ? 50 : 200;
  }
  return image;
}

std::string errorOf(const meam::OrganizedCloud& cloud, const meam::Image& image)
{
  try
  {
    meam::extractSceneEdges(cloud, image);
  }
  catch (const meam::Error& error)
  {
    return error.what();
  }
  return "no error";
}
}

TEST(SceneEdgeExtraction, aStepOfBrightnessIsALineOfPoints)
{
  const meam::PointCloud edges = meam::extractSceneEdges(plane(40, 30), step(40, 30, 20));
  ASSERT_EQ(edges.size(), edges.pointIds.size());
  std::set<int> rows;
  for (std::size_t i = 0; i < edges.size(); ++i)
  {
    EXPECT_EQ(edges.pointIds[i], static_cast<int>(edges.points[i].y() * 40 + edges.points[i].x()));
    EXPECT_NEAR(edges.points[i].x(), 19.5f, 0.51f);
    EXPECT_EQ(edges.points[i].z(), 500.0f);
    rows.insert(static_cast<int>(edges.points[i].y()));
  }
  EXPECT_GE(rows.size(), 28u); // Canny leaves out the outermost rows
  EXPECT_EQ(std::set<int>(edges.pointIds.begin(), edges.pointIds.end()).size(), edges.size());
}

TEST(SceneEdgeExtraction, theEdgeBelongsToTheNearerSurface)
{
  for (const bool nearIsLeft : { true, false })
  {
    meam::OrganizedCloud cloud = plane(40, 30);
    for (auto& point : cloud.points)
    {
      if ((point.x() < 20) == nearIsLeft)
      {
        point.z() = 450;
      }
    }
    const meam::PointCloud edges = meam::extractSceneEdges(cloud, step(40, 30, 20));
    EXPECT_GE(edges.size(), 28u);
    for (const auto& point : edges.points)
    {
      EXPECT_EQ(point.x(), nearIsLeft ? 19.0f : 20.0f);
      EXPECT_EQ(point.z(), 450.0f);
    }
  }
}

TEST(SceneEdgeExtraction, aSlopeIsNotAJump)
{
  meam::OrganizedCloud flat = plane(40, 30);
  meam::OrganizedCloud slope = flat;
  for (auto& point : slope.points)
  {
    point.z() += 2.0f * point.x(); // 63 degrees
  }
  EXPECT_EQ(meam::extractSceneEdges(slope, step(40, 30, 20)).pointIds,
    meam::extractSceneEdges(flat, step(40, 30, 20)).pointIds);
  // Told that 1 mm is a jump, the edge moves to the nearer neighbour.
  meam::SceneEdgeExtractionSettings settings;
  settings.depthJump = 1.0;
  for (const auto& point : meam::extractSceneEdges(slope, step(40, 30, 20), settings).points)
  {
    EXPECT_LT(point.x(), 19.5f);
  }
}

TEST(SceneEdgeExtraction, aPixelWithoutDepthTakesItsNeighbours)
{
  meam::OrganizedCloud cloud = plane(40, 30);
  for (auto& point : cloud.points)
  {
    if (point.x() == 19 || point.x() == 20)
    {
      point.setConstant(NaN);
    }
  }
  for (const auto& point : meam::extractSceneEdges(cloud, step(40, 30, 20)).points)
  {
    EXPECT_TRUE(point.x() == 18.0f || point.x() == 21.0f);
  }
  meam::SceneEdgeExtractionSettings settings;
  settings.searchRadius = 0;
  EXPECT_TRUE(meam::extractSceneEdges(cloud, step(40, 30, 20), settings).empty());
}

TEST(SceneEdgeExtraction, colourImagesAreTurnedGrey)
{
  const meam::Image grey = step(40, 30, 20);
  meam::Image colour{ 40, 30, 3, {} };
  for (const std::uint8_t value : grey.pixels)
  {
    colour.pixels.insert(colour.pixels.end(), 3, value);
  }
  const auto expected = meam::extractSceneEdges(plane(40, 30), grey).pointIds;
  EXPECT_EQ(meam::extractSceneEdges(plane(40, 30), colour).pointIds, expected);
}

TEST(SceneEdgeExtraction, thresholdsCanBeSet)
{
  meam::SceneEdgeExtractionSettings settings;
  settings.smoothing = 0.0;
  settings.highThreshold = 601.0; // Sobel answers a step of 150 with 600
  EXPECT_TRUE(meam::extractSceneEdges(plane(40, 30), step(40, 30, 20), settings).empty());
  settings.highThreshold = 599.0;
  EXPECT_FALSE(meam::extractSceneEdges(plane(40, 30), step(40, 30, 20), settings).empty());
}

TEST(SceneEdgeExtraction, oneColourHasNoEdges)
{
  for (const int value : { 0, 128, 255 })
  {
    EXPECT_TRUE(meam::extractSceneEdges(plane(40, 30), greyImage(40, 30, static_cast<std::uint8_t>(value))).empty());
  }
}

TEST(SceneEdgeExtraction, noiseIsNoEdge)
{
  meam::Image noisy = step(200, 150, 100);
  meam::Random random(1);
  for (auto& value : noisy.pixels)
  {
    value = static_cast<std::uint8_t>(value + 5.0 * random.normal());
  }
  const meam::PointCloud edges = meam::extractSceneEdges(plane(200, 150), noisy);
  EXPECT_GE(edges.size(), 145u);
  int elsewhere = 0;
  for (const auto& point : edges.points)
  {
    elsewhere += std::abs(point.x() - 99.5f) > 2.0f;
  }
  EXPECT_LE(elsewhere, 30); // one pixel in a thousand
}

TEST(SceneEdgeExtraction, badInput)
{
  const meam::Image image = step(40, 30, 20);
  EXPECT_NE(errorOf({}, image).find("no points"), std::string::npos);
  EXPECT_NE(errorOf(plane(1200, 1), image).find("not organized"), std::string::npos);
  const std::string sizes = errorOf(plane(30, 40), image);
  EXPECT_NE(sizes.find("40 x 30"), std::string::npos);
  EXPECT_NE(sizes.find("30 x 40"), std::string::npos);
  meam::OrganizedCloud cloud = plane(40, 30);
  cloud.points.pop_back();
  EXPECT_NE(errorOf(cloud, image).find("not organized"), std::string::npos);
  cloud.points.assign(40 * 30, Eigen::Vector3f::Constant(NaN));
  EXPECT_NE(errorOf(cloud, image).find("NaN"), std::string::npos);
  meam::Image broken = image;
  broken.channels = 2;
  EXPECT_THROW(meam::extractSceneEdges(plane(40, 30), broken), meam::Error);
  broken.channels = 3;
  EXPECT_THROW(meam::extractSceneEdges(plane(40, 30), broken), meam::Error);
  meam::SceneEdgeExtractionSettings settings;
  settings.searchRadius = -1;
  EXPECT_THROW(meam::extractSceneEdges(plane(40, 30), image, settings), meam::Error);
  settings = {};
  settings.smoothing = std::nan("");
  EXPECT_THROW(meam::extractSceneEdges(plane(40, 30), image, settings), meam::Error);
}
