// SPDX-License-Identifier: BSD-3-Clause
#include "pick/BinDetection.h"

#include "TestFiles.h"
#include "TestGrids.h"
#include "TestScale.h"
#include "simulation/BinScene.h"
#include "simulation/parts/SamplePart.h"

#include <random>

namespace
{
/// What a sensor at the origin sees of a bin turned by `angle` about its line of sight: walls 5 mm thick and 60 mm high
/// around 200 x 120 mm, the floor 500 mm away, and a block that is higher than the rim.
meam::OrganizedCloud scanOf(double angle, float noise, bool withBin = true)
{
  std::mt19937 random(1);
  std::normal_distribution<float> error(0.0f, noise > 0.0f ? noise : 1e-6f);
  return grids::centered(400, 300,
    [&](double x, double y)
    {
      const double u = std::abs(std::cos(angle) * (x - 10.0) + std::sin(angle) * (y + 5.0));
      const double v = std::abs(std::cos(angle) * (y + 5.0) - std::sin(angle) * (x - 10.0));
      const bool onRim = withBin && u < 105.0 && v < 65.0 && (u > 100.0 || v > 60.0);
      return (u < 20.0 && v < 30.0 ? 430.0 : onRim ? 440.0 : 500.0) + error(random);
    });
}
}

TEST(BinDetection, FindsTheRimUnderWhatIsHigher)
{
  for (const float noise : { 0.0f, 0.5f })
  {
    for (const double angle : { 0.0, 0.4, 1.2 })
    {
      const meam::Bin bin = meam::detectBin(scanOf(angle, noise));
      const Eigen::Vector3d size(
        std::max(bin.size.x(), bin.size.y()), std::min(bin.size.x(), bin.size.y()), bin.size.z());
      EXPECT_NEAR(size.x(), 200.0, 4.0) << angle << " " << noise;
      EXPECT_NEAR(size.y(), 120.0, 4.0) << angle << " " << noise;
      EXPECT_NEAR(size.z(), 60.0, 2.5) << angle << " " << noise;
      EXPECT_NEAR(bin.wall, 5.0, 2.0) << angle << " " << noise;
      EXPECT_LT((bin.T_scene_bin.translation() - Eigen::Vector3d(10, -5, 500)).norm(), 2.5) << angle << " " << noise;
      EXPECT_GT(-bin.T_scene_bin.linear().col(2).z(), 0.999);
      EXPECT_NO_THROW(meam::requireBin(bin));
    }
  }
}

TEST(BinDetection, FindsTheSimulatedOne)
{
  meam::BinSceneSettings settings;
  if (SmallData)
  {
    settings.copies = 5;
    settings.width = settings.height = 300;
  }
  const meam::BinScene scene = meam::simulateBin(meam::makeSamplePart(), settings);
  const meam::Bin bin = meam::detectBin(scene.cloud);
  EXPECT_LT((bin.size - scene.bin.size).cwiseAbs().maxCoeff(), 0.02 * scene.binSize);
  EXPECT_LT((bin.T_scene_bin.translation() - scene.bin.T_scene_bin.translation()).norm(), 0.02 * scene.binSize);
  EXPECT_NEAR(bin.wall, scene.bin.wall, 0.5 * scene.bin.wall);
}

TEST(BinDetection, SaysWhenThereIsNone) { EXPECT_THROW(meam::detectBin(scanOf(0.3, 0.1f, false)), meam::Error); }

TEST(BinDetection, PointsAloneAreRefusedWithTheOptionToChange)
{
  for (const meam::OrganizedCloud& cloud : { meam::OrganizedCloud(), meam::OrganizedCloud{ 1, 1, { { 0, 0, 500 } } } })
  {
    const std::string error = files::errorOf([&] { meam::detectBin(cloud); });
    EXPECT_TRUE(files::contains(error, "--no-bin")) << error;
  }
}
