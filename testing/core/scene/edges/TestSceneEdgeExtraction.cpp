// SPDX-License-Identifier: BSD-3-Clause
#include "TestFiles.h"
#include "TestGrids.h"
#include "base/Random.h"
#include "scene/edges/SceneEdgeExtraction.h"

#include <gtest/gtest.h>

#include <algorithm>
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
  return files::errorOf([&] { meam::extractSceneEdges(cloud, image); });
}
}

TEST(SceneEdgeExtraction, aStepOfBrightnessIsALineOfPoints)
{
  const meam::PointCloud edges = meam::extractSceneEdges(plane(40, 30), step(40, 30, 20)).cloud;
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
    const meam::PointCloud edges = meam::extractSceneEdges(cloud, step(40, 30, 20)).cloud;
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
  EXPECT_EQ(meam::extractSceneEdges(slope, step(40, 30, 20)).cloud.pointIds,
    meam::extractSceneEdges(flat, step(40, 30, 20)).cloud.pointIds);
  // Told that 1 mm is a jump, the edge moves to the nearer neighbour.
  meam::SceneEdgeExtractionSettings settings;
  settings.depthJump = 1.0;
  for (const auto& point : meam::extractSceneEdges(slope, step(40, 30, 20), settings).cloud.points)
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
  for (const auto& point : meam::extractSceneEdges(cloud, step(40, 30, 20)).cloud.points)
  {
    EXPECT_TRUE(point.x() == 18.0f || point.x() == 21.0f);
  }
  meam::SceneEdgeExtractionSettings settings;
  settings.searchRadius = 0;
  EXPECT_TRUE(meam::extractSceneEdges(cloud, step(40, 30, 20), settings).cloud.empty());
}

TEST(SceneEdgeExtraction, colourImagesAreTurnedGrey)
{
  const meam::Image grey = step(40, 30, 20);
  meam::Image colour{ 40, 30, 3, {} };
  for (const std::uint8_t value : grey.pixels)
  {
    colour.pixels.insert(colour.pixels.end(), 3, value);
  }
  const auto expected = meam::extractSceneEdges(plane(40, 30), grey).cloud.pointIds;
  EXPECT_EQ(meam::extractSceneEdges(plane(40, 30), colour).cloud.pointIds, expected);
}

TEST(SceneEdgeExtraction, thresholdsCanBeSet)
{
  meam::SceneEdgeExtractionSettings settings;
  settings.image.smoothing = 0.0;
  settings.image.highThreshold = 601.0; // Sobel answers a step of 150 with 600
  EXPECT_TRUE(meam::extractSceneEdges(plane(40, 30), step(40, 30, 20), settings).cloud.empty());
  settings.image.highThreshold = 599.0;
  EXPECT_FALSE(meam::extractSceneEdges(plane(40, 30), step(40, 30, 20), settings).cloud.empty());
}

TEST(SceneEdgeExtraction, oneColourHasNoEdges)
{
  for (const int value : { 0, 128, 255 })
  {
    EXPECT_TRUE(
      meam::extractSceneEdges(plane(40, 30), greyImage(40, 30, static_cast<std::uint8_t>(value))).cloud.empty());
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
  const meam::PointCloud edges = meam::extractSceneEdges(plane(200, 150), noisy).cloud;
  EXPECT_GE(edges.size(), 145u);
  int elsewhere = 0;
  for (const auto& point : edges.points)
  {
    elsewhere += std::abs(point.x() - 99.5f) > 2.0f;
  }
  EXPECT_LE(elsewhere, 30); // one pixel in a thousand
}

/// A box, 80 x 60 mm and 100 mm high, on a floor 1000 mm below the sensor, as the sensor measures it: 500 pixels
/// focal length, 161 x 121 points.
meam::OrganizedCloud boxOnFloor()
{
  meam::OrganizedCloud cloud;
  cloud.width = 161;
  cloud.height = 121;
  for (int row = 0; row < cloud.height; ++row)
  {
    for (int column = 0; column < cloud.width; ++column)
    {
      const Eigen::Vector3f ray((column - 80) / 500.0f, (row - 60) / 500.0f, 1.0f);
      const Eigen::Vector3f top = 900.0f * ray;
      cloud.points.push_back(std::abs(top.x()) <= 40.0f && std::abs(top.y()) <= 30.0f ? top : 1000.0f * ray);
    }
  }
  return cloud;
}

/// A camera 60 mm to the right of the sensor, with a little distortion.
meam::Camera cameraBeside()
{
  meam::Camera camera;
  camera.width = 240;
  camera.height = 150;
  camera.fx = camera.fy = 600.0;
  camera.cx = 150.0;
  camera.cy = 75.0;
  camera.distortion = { -0.05, 0.01, 0.001, -0.001, 0.0 };
  camera.T_camera_scene.translation().x() = -60.0;
  return camera;
}

/// What it sees: the top bright, the wall at the right in between, the floor dark.
meam::Image boxSeenBy(const meam::Camera& camera)
{
  meam::Image image = greyImage(camera.width, camera.height, 60);
  const Eigen::Vector3d eye = camera.T_camera_scene.inverse().translation();
  for (int row = 0; row < camera.height; ++row)
  {
    for (int column = 0; column < camera.width; ++column)
    {
      const Eigen::Vector3d ray = meam::unproject(camera, { column, row }, 1.0) - eye;
      const Eigen::Vector3d top = eye + 900.0 / ray.z() * ray;
      const Eigen::Vector3d wall = eye + (40.0 - eye.x()) / ray.x() * ray;
      std::uint8_t& pixel = image.pixels[row * camera.width + column];
      if (std::abs(top.x()) <= 40.0 && std::abs(top.y()) <= 30.0)
      {
        pixel = 220;
      }
      else if (ray.x() < 0.0 && std::abs(wall.y()) <= 30.0 && wall.z() >= 900.0 && wall.z() <= 1000.0)
      {
        pixel = 130;
      }
    }
  }
  return image;
}

TEST(SceneEdgeExtraction, anotherCamerasEdgesLieOnTheBox)
{
  meam::SceneEdgeExtractionSettings settings;
  settings.camera = cameraBeside();
  const meam::SceneEdges edges = meam::extractSceneEdges(boxOnFloor(), boxSeenBy(*settings.camera), settings);
  const float footprint = 900.0f / 500.0f; // mm of a point
  std::set<int> left, right, upper, lower;
  for (std::size_t i = 0; i < edges.cloud.size(); ++i)
  {
    const Eigen::Vector3f& p = edges.cloud.points[i];
    // None on the floor, also where it begins beside what the camera cannot see.
    ASSERT_EQ(p.z(), 900.0f) << p.transpose();
    const bool alongY = std::abs(std::abs(p.x()) - 40.0f) <= footprint;
    const bool alongX = std::abs(std::abs(p.y()) - 30.0f) <= footprint;
    ASSERT_TRUE(alongX || alongY) << p.transpose();
    if (alongY && !alongX)
    {
      (p.x() < 0.0f ? left : right).insert(static_cast<int>(std::lround(p.y() / footprint)));
      EXPECT_LE(std::abs(p.y()), 30.0f);
    }
    else if (alongX && !alongY)
    {
      (p.y() < 0.0f ? upper : lower).insert(static_cast<int>(std::lround(p.x() / footprint)));
    }
    const bool corner = std::abs(p.x()) > 34.0f && std::abs(p.y()) > 24.0f;
    if (!corner)
    {
      const Eigen::Vector3f& tangent = edges.cloud.tangents[i];
      EXPECT_GE(std::abs(alongY ? tangent.y() : tangent.x()), 0.98f) << p.transpose();
      EXPECT_NEAR(tangent.norm(), 1.0f, 1e-5f);
    }
  }
  // 60 mm are 33 points, 80 mm are 44.
  EXPECT_GE(left.size(), 28u);
  EXPECT_GE(right.size(), 28u);
  EXPECT_GE(upper.size(), 38u);
  EXPECT_GE(lower.size(), 38u);
}

TEST(SceneEdgeExtraction, onlyTheCamerasPlaceBesideTheSceneCounts)
{
  // Scan and camera in another frame, turned about the line of sight.
  meam::SceneEdgeExtractionSettings settings;
  settings.camera = cameraBeside();
  const meam::Image image = boxSeenBy(*settings.camera);
  const meam::SceneEdges before = meam::extractSceneEdges(boxOnFloor(), image, settings);
  const Eigen::Isometry3d T =
    Eigen::Translation3d(30.0, -20.0, 55.0) * Eigen::AngleAxisd(0.7, Eigen::Vector3d::UnitZ());
  meam::OrganizedCloud cloud = boxOnFloor();
  for (auto& point : cloud.points)
  {
    point = (T * point.cast<double>()).cast<float>();
  }
  settings.camera->T_camera_scene = settings.camera->T_camera_scene * T.inverse();
  const meam::SceneEdges after = meam::extractSceneEdges(cloud, image, settings);
  // A point may be rounded to another pixel.
  std::vector<int> both;
  std::set_intersection(before.cloud.pointIds.begin(), before.cloud.pointIds.end(), after.cloud.pointIds.begin(),
    after.cloud.pointIds.end(), std::back_inserter(both));
  EXPECT_GE(both.size(), 0.98 * before.cloud.size());
  EXPECT_GE(both.size(), 0.98 * after.cloud.size());
}

TEST(SceneEdgeExtraction, everyPointIsLabelledByItsSource)
{
  // A step of brightness at column 20, a jump of depth at 40, a ridge at 60.
  const auto cloud = grids::surface(80, 40, [](int x, int) { return x < 40 ? 400.0 : 500.0 + std::abs(x - 60); });
  const meam::Image image = step(80, 40, 20);
  meam::SceneEdgeExtractionSettings settings;
  settings.imageEdges = false;
  settings.depthEdges = true;
  EXPECT_EQ(meam::extractSceneEdges(cloud, {}, settings).sources,
    std::vector<meam::EdgeSource>(40, meam::EdgeSource::DepthJump)); // without an image
  settings.imageEdges = true;
  settings.creases = true;
  const meam::SceneEdges edges = meam::extractSceneEdges(cloud, image, settings);
  ASSERT_EQ(edges.sources.size(), edges.cloud.size());
  int counts[3] = { 0, 0, 0 };
  for (std::size_t i = 0; i < edges.cloud.size(); ++i)
  {
    const float places[3] = { 19.5f, 39.0f, 60.0f };
    const int source = static_cast<int>(edges.sources[i]);
    EXPECT_NEAR(edges.cloud.points[i].x(), places[source], 0.51f);
    EXPECT_GE(std::abs(edges.cloud.tangents[i].y()), 0.99f);
    ++counts[source];
  }
  EXPECT_GE(counts[0], 38);
  EXPECT_EQ(counts[1], 40);
  EXPECT_GE(counts[2], 25);
  // A point that the image tells of too is the image's.
  settings.creases = false;
  for (const meam::EdgeSource source : meam::extractSceneEdges(cloud, step(80, 40, 40), settings).sources)
  {
    EXPECT_EQ(source, meam::EdgeSource::Image);
  }
}

TEST(SceneEdgeExtraction, tangentsFollowTheEdgeOnTheSurface)
{
  // The border runs down and to the right over a surface that falls to the right by 45 degrees.
  const auto slope = [](int x, int) { return 500.0 + x; };
  meam::Image image = greyImage(80, 80, 50);
  for (int i = 0; i < 80 * 80; ++i)
  {
    image.pixels[i] = static_cast<std::uint8_t>(125 + 75 * std::max(-1, std::min(1, i % 80 - i / 80)));
  }
  const Eigen::Vector3f expected = Eigen::Vector3f(1.0f, 1.0f, 1.0f).normalized();
  for (const double noise : { 0.0, 0.3 })
  {
    const meam::SceneEdges edges = meam::extractSceneEdges(grids::surface(80, 80, slope, noise), image);
    EXPECT_GE(edges.cloud.size(), 70u);
    int right = 0;
    for (const auto& tangent : edges.cloud.tangents)
    {
      right += std::abs(tangent.dot(expected)) >= std::cos(5.0 * M_PI / 180.0);
    }
    EXPECT_GE(right, 0.9 * static_cast<double>(edges.cloud.size())) << noise;
  }
  meam::SceneEdgeExtractionSettings settings;
  settings.tangents = false;
  EXPECT_TRUE(meam::extractSceneEdges(grids::surface(80, 80, slope), image, settings).cloud.tangents.empty());
}

TEST(SceneEdgeExtraction, theNumberOfThreadsDoesNotMatter)
{
  meam::SceneEdgeExtractionSettings settings;
  settings.camera = cameraBeside();
  settings.depthEdges = true;
  settings.creases = true;
  settings.threads = 1;
  const meam::Image image = boxSeenBy(*settings.camera);
  const meam::SceneEdges one = meam::extractSceneEdges(boxOnFloor(), image, settings);
  settings.threads = 5;
  const meam::SceneEdges many = meam::extractSceneEdges(boxOnFloor(), image, settings);
  EXPECT_EQ(one.cloud.pointIds, many.cloud.pointIds);
  EXPECT_EQ(one.sources, many.sources);
  EXPECT_EQ(one.cloud.tangents, many.cloud.tangents);
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
  settings.imageEdges = false;
  EXPECT_THROW(meam::extractSceneEdges(plane(40, 30), image, settings), meam::Error); // nothing is asked for
  settings = {};
  settings.creaseAngle = 0.0;
  EXPECT_THROW(meam::extractSceneEdges(plane(40, 30), image, settings), meam::Error);
  settings = {};
  settings.camera = cameraBeside();
  EXPECT_THROW(meam::extractSceneEdges(plane(40, 30), image, settings), meam::Error); // its image is of another size
  settings.camera->width = settings.camera->height = 0;
  settings.camera->fx = 0.0;
  EXPECT_THROW(meam::extractSceneEdges(plane(40, 30), image, settings), meam::Error);
  settings = {};
  settings.image.smoothing = std::nan("");
  EXPECT_THROW(meam::extractSceneEdges(plane(40, 30), image, settings), meam::Error);
}

TEST(SceneEdgeExtraction, aCreaseIsFoundWhereNoiseTakesHalfTheResolution)
{
  // Windows of four grid steps, and of two of the halved grid.
  const auto roof = grids::surface(
    120, 120, [](int x, int) { return 500.0 + 0.8 * std::abs(x - 60.0); }, 0.9);
  ASSERT_GE(meam::gridScale(roof).windowRadius(), 4);
  meam::SceneEdgeExtractionSettings settings = meam::sceneEdgeSettings(meam::Preset::Recommended);
  settings.imageEdges = settings.depthEdges = false;
  std::set<int> rows;
  const meam::SceneEdges edges = meam::extractSceneEdges(roof, {}, settings);
  for (std::size_t i = 0; i < edges.cloud.size(); ++i)
  {
    EXPECT_NEAR(edges.cloud.points[i].x(), 60.0, 4.0);
    EXPECT_GT(std::abs(edges.cloud.tangents[i].y()), 0.8f);
    rows.insert(edges.cloud.pointIds[i] / 120 / 2);
  }
  EXPECT_GE(rows.size(), 45u) << "of 60 rows of the halved grid";
}
