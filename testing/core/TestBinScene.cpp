// SPDX-License-Identifier: BSD-3-Clause
#include "simulation/BinScene.h"
#include "simulation/SamplePart.h"

#include <gtest/gtest.h>

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
  settings.depthNoise = settings.dropout = 0.0;
  const meam::BinScene scene = meam::simulateBin(tetrahedron(), settings);
  ASSERT_EQ(scene.instances.size(), 1u);
  EXPECT_DOUBLE_EQ(scene.instances[0].visibleFraction, 1.0);
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
  EXPECT_EQ(scene.instanceOfPixel.size(), 160u * 120u);
  EXPECT_EQ(scene.binSize, 200.0);
  // Every point projects to its pixel, and nothing is below the floor.
  for (std::size_t i = 0; i < scene.cloud.size(); ++i)
  {
    const Eigen::Vector3f& point = scene.cloud.points[i];
    if (point.allFinite())
    {
      ASSERT_NEAR(scene.focalLength * point.x() / point.z() + 79.5, i % 160, 1e-3);
      ASSERT_NEAR(scene.focalLength * point.y() / point.z() + 59.5, i / 160, 1e-3);
      ASSERT_LT(point.z(), 700.0f + 1.0f);
    }
  }
}

TEST(BinScene, visibleFractionsAreShares)
{
  const meam::BinScene scene = meam::simulateBin(meam::makeSamplePart(), small(5));
  ASSERT_EQ(scene.instances.size(), 5u);
  for (const auto& instance : scene.instances)
  {
    EXPECT_GE(instance.visibleFraction, 0.0);
    EXPECT_LE(instance.visibleFraction, 1.0);
  }
  // Nothing fell after the last one; from the first something is hidden.
  EXPECT_GT(scene.instances.back().visibleFraction, 0.97);
  EXPECT_LT(scene.instances.front().visibleFraction, 1.0);
}

TEST(BinScene, theSeedDecides)
{
  const meam::BinScene one = meam::simulateBin(tetrahedron(), small(4, 1));
  const meam::BinScene again = meam::simulateBin(tetrahedron(), small(4, 1));
  EXPECT_TRUE(same(one.cloud.points, again.cloud.points));
  EXPECT_EQ(one.image.pixels, again.image.pixels);
  EXPECT_EQ(one.instances[3].T_scene_model.matrix(), again.instances[3].T_scene_model.matrix());
  EXPECT_NE(one.instances[3].T_scene_model.matrix(),
    meam::simulateBin(tetrahedron(), small(4, 2)).instances[3].T_scene_model.matrix());
}

TEST(BinScene, badInput)
{
  EXPECT_THROW(meam::simulateBin({}), meam::Error);
  meam::TriangleMesh point = tetrahedron();
  point.vertices.assign(4, Eigen::Vector3f(1, 2, 3));
  EXPECT_THROW(meam::simulateBin(point), meam::Error);
  const auto fails = [](const auto& change)
  {
    meam::BinSceneSettings settings = small(2);
    change(settings);
    EXPECT_THROW(meam::simulateBin(tetrahedron(), settings), meam::Error);
  };
  fails([](auto& s) { s.copies = 0; });
  fails([](auto& s) { s.width = 0; });
  fails([](auto& s) { s.height = 100000; });
  fails([](auto& s) { s.binSize = 10.0; });
  fails([](auto& s) { s.binSize = 1e9; });
  fails([](auto& s) { s.sensorHeight = 20.0; });
  fails([](auto& s) { s.depthNoise = std::nan(""); });
  fails([](auto& s) { s.dropout = 1.5; });
  EXPECT_THROW(meam::simulateBin(tetrahedron(), small(2), [](double) { return false; }), meam::Aborted);
}
