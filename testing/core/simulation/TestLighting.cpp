// SPDX-License-Identifier: BSD-3-Clause
#include "TestVirtualCamera.h"
#include "base/sequences/Sequences.h"
#include "mesh/TriangleMesh.h"
#include "simulation/Lighting.h"

#include <algorithm>
#include <cmath>

using namespace meam::test;

namespace
{
std::vector<Eigen::Vector3f> colorsOf(const std::vector<meam::Body>& bodies, const meam::Camera& seenBy = camera())
{
  const std::vector<meam::Facet> facets = meam::facetsOf(bodies);
  return meam::illuminate(
    meam::rasterize(facets, Floor, seenBy), seenBy, facets, bodies, Eigen::Vector3d(0.2, 0.25, 0.3), 10.0);
}

/// The green light of every pixel.
std::vector<double> lightOf(const std::vector<meam::Body>& bodies, const meam::Camera& seenBy = camera())
{
  return meam::mapped<double>(colorsOf(bodies, seenBy), [&](const auto& color) { return color.y(); });
}
}

TEST(Lighting, showsColors)
{
  const meam::TriangleMesh mesh = plate();
  meam::Body body = at(mesh, 0.0, 500.0);
  body.albedo << 0.8, 0.4, 0.2;
  const std::vector<Eigen::Vector3f> colors = colorsOf({ body });
  EXPECT_NEAR(colors[Middle].x() / colors[Middle].y(), 2.0f, 1e-4f);
  EXPECT_NEAR(colors[Middle].y() / colors[Middle].z(), 2.0f, 1e-4f);
  EXPECT_NEAR(colors[0].x() / colors[0].z(), 2.0f / 3.0f, 1e-4f);
}

TEST(Lighting, tellsFacesApart)
{
  const meam::TriangleMesh mesh = plate();
  EXPECT_GT(
    std::abs(lightOf({ at(mesh, 0.0, 500.0, -0.7) })[Middle] - lightOf({ at(mesh, 0.0, 500.0, 0.7) })[Middle]), 0.1);
}

TEST(Lighting, textureIsSlight)
{
  const std::vector<double> light = lightOf({});
  const auto [low, high] = std::minmax_element(light.begin(), light.end());
  EXPECT_LT(*high, 1.07 * *low);
  EXPECT_GT(*high, 1.005 * *low);
}

TEST(Lighting, platesCastShadows)
{
  const meam::TriangleMesh mesh = plate();
  const std::vector<double> empty = lightOf({});
  const std::vector<double> light = lightOf({ at(mesh, 0.0, 800.0) });
  const std::size_t shaded = meam::indicesWhere(light.size(), [&](int i) { return light[i] < 0.8 * empty[i]; }).size();
  EXPECT_GT(shaded, 20);
  EXPECT_LT(shaded, 2000);
}

TEST(Lighting, doesNotDependOnTheCamera)
{
  const meam::TriangleMesh mesh = plate();
  meam::Camera beside = camera();
  beside.T_camera_scene.translation().x() = -100.0;
  const std::vector<meam::Body> bodies{ at(mesh, 0.0, 500.0) };
  // 100 mm are 20 pixels at this distance.
  EXPECT_NEAR(lightOf(bodies)[Middle] / lightOf(bodies, beside)[Middle - 20], 1.0, 0.01);
}
