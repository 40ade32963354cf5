// SPDX-License-Identifier: BSD-3-Clause
#include "TestGrids.h"
#include "TestSteps.h"
#include "scene/edges/SceneEdgeExtraction.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

namespace
{
/// A plane at z = 500, points 1 mm apart, x = column and y = row.
meam::OrganizedCloud plane(int width = 40, int height = 30)
{
  return grids::surface(width, height, [](int, int) { return 500.0; });
}

meam::Image greyImage(int width, int height, std::uint8_t value)
{
  return { width, height, 1, std::vector<std::uint8_t>(static_cast<std::size_t>(width) * height, value) };
}

/// Dark on the left, bright from column `edge` on.
meam::Image step(int width = 40, int height = 30, int edge = 20)
{
  meam::Image image = greyImage(width, height, 50);
  for (std::size_t i = 0; i < image.pixels.size(); ++i)
  {
    image.pixels[i] = static_cast<int>(i) % width < edge ? 50 : 200;
  }
  return image;
}

meam::PointCloud edgesOf(const meam::OrganizedCloud& cloud, const meam::Image& image = step(),
  const meam::SceneEdgeExtractionSettings& settings = {})
{
  return meam::extractSceneEdges(cloud, image, settings).cloud;
}
}

TEST(SceneEdgeExtraction, aStepOfBrightnessIsALineOfPoints)
{
  const meam::PointCloud edges = edgesOf(plane());
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
    const meam::PointCloud edges =
      edgesOf(grids::surface(40, 30, [&](int x, int) { return (x < 20) == nearIsLeft ? 450.0 : 500.0; }));
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
  const meam::OrganizedCloud slope = grids::surface(40, 30, [](int x, int) { return 500.0 + 2.0 * x; }); // 63 degrees
  EXPECT_EQ(edgesOf(slope).pointIds, edgesOf(plane()).pointIds);
  // Told that 1 mm is a jump, the edge moves to the nearer neighbour.
  meam::SceneEdgeExtractionSettings settings;
  settings.depthJump = 1.0;
  for (const auto& point : edgesOf(slope, step(), settings).points)
  {
    EXPECT_LT(point.x(), 19.5f);
  }
}

TEST(SceneEdgeExtraction, aPixelWithoutDepthTakesItsNeighbours)
{
  const meam::OrganizedCloud cloud =
    grids::surface(40, 30, [](int x, int) { return x == 19 || x == 20 ? NAN : 500.0; });
  for (const auto& point : edgesOf(cloud).points)
  {
    EXPECT_TRUE(point.x() == 18.0f || point.x() == 21.0f);
  }
  meam::SceneEdgeExtractionSettings settings;
  settings.searchRadius = 0;
  EXPECT_TRUE(edgesOf(cloud, step(), settings).empty());
}

TEST(SceneEdgeExtraction, colourImagesAreTurnedGrey)
{
  meam::Image colour{ 40, 30, 3, {} };
  for (const std::uint8_t value : step().pixels)
  {
    colour.pixels.insert(colour.pixels.end(), 3, value);
  }
  EXPECT_EQ(edgesOf(plane(), colour).pointIds, edgesOf(plane()).pointIds);
}

TEST(SceneEdgeExtraction, thresholdsCanBeSet)
{
  meam::SceneEdgeExtractionSettings settings;
  settings.image.smoothing = 0.0;
  settings.image.highThreshold = 601.0; // Sobel answers a step of 150 with 600
  EXPECT_TRUE(edgesOf(plane(), step(), settings).empty());
  settings.image.highThreshold = 599.0;
  EXPECT_FALSE(edgesOf(plane(), step(), settings).empty());
}

/// A box, 80 x 60 mm and 100 mm high, on a floor 1000 mm below the sensor, as the sensor measures it: 500 pixels
/// focal length, 161 x 121 points.
meam::OrganizedCloud boxOnFloor()
{
  return grids::measured(grids::camera(161, 121, 500.0, 80.0, 60.0), [](int column, int row)
    { return std::abs(column - 80) * 900 <= 40 * 500 && std::abs(row - 60) * 900 <= 30 * 500 ? 900.0 : 1000.0; });
}

/// A camera 60 mm to the right of the sensor, with a little distortion.
meam::Camera cameraBeside()
{
  meam::Camera camera = grids::camera(240, 150, 600.0, 150.0, 75.0);
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
  cloud.points = meam::moved(cloud.points, T);
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
  const meam::Image image = step();
  const auto expectError =
    [](const meam::OrganizedCloud& cloud, const meam::Image& of, const std::vector<std::string>& words)
  {
    const std::string error = files::errorOf([&] { edgesOf(cloud, of); });
    for (const std::string& word : words)
    {
      EXPECT_TRUE(files::contains(error, word)) << error;
    }
  };
  expectError({}, image, { "no points" });
  expectError(plane(1200, 1), image, { "not organized" });
  expectError(plane(30, 40), image, { "40 x 30", "30 x 40" });
  expectError(grids::surface(40, 30, [](int, int) { return NAN; }), image, { "NaN" });
  meam::OrganizedCloud torn = plane();
  torn.points.pop_back();
  expectError(torn, image, { "not organized" });
  for (const int channels : { 2, 3 })
  {
    EXPECT_THROW(edgesOf(plane(), { 40, 30, channels, image.pixels }), meam::Error) << channels;
  }
  steps::expectRefused<meam::SceneEdgeExtractionSettings>([](const auto& settings)
    { edgesOf(plane(), step(), settings); },
    { { [](auto& s) { s.searchRadius = -1; } }, { [](auto& s) { s.imageEdges = false; } }, // nothing is asked for
      { [](auto& s) { s.creaseAngle = 0.0; } },
      { [](auto& s) { s.camera = cameraBeside(); } }, // its image is of another size
      { [](auto& s) { s.camera = grids::camera(0, 0, 0.0, 0.0, 0.0); } },
      { [](auto& s) { s.image.smoothing = NAN; } } });
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
