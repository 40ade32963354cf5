// SPDX-License-Identifier: BSD-3-Clause
#include "scene/preparation/CloudOrganization.h"

#include "TestGrids.h"
#include "TestSteps.h"
#include <cmath>

namespace
{
/// 4 x 3 pixels; the middle of column 1 and row 1 looks straight ahead.
meam::Camera camera() { return grids::camera(4, 3, 100.0, 1.0, 1.0); }

meam::MeasuredCloud cloudOf(const meam::Points& points)
{
  meam::MeasuredCloud result;
  result.cloud = { static_cast<int>(points.size()), 1, points };
  return result;
}
}

TEST(CloudOrganization, aPixelKeepsTheNearestPoint)
{
  meam::MeasuredCloud points = cloudOf({ { 0, 0, 600 }, { 0, 0, 500 }, { 0, 0, 700 }, { 10.4f, -4.6f, 500 },
    { 500, 0, 500 }, { 0, 0, -500 }, { NAN, 0, 500 } });
  points.intensities = { 1, 2, 3, 4, 5, 6, 7 };
  const meam::MeasuredCloud grid = meam::organizeCloud(points, camera());
  EXPECT_EQ(grid.cloud.width, 4);
  EXPECT_EQ(grid.cloud.height, 3);
  for (int pixel = 0; pixel < 12; ++pixel)
  {
    EXPECT_EQ(grid.cloud.points[pixel].allFinite(), pixel == 5 || pixel == 3) << pixel;
  }
  EXPECT_EQ(grid.cloud.points[5], points.cloud.points[1]);
  EXPECT_EQ(grid.cloud.points[3], points.cloud.points[3]);
  // The image has no holes: the nearest pixel with a point.
  EXPECT_EQ(grid.intensities, (std::vector<float>{ 2, 2, 4, 4, 2, 2, 2, 4, 2, 2, 2, 4 }));
  EXPECT_TRUE(grid.normals.empty() && grid.colors.empty());
}

TEST(CloudOrganization, aScanInTheWorldComesIntoTheCamerasFrame)
{
  meam::Camera above = camera(); // 1000 mm above the floor, looks down
  above.T_camera_scene.linear() << 1, 0, 0, 0, -1, 0, 0, 0, -1;
  above.T_camera_scene.translation() << 0, 0, 1000;
  meam::MeasuredCloud points = cloudOf({ { 16, -8, 200 } });
  points.normals = { { 0, 0, 1 } };
  points.colors = { 1, 2, 3 };
  const meam::MeasuredCloud grid = meam::organizeCloud(points, above);
  EXPECT_EQ(grid.cloud.points[11], Eigen::Vector3f(16, 8, 800));
  EXPECT_EQ(grid.normals[11], Eigen::Vector3f(0, 0, -1));
  EXPECT_TRUE(std::isnan(grid.normals[0].x()));
  EXPECT_EQ(grid.colors.size(), 36u);
  EXPECT_EQ(grid.colors[1], 2);
}

TEST(CloudOrganization, badInput)
{
  const auto organize = [](const meam::Camera& camera) { meam::organizeCloud(cloudOf({ { 0, 0, 500 } }), camera); };
  steps::expectRefused<meam::Camera>(organize,
    { { [](auto& c) { c.width = 0; }, "width and height" },
      { [](auto& c) { c.width = c.height = 2000000000; }, "width and height" },
      { [](auto& c) { c.fx = 0; }, "focal lengths" }, { [](auto& c) { c.cx = -100; }, "sees no point" } },
    camera());
}

TEST(CloudOrganization, stopsWhenAsked)
{
  steps::expectStops(
    [](const meam::Progress& progress) {
      meam::organizeCloud(cloudOf({ { 0, 0, 500 } }), camera(), progress);
    });
}
