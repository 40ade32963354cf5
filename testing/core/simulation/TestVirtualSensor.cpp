// SPDX-License-Identifier: BSD-3-Clause
#include "TestSteps.h"
#include "TestVirtualCamera.h"
#include "base/sequences/Sequences.h"
#include "mesh/TriangleMesh.h"
#include "simulation/VirtualSensor.h"

#include <cmath>
#include <cstring>
#include <set>

using namespace meam::test;

namespace
{
/// A sensor that makes no errors.
meam::SensorQuality perfect()
{
  meam::SensorQuality quality;
  quality.depthNoise = quality.depthStep = quality.dropout = quality.jumpDropout = 0.0;
  quality.imageNoise = quality.imageBlur = 0.0;
  quality.matchingWindow = 1;
  return quality;
}

meam::OrganizedCloud measure(const std::vector<meam::Body>& bodies, const meam::SensorQuality& quality)
{
  meam::Random random(1);
  return meam::measureDepth(meam::rasterize(meam::facetsOf(bodies), Floor, camera()), camera(), quality, random);
}

/// A plate that fills the view, tilted about the vertical axis.
meam::Body wall(const meam::TriangleMesh& mesh, double z, double tilt = 0.0)
{
  meam::Body body = at(mesh, 0.0, z, tilt);
  body.T_scene_model.linear() *= 10.0;
  return body;
}

/// The standard deviation of the depth of a plate at z.
double noiseAt(double z, double depthNoise)
{
  const meam::TriangleMesh mesh = plate(1e5f);
  meam::SensorQuality quality = perfect();
  quality.depthNoise = depthNoise;
  double squares = 0.0;
  const meam::OrganizedCloud cloud = measure({ wall(mesh, z) }, quality);
  for (const auto& point : cloud.points)
  {
    squares += (point.z() - z) * (point.z() - z);
  }
  return std::sqrt(squares / cloud.size());
}

/// A sensor with a second eye that makes no errors.
meam::SensorQuality stereo(double baseline)
{
  meam::SensorQuality quality = perfect();
  quality.stereoBaseline = baseline;
  return quality;
}

bool same(const meam::OrganizedCloud& a, const meam::OrganizedCloud& b)
{
  return a.points.size() == b.points.size() &&
         std::memcmp(a.points.data(), b.points.data(), a.points.size() * sizeof(a.points[0])) == 0;
}

int missing(const meam::OrganizedCloud& cloud)
{
  return static_cast<int>(
    std::count_if(cloud.points.begin(), cloud.points.end(), [](const auto& p) { return std::isnan(p.x()); }));
}
}

TEST(VirtualSensor, aPerfectOneMeasuresWhatIsThere)
{
  const meam::TriangleMesh mesh = plate();
  const meam::OrganizedCloud cloud = measure({ at(mesh, 0.0, 500.0) }, perfect());
  ASSERT_EQ(cloud.width, 101);
  ASSERT_EQ(cloud.size(), 101u * 101u);
  EXPECT_EQ(missing(cloud), 0);
  EXPECT_EQ(cloud.points[Middle], Eigen::Vector3f(0, 0, 500));
  EXPECT_TRUE(cloud.points[Middle + 10].isApprox(Eigen::Vector3f(50, 0, 500)));
  EXPECT_TRUE(cloud.points[Middle + 11].isApprox(Eigen::Vector3f(110, 0, 1000)));
}

TEST(VirtualSensor, noiseGrowsWithTheSquareOfTheDistance)
{
  EXPECT_NEAR(noiseAt(900.0, 0.3), 0.3 * 0.81, 0.01);
  EXPECT_NEAR(noiseAt(450.0, 0.3), 0.3 * 0.2025, 0.0025);
}

TEST(VirtualSensor, depthComesInSteps)
{
  const meam::TriangleMesh mesh = plate();
  meam::SensorQuality quality = perfect();
  quality.depthNoise = 1.0;
  quality.depthStep = 0.25;
  int different = 0;
  for (const auto& point : measure({ at(mesh, 0.0, 900.0, 0.3) }, quality).points)
  {
    EXPECT_NEAR(std::remainder(point.z(), 0.25), 0.0, 1e-4);
    different += std::abs(point.z() - 900.0) > 0.2 && std::abs(point.z() - 1000.0) > 0.2;
  }
  EXPECT_GT(different, 100);
}

TEST(VirtualSensor, dropouts)
{
  meam::SensorQuality quality = perfect();
  quality.dropout = 0.3;
  EXPECT_NEAR(missing(measure({}, quality)) / 10201.0, 0.3, 0.02);
  quality.dropout = 1.0;
  EXPECT_EQ(missing(measure({}, quality)), 10201);
}

TEST(VirtualSensor, nothingComesFromFlatViews)
{
  const meam::TriangleMesh mesh = plate();
  // To the left of the view's middle and tilted so that its middle is seen at 4 degrees.
  const double tilt = std::atan2(100.0, 500.0) + (90.0 - 4.0) * M_PI / 180.0;
  const meam::View view = meam::rasterize(meam::facetsOf({ at(mesh, -100.0, 500.0, -tilt) }), Floor, camera());
  const meam::OrganizedCloud cloud = measure({ at(mesh, -100.0, 500.0, -tilt) }, perfect());
  int seen = 0;
  for (std::size_t i = 0; i < cloud.size(); ++i)
  {
    EXPECT_EQ(std::isnan(cloud.points[i].z()), view.bodies[i] == 0);
    seen += view.bodies[i] == 0;
  }
  EXPECT_GT(seen, 10);
}

TEST(VirtualSensor, jumpsLosePoints)
{
  const meam::TriangleMesh mesh = plate();
  meam::SensorQuality quality = perfect();
  quality.jumpDropout = 1.0;
  // The border of a square of 21 x 21 pixels, and the pixels around it.
  EXPECT_EQ(missing(measure({ at(mesh, 0.0, 500.0) }, quality)), 4 * 20 + 4 * 22);
  quality.jumpDropout = 0.5;
  EXPECT_NEAR(missing(measure({ at(mesh, 0.0, 500.0) }, quality)), 84, 25);
}

TEST(VirtualSensor, thinRidgesAreLostAndWideOnesAreNot)
{
  meam::SensorQuality quality = perfect();
  quality.matchingWindow = 9;
  const auto middleIsLost = [&](float height, double z)
  {
    const meam::TriangleMesh ridge = plate(height);
    return std::isnan(measure({ at(ridge, 0.0, z) }, quality).points[Middle].z());
  };
  // 3 pixels of 5 mm, then 7.
  EXPECT_TRUE(middleIsLost(14.0f, 500.0));
  EXPECT_FALSE(middleIsLost(34.0f, 500.0));
  // One that rises by less than the sensor can tell is no ridge.
  EXPECT_FALSE(middleIsLost(28.0f, 985.0));
  // A slanted plate is not lost, its straight border neither.
  const meam::TriangleMesh mesh = plate();
  const meam::OrganizedCloud cloud = measure({ at(mesh, 0.0, 500.0, 0.9) }, quality);
  EXPECT_FALSE(std::isnan(cloud.points[Middle].z()));
  EXPECT_FALSE(std::isnan(cloud.points[Middle - 10 * 101].z()));
}

TEST(VirtualSensor, stereoLosesABandOnOneSideOfAJump)
{
  const meam::TriangleMesh mesh = plate();
  // Disparities 100 * 35 / 500 and 100 * 35 / 1000 differ by 3.5 pixels.
  const meam::OrganizedCloud cloud = measure({ at(mesh, 0.0, 500.0) }, stereo(35.0));
  for (int column = 0; column < 101; ++column)
  {
    EXPECT_EQ(std::isnan(cloud.points[50 * 101 + column].z()), column >= 37 && column < 40) << column;
  }
  EXPECT_EQ(missing(cloud), 3 * 21);
}

TEST(VirtualSensor, stepsOfDisparityGrowWithTheSquareOfTheDistance)
{
  const meam::TriangleMesh mesh = plate();
  meam::SensorQuality quality = stereo(50.0);
  quality.disparityStep = 1.0 / 32.0;
  for (const double z : { 500.0, 900.0 })
  {
    std::set<float> depths;
    for (const auto& point : measure({ wall(mesh, z, 0.1) }, quality).points)
    {
      depths.insert(point.z());
    }
    ASSERT_GT(depths.size(), 5u);
    // depth = 100 * 50 / disparity: 1.56 mm at 500 mm, 5.06 mm at 900 mm.
    for (auto next = std::next(depths.begin()); next != depths.end(); ++next)
    {
      EXPECT_NEAR(*next - *std::prev(next), *next * *std::prev(next) / 32.0 / 5000.0, 1e-3);
    }
  }
}

TEST(VirtualSensor, smoothedDisparitiesRoundEdgesAndLeavePlanes)
{
  const meam::TriangleMesh mesh = plate();
  meam::SensorQuality quality = stereo(1.0);
  quality.smoothingWindow = 5;
  const std::vector<meam::Body> plane{ wall(mesh, 600.0, 0.5) };
  const meam::OrganizedCloud smooth = measure(plane, quality);
  const meam::OrganizedCloud sharp = measure(plane, perfect());
  for (std::size_t i = 0; i < sharp.size(); ++i)
  {
    EXPECT_NEAR(smooth.points[i].z(), sharp.points[i].z(), 1e-3);
  }
  // Beside the right border of a plate: the mean of disparities 0.2 and 0.1.
  const meam::OrganizedCloud jump = measure({ at(mesh, 0.0, 500.0) }, quality);
  const double disparities[] = { 0.2, 0.18, 0.16, 0.14, 0.12, 0.1 };
  for (int k = 0; k < 6; ++k)
  {
    EXPECT_NEAR(jump.points[Middle + 8 + k].z(), 100.0 / disparities[k], 1e-2);
  }
}

TEST(VirtualSensor, disparityNoiseIsAlikeNearbyAndGrowsWithTheSquareOfTheDistance)
{
  const meam::TriangleMesh mesh = plate();
  meam::SensorQuality quality = stereo(50.0);
  quality.disparityNoise = 0.02;
  quality.noiseWindow = 5;
  double squares = 0.0, products = 0.0;
  const meam::OrganizedCloud cloud = measure({ wall(mesh, 900.0) }, quality);
  for (std::size_t i = 1; i < cloud.size(); ++i)
  {
    squares += std::pow(cloud.points[i].z() - 900.0, 2);
    products += (cloud.points[i].z() - 900.0) * (cloud.points[i - 1].z() - 900.0);
  }
  EXPECT_NEAR(std::sqrt(squares / cloud.size()), 0.02 * 900.0 * 900.0 / 5000.0, 0.2);
  EXPECT_NEAR(products / squares, 0.8, 0.05);
}

TEST(VirtualSensor, whatFacesTheSensorGlares)
{
  const meam::TriangleMesh mesh = plate();
  meam::SensorQuality quality = perfect();
  quality.glareAngle = 2.0;
  // A plane across the axis: pixels within 100 * tan(2 degrees) = 3.49 of the middle.
  const meam::OrganizedCloud cloud = measure({ wall(mesh, 900.0) }, quality);
  EXPECT_TRUE(std::isnan(cloud.points[Middle + 3].z()));
  EXPECT_FALSE(std::isnan(cloud.points[Middle + 4].z()));
  EXPECT_EQ(missing(cloud), 37);
  EXPECT_FALSE(std::isnan(measure({ wall(mesh, 900.0, 0.1) }, quality).points[Middle].z()));
}

TEST(VirtualSensor, rangeNoiseGrowsWithTheDistanceAndIncidence)
{
  const meam::TriangleMesh mesh = plate();
  meam::SensorQuality quality = perfect();
  quality.rangeNoise = 2.0;
  for (const auto& [z, tilt] : { std::pair(500.0, 0.0), std::pair(900.0, 0.0), std::pair(700.0, 0.9) })
  {
    const meam::OrganizedCloud noisy = measure({ wall(mesh, z, tilt) }, quality);
    const meam::OrganizedCloud clean = measure({ wall(mesh, z, tilt) }, perfect());
    double squares = 0.0;
    int pixels = 0;
    for (int row = 0; row < 101; ++row)
    {
      for (int column = 40; column <= 60; ++column, ++pixels)
      {
        const std::size_t i = row * 101 + column;
        squares += (noisy.points[i] - clean.points[i]).squaredNorm() / clean.points[i].squaredNorm();
      }
    }
    EXPECT_NEAR(std::sqrt(squares / pixels), 0.002 / std::sqrt(std::cos(tilt)), 0.0003);
  }
}

TEST(VirtualSensor, flyingPixelsLieBetweenBothSurfaces)
{
  const meam::TriangleMesh mesh = plate();
  meam::SensorQuality quality = perfect();
  quality.pixelBlur = 0.7;
  const meam::OrganizedCloud cloud = measure({ at(mesh, 0.0, 500.0) }, quality);
  int flying = 0;
  for (const auto& point : cloud.points)
  {
    EXPECT_TRUE(point.z() > 499.99f && point.z() < 1000.01f);
    flying += point.z() > 510.0f && point.z() < 990.0f;
  }
  // The border of a square of 21 x 21 pixels and the pixels around it, at least.
  EXPECT_GE(flying, 4 * 20 + 4 * 21);
}

TEST(VirtualSensor, kindsOfSensors)
{
  const meam::TriangleMesh mesh = plate();
  const std::vector<meam::Body> bodies{ at(mesh, 0.0, 500.0, 0.3) };
  std::vector<meam::OrganizedCloud> clouds;
  for (int kind = 0; kind < meam::SensorKinds; ++kind)
  {
    const meam::SensorQuality quality = meam::sensorQuality(static_cast<meam::SensorKind>(kind));
    meam::requireQuality(quality);
    clouds.push_back(measure(bodies, quality));
    EXPECT_TRUE(same(clouds.back(), measure(bodies, quality)));
    EXPECT_LT(missing(clouds.back()), 1500);
  }
  EXPECT_TRUE(same(clouds[0], measure(bodies, {})));
  EXPECT_FALSE(same(clouds[0], clouds[1]));
  EXPECT_FALSE(same(clouds[0], clouds[2]));
}

TEST(VirtualSensor, anImageIsNoisyAndBlurred)
{
  std::vector<Eigen::Vector3f> light(101 * 101, Eigen::Vector3f(0.6f, 0.4f, 0.2f));
  meam::Random random(1);
  const meam::Image colored = meam::takeImage(light, camera(), true, perfect(), random);
  ASSERT_EQ(colored.channels, 3);
  ASSERT_EQ(colored.pixels.size(), 3u * 101u * 101u);
  EXPECT_EQ(colored.pixels[3 * Middle], 153);
  EXPECT_EQ(colored.pixels[3 * Middle + 1], 102);
  EXPECT_EQ(colored.pixels[3 * Middle + 2], 51);

  light.assign(101 * 101, Eigen::Vector3f::Constant(0.4f));
  light[Middle].setConstant(0.8f);
  meam::SensorQuality quality = perfect();
  quality.imageBlur = 1.0;
  const meam::Image blurred = meam::takeImage(light, camera(), false, quality, random);
  ASSERT_EQ(blurred.channels, 1);
  EXPECT_NEAR(blurred.pixels[Middle], 102 + 102 * 0.16, 1.5);
  EXPECT_NEAR(blurred.pixels[Middle + 1], 102 + 102 * 0.097, 1.5);
  EXPECT_EQ(blurred.pixels[Middle + 20], 102);

  quality = perfect();
  quality.imageNoise = 3.0;
  const meam::Image noisy = meam::takeImage(light, camera(), false, quality, random);
  const double squares = meam::sumOf(noisy.pixels, [](double value) { return (value - 102.0) * (value - 102.0); });
  EXPECT_NEAR(std::sqrt(squares / noisy.pixels.size()), 3.2, 0.3);
}

TEST(VirtualSensor, badInput)
{
  EXPECT_NO_THROW(meam::requireQuality({}));
  steps::expectRefused<meam::SensorQuality>([](const auto& quality) { meam::requireQuality(quality); },
    { { [](auto& q) { q.depthNoise = -1.0; } }, { [](auto& q) { q.depthStep = NAN; } },
      { [](auto& q) { q.dropout = 1.5; } }, { [](auto& q) { q.jumpDropout = -0.1; } },
      { [](auto& q) { q.matchingWindow = 0; } }, { [](auto& q) { q.imageBlur = 1e9; } },
      { [](auto& q) { q.stereoBaseline = -1.0; } }, { [](auto& q) { q.disparityNoise = NAN; } },
      { [](auto& q) { q.smoothingWindow = 4; } }, { [](auto& q) { q.noiseWindow = 0; } },
      { [](auto& q) { q.multipath = 1.5; } }, { [](auto& q) { q.pixelBlur = -0.1; } } });
  meam::Random random(1);
  steps::expectStops([&](const meam::Progress& progress)
    { meam::measureDepth(meam::rasterize({}, Floor, camera()), camera(), meam::SensorQuality(), random, progress); });
}
