// SPDX-License-Identifier: BSD-3-Clause
#include "pose/objective/SurfaceMisfit.h"

#include "TestScene.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

namespace
{
meam::TriangleMesh stairs(float step)
{
  return parts::prism({ { 0, 0 }, { 60, 0 }, { 60, 15 + step }, { 30, 15 + step }, { 30, 15 }, { 0, 15 } }, 40);
}

meam::TriangleMesh stairsOfFour() { return stairs(4); }

/// Stairs as they lie, y upwards, raised by so much.
Eigen::Isometry3d lying(double raised = 0.0)
{
  Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
  T.linear() = Eigen::AngleAxisd(M_PI / 2.0, Eigen::Vector3d::UnitX()).toRotationMatrix();
  T.translation().z() = raised;
  return T;
}

/// mm, of the stairs of 4 mm, raised, where stairs of another step lie; what is expected must not be less than it is.
double misfitWhereStairsLie(float step, double raised = 0.0)
{
  const meam::TrainedModel& model = scenes::trained<stairsOfFour>();
  const meam::Scene scene = scenes::alone(stairs(step), model, lying());
  const meam::SurfaceMisfit misfit(scene, model);
  EXPECT_GE(misfit.expected(), 4e-4 * model.diameter);
  EXPECT_LT(misfit.excused(), 0.1) << "flat faces";
  return misfit.at(scene.T_local_scene() * lying(raised));
}

/// A surface seen from above, points 1 mm apart.
meam::Points surfaceOf(const std::function<float(float, float)>& height)
{
  return parts::lattice({ 0, 0 }, { 119, 119 }, 1.0f, height);
}
}

TEST(SurfaceMisfit, ThePartItselfFits) { EXPECT_LT(misfitWhereStairsLie(4), 0.06); }

TEST(SurfaceMisfit, APoseThatIsOffLiesOffByThatMuch) { EXPECT_NEAR(misfitWhereStairsLie(4, 1.0), 1.0, 0.06); }

TEST(SurfaceMisfit, OfALookalikeHalfOfWhoseSurfaceIsAMillimeterOff)
{
  EXPECT_NEAR(misfitWhereStairsLie(5), std::sqrt(0.5), 0.06); // one of two equal treads
}

TEST(SurfaceMisfit, WhereNothingIsSeenThereIsNone)
{
  const meam::TrainedModel& model = scenes::trained<stairsOfFour>();
  const meam::Scene scene = scenes::alone(stairs(4), model, lying());
  Eigen::Isometry3d away = lying();
  away.translation().x() = 500.0;
  EXPECT_EQ(meam::SurfaceMisfit(scene, model).at(scene.T_local_scene() * away), 0.0);
}

TEST(ScanUnevenness, OfAPlaneHoweverItIsTiltedThereIsNone)
{
  const Eigen::Vector3d up = Eigen::Vector3d::UnitZ();
  EXPECT_LT(meam::scanUnevenness(surfaceOf([](float, float) { return 7.0f; }), up, 5.0), 1e-4);
  EXPECT_LT(meam::scanUnevenness(surfaceOf([](float x, float y) { return 0.3f * x - 0.2f * y; }), up, 5.0), 1e-4);
}

TEST(ScanUnevenness, OfWavesItIsTheirRootMeanSquareAndNoiseAveragesOut)
{
  const Eigen::Vector3d up = Eigen::Vector3d::UnitZ();
  // Ridges as wide as two patches: the mean of a patch lies off by up to their height.
  const auto waves = [](float x, float) { return 0.5f * std::sin(2.0f * static_cast<float>(M_PI) * x / 15.0f); };
  const double uneven = meam::scanUnevenness(surfaceOf(waves), up, 5.0);
  EXPECT_GT(uneven, 0.15);
  EXPECT_LT(uneven, 0.5 * std::sqrt(0.5));
  const auto noise = [](float x, float y) { return static_cast<int>(x + y) % 2 == 0 ? 0.5f : -0.5f; };
  EXPECT_LT(meam::scanUnevenness(surfaceOf(noise), up, 5.0), 0.05);
  // Steps in half of what is seen are no unevenness of the scan.
  const auto half = [&](float x, float y) { return x < 60.0f ? 0.0f : 20.0f * waves(x, y); };
  EXPECT_LT(meam::scanUnevenness(surfaceOf(half), up, 5.0), 1e-4);
  EXPECT_EQ(meam::scanUnevenness({}, up, 5.0), 0.0);
}
