// SPDX-License-Identifier: BSD-3-Clause
#include "simulation/VirtualSensor.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace
{
/// A square plate of side 100 mm around the origin, facing the sensor.
meam::TriangleMesh plate()
{
  meam::TriangleMesh mesh;
  mesh.vertices = { { -50, -50, 0 }, { 50, -50, 0 }, { 50, 50, 0 }, { -50, 50, 0 } };
  mesh.triangles = { { 0, 2, 1 }, { 0, 3, 2 } };
  return mesh;
}

meam::Body at(const meam::TriangleMesh& mesh, double x, double z, double tilt = 0.0)
{
  meam::Body body{ &mesh, Eigen::Isometry3d::Identity(), 0.6 };
  body.T_scene_model.translation() << x, 0.0, z;
  body.T_scene_model.linear() = Eigen::AngleAxisd(tilt, Eigen::Vector3d::UnitY()).matrix();
  return body;
}

/// 101 x 101 pixels; a millimetre is 100 / z of them.
meam::VirtualSensorSettings sensor()
{
  meam::VirtualSensorSettings settings;
  settings.width = settings.height = 101;
  settings.focalLength = 100.0;
  settings.floor = 1000.0;
  return settings;
}

meam::SensorData render(const std::vector<meam::Body>& bodies, const meam::VirtualSensorSettings& settings = sensor())
{
  meam::Random random(1);
  return meam::renderBodies(bodies, settings, random);
}

constexpr int Middle = 50 * 101 + 50;
}

TEST(VirtualSensor, depthOfAPlate)
{
  const meam::TriangleMesh mesh = plate();
  const meam::SensorData data = render({ at(mesh, 0.0, 500.0) });
  ASSERT_EQ(data.cloud.width, 101);
  ASSERT_EQ(data.cloud.size(), 101u * 101u);
  EXPECT_EQ(data.cloud.points[Middle], Eigen::Vector3f(0, 0, 500));
  // 20 pixels wide; pixels whose middle is on the border belong to it.
  EXPECT_EQ(data.visiblePixels[0], 21 * 21);
  EXPECT_EQ(data.alonePixels[0], 21 * 21);
  EXPECT_TRUE(data.cloud.points[Middle + 10].isApprox(Eigen::Vector3f(50, 0, 500)));
  EXPECT_TRUE(data.cloud.points[Middle + 11].isApprox(Eigen::Vector3f(110, 0, 1000)));
  EXPECT_EQ(data.bodyOfPixel[Middle + 10], 0);
  EXPECT_EQ(data.bodyOfPixel[Middle + 11], -1);
  EXPECT_EQ(data.image.pixels.size(), data.cloud.size());
}

TEST(VirtualSensor, theNearerPlateHidesTheOther)
{
  const meam::TriangleMesh mesh = plate();
  // At 250 mm a plate is 40 pixels wide; the far one reaches 10 pixels out of its right side.
  const meam::SensorData data = render({ at(mesh, 100.0, 500.0), at(mesh, 0.0, 250.0) });
  EXPECT_EQ(data.alonePixels[0], 21 * 21);
  EXPECT_EQ(data.alonePixels[1], 41 * 41);
  EXPECT_EQ(data.visiblePixels[0], 21 * 10);
  EXPECT_EQ(data.visiblePixels[1], 41 * 41);
}

TEST(VirtualSensor, aTiltedPlateIsExactInPerspective)
{
  const meam::TriangleMesh mesh = plate();
  const double tilt = 0.7;
  const meam::SensorData data = render({ at(mesh, 10.0, 500.0, tilt) });
  int seen = 0;
  for (std::size_t i = 0; i < data.cloud.size(); ++i)
  {
    if (data.bodyOfPixel[i] == 0)
    {
      // In the plane through (10, 0, 500) with normal (sin, 0, cos).
      const Eigen::Vector3d d = data.cloud.points[i].cast<double>() - Eigen::Vector3d(10, 0, 500);
      EXPECT_NEAR(d.x() * std::sin(tilt) + d.z() * std::cos(tilt), 0.0, 1e-3);
      ++seen;
    }
  }
  EXPECT_GT(seen, 200);
}

TEST(VirtualSensor, shadingTellsFacesApartAndPlatesCastShadows)
{
  const meam::TriangleMesh mesh = plate();
  const int left = render({ at(mesh, 0.0, 500.0, -0.7) }).image.pixels[Middle];
  const int right = render({ at(mesh, 0.0, 500.0, 0.7) }).image.pixels[Middle];
  EXPECT_GT(std::abs(left - right), 20);
  const meam::SensorData empty = render({});
  EXPECT_EQ(*std::min_element(empty.image.pixels.begin(), empty.image.pixels.end()),
    *std::max_element(empty.image.pixels.begin(), empty.image.pixels.end()));
  const meam::SensorData data = render({ at(mesh, 0.0, 800.0) });
  int shaded = 0;
  for (std::size_t i = 0; i < data.cloud.size(); ++i)
  {
    shaded += data.bodyOfPixel[i] < 0 && data.image.pixels[i] < 0.8 * empty.image.pixels[i];
  }
  EXPECT_GT(shaded, 20);
}

TEST(VirtualSensor, noiseIsAsAskedFor)
{
  meam::VirtualSensorSettings settings = sensor();
  settings.depthNoise = 0.5;
  const meam::SensorData data = render({}, settings);
  double squares = 0.0;
  for (const auto& point : data.cloud.points)
  {
    const double along = point.cast<double>().norm() - 1000.0 * point.cast<double>().norm() / point.z();
    squares += along * along;
  }
  EXPECT_NEAR(std::sqrt(squares / data.cloud.size()), 0.5, 0.02);
  settings.dropout = 1.0;
  for (const auto& point : render({}, settings).cloud.points)
  {
    EXPECT_TRUE(std::isnan(point.x()));
  }
}

TEST(VirtualSensor, badInput)
{
  const meam::TriangleMesh mesh = plate();
  EXPECT_THROW(render({ at(mesh, 0.0, 0.0) }), meam::Error);
  EXPECT_THROW(render({ at(mesh, 0.0, -500.0) }), meam::Error);
  meam::Random random(1);
  EXPECT_THROW(meam::renderBodies({}, sensor(), random, [](double) { return false; }), meam::Aborted);
}
