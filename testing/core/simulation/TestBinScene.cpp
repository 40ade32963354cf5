// SPDX-License-Identifier: BSD-3-Clause
#include "simulation/BinScene.h"

#include "TestSteps.h"
#include "mesh/TriangleMesh.h"
#include "simulation/parts/SamplePart.h"

#include <algorithm>
#include <cmath>
#include <cstring>

namespace
{
/// A tetrahedron with its corner at the origin and legs of 30, 40 and 50 mm.
meam::TriangleMesh tetrahedron()
{
  meam::TriangleMesh mesh;
  mesh.vertices = { { 0, 0, 0 }, { 30, 0, 0 }, { 0, 40, 0 }, { 0, 0, 50 } };
  mesh.triangles = { { 0, 2, 1 }, { 0, 1, 3 }, { 0, 3, 2 }, { 1, 2, 3 } };
  return mesh;
}

meam::BinSceneSettings small(int copies, unsigned seed = 1)
{
  meam::BinSceneSettings settings;
  settings.copies = copies;
  settings.seed = seed;
  settings.width = 160;
  settings.height = 120;
  return settings;
}

bool same(const meam::Points& a, const meam::Points& b)
{
  // Bit by bit, NaN included.
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(a[0])) == 0;
}
}

TEST(BinScene, aCopyIsWhereItsPoseSays)
{
  meam::BinSceneSettings settings = small(1);
  settings.quality.depthNoise = settings.quality.depthStep = 0.0;
  const meam::BinScene scene = meam::simulateBin(tetrahedron(), settings);
  ASSERT_EQ(scene.instances.size(), 1u);
  EXPECT_DOUBLE_EQ(scene.instances[0].visibleFraction(), 1.0);
  const Eigen::Isometry3d T_model_scene = scene.instances[0].T_scene_model.inverse();
  int seen = 0;
  for (std::size_t i = 0; i < scene.cloud.size(); ++i)
  {
    if (scene.instanceOfPixel[i] == 0 && scene.cloud.points[i].allFinite())
    {
      const Eigen::Vector3d p = T_model_scene * scene.cloud.points[i].cast<double>();
      const double slanted = (p.x() / 30 + p.y() / 40 + p.z() / 50 - 1.0) / std::hypot(1.0 / 30, 1.0 / 40, 1.0 / 50);
      // Signed distances to the faces, positive outside: on one of them, outside of none.
      EXPECT_NEAR(std::max({ -p.x(), -p.y(), -p.z(), slanted }), 0.0, 1e-3);
      ++seen;
    }
  }
  EXPECT_GT(seen, 300);
}

TEST(BinScene, cloudAndImageAreOneGrid)
{
  meam::BinSceneSettings settings = small(3);
  settings.sensorHeight = 700.0;
  settings.binSize = 200.0;
  const meam::BinScene scene = meam::simulateBin(tetrahedron(), settings);
  EXPECT_EQ(scene.cloud.width, 160);
  EXPECT_EQ(scene.cloud.height, 120);
  EXPECT_EQ(scene.image.channels, 1);
  EXPECT_EQ(scene.image.pixels.size(), 160u * 120u);
  EXPECT_EQ(scene.camera.fx, scene.sensor.fx);
  EXPECT_TRUE(scene.camera.T_camera_scene.isApprox(Eigen::Isometry3d::Identity()));
  EXPECT_EQ(scene.instanceOfPixel.size(), 160u * 120u);
  EXPECT_EQ(scene.binSize, 200.0);
  // Every point projects to its pixel, and nothing is below the floor.
  for (std::size_t i = 0; i < scene.cloud.size(); ++i)
  {
    const Eigen::Vector3f& point = scene.cloud.points[i];
    if (point.allFinite())
    {
      ASSERT_NEAR(scene.sensor.fx * point.x() / point.z() + 79.5, i % 160, 1e-3);
      ASSERT_NEAR(scene.sensor.fy * point.y() / point.z() + 59.5, i / 160, 1e-3);
      ASSERT_LT(point.z(), 700.0f + 1.0f);
    }
  }
}

TEST(BinScene, aBinWithSides)
{
  meam::BinSceneSettings settings = small(6);
  settings.binSize = 400.0;
  settings.binWidth = 150.0;
  settings.wallHeight = 120.0;
  const meam::BinScene scene = meam::simulateBin(tetrahedron(), settings);
  EXPECT_EQ(scene.bin.size, Eigen::Vector3d(400.0, 150.0, 120.0));
  const double height = scene.bin.T_scene_bin.translation().z();
  EXPECT_EQ(height, 3 * 400.0);
  double farthest = 0.0;
  for (const meam::BinInstance& instance : scene.instances)
  {
    EXPECT_LT(std::abs(instance.T_scene_model.translation().y()), 75.0);
    farthest = std::max(farthest, std::abs(instance.T_scene_model.translation().x()));
  }
  EXPECT_GT(farthest, 75.0);
  // The rim fills the image's width, to both sides.
  const Eigen::Vector2d corner = meam::project(scene.sensor, Eigen::Vector3d(200.0, 75.0, height - 120.0));
  EXPECT_TRUE(corner.x() > 150 && corner.x() < 160 && corner.y() < 120) << corner.transpose();
}

TEST(BinScene, theTruthInTheImage)
{
  const meam::BinScene scene = meam::simulateBin(meam::makeSamplePart(), small(8));
  ASSERT_EQ(scene.instances.size(), 8u);
  int hidden = 0;
  for (int i = 0; i < 8; ++i)
  {
    const meam::BinInstance& instance = scene.instances[i];
    const meam::Mask& mask = instance.silhouette;
    EXPECT_EQ(instance.visiblePixels, std::count(scene.instanceOfPixel.begin(), scene.instanceOfPixel.end(), i));
    EXPECT_LE(instance.visiblePixels, mask.count());
    EXPECT_DOUBLE_EQ(instance.visibleFraction(), static_cast<double>(instance.visiblePixels) / mask.count());
    hidden += instance.visibleFraction() < 0.9;
    // What is seen of it is in its silhouette.
    for (int k = 0; k < 160 * 120; ++k)
    {
      if (scene.instanceOfPixel[k] == i)
      {
        const int column = k % 160 - mask.left;
        const int row = k / 160 - mask.top;
        ASSERT_TRUE(column >= 0 && column < mask.width && row >= 0 && row < mask.height);
        EXPECT_EQ(mask.pixels[row * mask.width + column], 255);
      }
    }
  }
  EXPECT_GT(hidden, 0);
}

TEST(BinScene, aCameraBesideTakesTheImage)
{
  meam::BinSceneSettings settings = small(3);
  settings.colored = true;
  settings.baseline = 100.0;
  settings.binSize = 150.0;
  const meam::BinScene scene = meam::simulateBin(tetrahedron(), settings);
  EXPECT_EQ(scene.image.channels, 3);
  EXPECT_EQ(scene.image.pixels.size(), 3u * 160u * 120u);
  const Eigen::Isometry3d T_scene_camera = scene.camera.T_camera_scene.inverse();
  EXPECT_NEAR(T_scene_camera.translation().norm(), 100.0, 1e-9);
  EXPECT_GT(scene.camera.fx, scene.sensor.fx);
  // It looks at the middle of the floor.
  const Eigen::Vector2d middle = meam::project(scene.camera, Eigen::Vector3d(0, 0, 450));
  EXPECT_NEAR(middle.x(), scene.camera.cx, 1e-9);
  EXPECT_NEAR(middle.y(), scene.camera.cy, 1e-9);
  // The same copies lie there, which are brighter than the floor.
  settings.baseline = 0.0;
  const meam::BinScene registered = meam::simulateBin(tetrahedron(), settings);
  EXPECT_EQ(registered.instances[2].T_scene_model.matrix(), scene.instances[2].T_scene_model.matrix());
  for (const auto& instance : scene.instances)
  {
    const Eigen::Vector3d inside = instance.T_scene_model * Eigen::Vector3d(6, 8, 10);
    const Eigen::Vector2d pixel = meam::project(scene.camera, inside);
    const int at = static_cast<int>(std::lround(pixel.y())) * 160 + static_cast<int>(std::lround(pixel.x()));
    EXPECT_GT(scene.image.pixels[3 * at + 1], 70);
  }
}

TEST(BinScene, copiesStandWhereTheyAreTold)
{
  const meam::BinScene fallen = meam::simulateBin(tetrahedron(), small(2));
  meam::BinSceneSettings settings = small(7);
  for (const meam::BinInstance& copy : fallen.instances)
  {
    settings.poses.push_back(copy.T_scene_model);
  }
  settings.quality.depthNoise = 0.0;
  const meam::BinScene standing = meam::simulateBin(tetrahedron(), settings);
  ASSERT_EQ(standing.instances.size(), 2u);
  EXPECT_EQ(standing.binSize, fallen.binSize);
  for (int i = 0; i < 2; ++i)
  {
    EXPECT_TRUE(standing.instances[i].T_scene_model.matrix() == fallen.instances[i].T_scene_model.matrix());
    EXPECT_EQ(standing.instances[i].visiblePixels, fallen.instances[i].visiblePixels);
  }
  settings.poses[0].linear() *= 2.0;
  EXPECT_THROW(meam::simulateBin(tetrahedron(), settings), meam::Error);
}

TEST(BinScene, theSeedDecides)
{
  const meam::BinScene one = meam::simulateBin(tetrahedron(), small(2, 1));
  const meam::BinScene again = meam::simulateBin(tetrahedron(), small(2, 1));
  EXPECT_TRUE(same(one.cloud.points, again.cloud.points));
  EXPECT_EQ(one.image.pixels, again.image.pixels);
  EXPECT_EQ(one.instances[1].T_scene_model.matrix(), again.instances[1].T_scene_model.matrix());
  EXPECT_NE(one.instances[1].T_scene_model.matrix(),
    meam::simulateBin(tetrahedron(), small(2, 2)).instances[1].T_scene_model.matrix());
}

TEST(BinScene, badInput)
{
  EXPECT_THROW(meam::simulateBin({}), meam::Error);
  EXPECT_THROW(meam::simulateBin({ meam::Points(4, { 1, 2, 3 }), tetrahedron().triangles }), meam::Error);
  steps::expectRefused<meam::BinSceneSettings>([](const auto& settings) { meam::simulateBin(tetrahedron(), settings); },
    { { [](auto& s) { s.copies = 0; } }, { [](auto& s) { s.width = 0; } }, { [](auto& s) { s.height = 100000; } },
      { [](auto& s) { s.binSize = 10.0; } }, { [](auto& s) { s.binSize = 1e9; } },
      { [](auto& s) { s.binWidth = 1e9; } }, { [](auto& s) { s.wallHeight = -1.0; } },
      { [](auto& s) { s.sensorHeight = 20.0; } }, { [](auto& s) { s.baseline = -1.0; } },
      { [](auto& s) { s.quality.dropout = 1.5; } } },
    small(2));
  steps::expectStops([](const meam::Progress& progress) { meam::simulateBin(tetrahedron(), small(2), progress); });
}
