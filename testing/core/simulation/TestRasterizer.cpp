// SPDX-License-Identifier: BSD-3-Clause
#include "TestVirtualCamera.h"

#include "base/Error.h"
#include "mesh/TriangleMesh.h"

#include <cmath>

using namespace meam::test;

TEST(Rasterizer, depthOfAPlate)
{
  const meam::TriangleMesh mesh = plate();
  const meam::View view = meam::rasterize(meam::facetsOf({ at(mesh, 0.0, 500.0) }), Floor, camera());
  EXPECT_DOUBLE_EQ(view.depths[Middle], 500.0);
  EXPECT_NEAR(view.normals[Middle].z(), -1.0, 1e-9);
  // 20 pixels wide; pixels whose middle is on the border belong to it.
  EXPECT_EQ(std::count(view.bodies.begin(), view.bodies.end(), 0), 21 * 21);
  EXPECT_EQ(view.bodies[Middle + 10], 0);
  EXPECT_EQ(view.bodies[Middle + 11], -1);
  EXPECT_DOUBLE_EQ(view.depths[Middle + 11], 1000.0);
}

TEST(Rasterizer, theNearerPlateHidesTheOther)
{
  const meam::TriangleMesh mesh = plate();
  // At 250 mm a plate is 40 pixels wide; the far one reaches 10 pixels out of its right side.
  const std::vector<meam::Facet> facets = meam::facetsOf({ at(mesh, 100.0, 500.0), at(mesh, 0.0, 250.0) });
  const meam::View view = meam::rasterize(facets, Floor, camera());
  EXPECT_EQ(std::count(view.bodies.begin(), view.bodies.end(), 0), 21 * 10);
  EXPECT_EQ(std::count(view.bodies.begin(), view.bodies.end(), 1), 41 * 41);
  const std::vector<meam::Mask> masks = meam::silhouettesOf(facets, 2, camera());
  ASSERT_EQ(masks.size(), 2u);
  EXPECT_EQ(masks[0].count(), 21 * 21);
  EXPECT_EQ(masks[1].count(), 41 * 41);
  EXPECT_EQ(masks[0].left, 60);
  EXPECT_EQ(masks[0].top, 40);
  EXPECT_EQ(masks[0].width, 21);
  EXPECT_EQ(masks[0].height, 21);
  EXPECT_EQ(meam::silhouettesOf(facets, 1, camera()).size(), 1u);
}

TEST(Rasterizer, aSilhouetteEndsWithTheImage)
{
  const meam::TriangleMesh mesh = plate();
  const std::vector<meam::Mask> masks =
    meam::silhouettesOf(meam::facetsOf({ at(mesh, 250.0, 500.0), at(mesh, 900.0, 500.0) }), 2, camera());
  EXPECT_EQ(masks[0].left, 90);
  EXPECT_EQ(masks[0].width, 11);
  EXPECT_EQ(masks[0].count(), 11 * 21);
  EXPECT_EQ(masks[1].count(), 0);
}

TEST(Rasterizer, aTiltedPlateIsExactInPerspective)
{
  const meam::TriangleMesh mesh = plate();
  const double tilt = 0.7;
  const meam::View view = meam::rasterize(meam::facetsOf({ at(mesh, 10.0, 500.0, tilt) }), Floor, camera());
  int seen = 0;
  for (int i = 0; i < 101 * 101; ++i)
  {
    if (view.bodies[i] == 0)
    {
      // In the plane through (10, 0, 500) with normal (sin, 0, cos).
      const double x = view.depths[i] * (i % 101 - 50) / 100.0 - 10.0;
      EXPECT_NEAR(x * std::sin(tilt) + (view.depths[i] - 500.0) * std::cos(tilt), 0.0, 1e-9);
      ++seen;
    }
  }
  EXPECT_GT(seen, 200);
}

TEST(Rasterizer, aCameraBesideSeesTheSamePlaces)
{
  const meam::TriangleMesh mesh = plate();
  const double tilt = 0.4;
  meam::Camera beside = camera();
  Eigen::Isometry3d T_scene_camera = Eigen::Isometry3d::Identity();
  T_scene_camera.translation().x() = 200.0;
  T_scene_camera.linear() = Eigen::AngleAxisd(-0.3, Eigen::Vector3d::UnitY()).matrix();
  beside.T_camera_scene = T_scene_camera.inverse();
  const meam::View view = meam::rasterize(meam::facetsOf({ at(mesh, 20.0, 600.0, tilt) }), Floor, beside);
  int seen = 0;
  for (int i = 0; i < 101 * 101; ++i)
  {
    const Eigen::Vector3d point = meam::unproject(beside, { i % 101, i / 101 }, view.depths[i]);
    if (view.bodies[i] == 0)
    {
      EXPECT_NEAR((point.x() - 20.0) * std::sin(tilt) + (point.z() - 600.0) * std::cos(tilt), 0.0, 1e-6);
      EXPECT_LT(view.normals[i].z(), 0.0); // in the scene's frame
      ++seen;
    }
    else
    {
      EXPECT_NEAR(point.z(), Floor, 1e-6);
    }
  }
  EXPECT_GT(seen, 100);
}

TEST(Rasterizer, badInput)
{
  const meam::TriangleMesh mesh = plate();
  EXPECT_THROW(meam::rasterize(meam::facetsOf({ at(mesh, 0.0, 0.0) }), Floor, camera()), meam::Error);
  EXPECT_THROW(meam::rasterize(meam::facetsOf({ at(mesh, 0.0, -500.0) }), Floor, camera()), meam::Error);
}
