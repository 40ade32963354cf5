// SPDX-License-Identifier: BSD-3-Clause
#include "TestGrids.h"
#include "scene/edges/PixelMap.h"

#include <numeric>

namespace
{
/// Of a sensor at the origin with 21 x 21 points, whose camera is moved by x mm.
meam::Camera cameraAt(double x)
{
  meam::Camera camera = grids::camera(21, 21, 100.0, 10.0, 10.0);
  camera.T_camera_scene.translation().x() = -x;
  return camera;
}

meam::OrganizedCloud measured(const std::function<double(int, int)>& depth)
{
  return grids::measured(cameraAt(0.0), depth);
}
}

TEST(PixelMap, aRegisteredImageShowsItsOwnPoints)
{
  const auto cloud = measured([](int column, int) { return column == 4 ? NAN : 500.0; });
  EXPECT_EQ(meam::pointOfPixel(cloud, 0, 7, 0, 10.0), 7);
  EXPECT_EQ(meam::pointOfPixel(cloud, 0, 4, 0, 10.0), -1);
  // Through a camera at the sensor's place it is the same.
  const auto full = measured([](int, int) { return 500.0; });
  std::vector<int> all(full.size());
  std::iota(all.begin(), all.end(), 0);
  EXPECT_EQ(meam::projectedPixels(full, cameraAt(0.0), 10.0).points, all);
}

TEST(PixelMap, whatIsHiddenFromTheCameraHasNoPixel)
{
  // Columns 8 to 12 are 400 mm away, the rest 500. A camera 20 mm to the right sees the block moved to the left by
  // 20 * 100 / 400 = 5 columns, the ground by 4: of the ground, the column at the left of the block is hidden, and
  // at its right a column shows what the sensor has not seen.
  const auto cloud = measured([](int column, int) { return column >= 8 && column <= 12 ? 400.0 : 500.0; });
  const meam::PixelMap map = meam::projectedPixels(cloud, cameraAt(20.0), 10.0);
  const int row = 10 * 21;
  EXPECT_EQ(map.points[row + 2], row + 6); // ground
  for (int k = 0; k < 5; ++k)
  {
    EXPECT_EQ(map.points[row + 3 + k], row + 8 + k); // the block; in pixel 3 the ground's column 7 is behind it
  }
  EXPECT_EQ(map.points[row + 8], -1); // between the block's column 12, at 7, and the ground's 13, at 9
  EXPECT_EQ(map.points[row + 9], row + 13);
  EXPECT_NEAR(map.depths[row + 5], 400.0f, 1e-3f);
}

TEST(PixelMap, nothingShowsThroughHolesOfTheNearerSurface)
{
  // A camera with twice the resolution: the block's points are two pixels apart, and one has no depth.
  const auto cloud = measured(
    [](int column, int row) { return column == 10 && row == 10     ? NAN
                                     : column >= 6 && column <= 14 ? 400.0
                                                                   : 500.0; });
  meam::Camera camera = grids::camera(41, 41, 200.0, 20.0, 20.0);
  camera.T_camera_scene.translation().x() = -20.0;
  const meam::PixelMap map = meam::projectedPixels(cloud, camera, 10.0);
  EXPECT_NEAR(map.pixelsPerPoint, 2.0, 0.01);
  // The block is seen in columns 2 (6 - 10) + 20 - 10 = 2 to 18, and everything there is the block or unknown.
  for (int column = 2; column <= 18; ++column)
  {
    for (int row = 2; row < 38; ++row)
    {
      const int point = map.points[row * 41 + column];
      EXPECT_TRUE(point < 0 || (point % 21 >= 6 && point % 21 <= 14)) << column << " " << row;
      EXPECT_NEAR(map.depths[row * 41 + column], 400.0f, 1e-3f) << column << " " << row;
    }
  }
  EXPECT_EQ(map.points[20 * 41 + 10], -1); // of the hole itself
}

TEST(PixelMap, theLensIsNotAskedForWhatTheImageDoesNotHave)
{
  // Barrel distortion folds rays of more than 0.58 back; at 0.9 they would come out within the image.
  meam::Camera camera = cameraAt(0.0);
  camera.distortion = { -1.0, 0.0, 0.0, 0.0, 0.0 };
  const meam::OrganizedCloud cloud{ 2, 2, { { 0, 0, 500 }, { 470, 0, 500 }, { 0, 5, 500 }, { 470, 5, 500 } } };
  const meam::PixelMap map = meam::projectedPixels(cloud, camera, 10.0);
  for (const int point : map.points)
  {
    EXPECT_TRUE(point == -1 || point == 0 || point == 2) << point;
  }
}

TEST(PixelMap, anEdgePixelTakesTheNearerSurface)
{
  const auto cloud = measured([](int column, int) { return column < 10 ? 400.0 : 500.0; });
  const meam::PixelMap map = meam::projectedPixels(cloud, cameraAt(0.0), 10.0);
  const auto check = [&](int column, int radius, double jump, int expected)
  {
    EXPECT_EQ(meam::pointOfPixel(cloud, 3, column, radius, jump), 3 * 21 + expected);
    EXPECT_EQ(meam::pointOfPixel(map, 3, column, radius, jump), 3 * 21 + expected);
  };
  check(10, 1, 10.0, 9);
  check(10, 0, 10.0, 10);
  check(11, 1, 10.0, 11);
  check(10, 1, 200.0, 10); // 100 mm are no jump then
  const auto nothing = measured([](int, int) { return NAN; });
  EXPECT_EQ(meam::pointOfPixel(nothing, 3, 10, 1, 10.0), -1);
}

TEST(PixelMap, badInput)
{
  const auto cloud = measured([](int, int) { return 500.0; });
  meam::Camera camera = cameraAt(0.0);
  camera.width = 0;
  EXPECT_THROW(meam::projectedPixels(cloud, camera, 10.0), meam::Error);
  EXPECT_THROW(meam::projectedPixels(cloud, cameraAt(1e5), 10.0), meam::Error); // looks past the scene
  camera = cameraAt(0.0);
  camera.T_camera_scene.translation().z() = -1000.0; // behind it
  EXPECT_THROW(meam::projectedPixels(cloud, camera, 10.0), meam::Error);
}
