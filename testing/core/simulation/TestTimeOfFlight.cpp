// SPDX-License-Identifier: BSD-3-Clause
#include "TestVirtualCamera.h"
#include "simulation/TimeOfFlight.h"

#include <cmath>

using namespace meam::test;

namespace
{
meam::View viewOf(const std::vector<meam::Body>& bodies)
{
  return meam::rasterize(meam::facetsOf(bodies), Floor, camera());
}

std::vector<double> multipath(const meam::View& view, double share)
{
  return meam::multipathDepths(view, camera(), meam::returnedLight(view, camera()), share);
}
}

TEST(TimeOfFlight, lightFallsWithTheSquareOfTheDistanceAndTheCosine)
{
  const meam::TriangleMesh mesh = plate();
  const std::vector<double> flat = meam::returnedLight(viewOf({ at(mesh, 0.0, 500.0) }), camera());
  EXPECT_NEAR(flat[Middle], 4.0, 1e-9); // the floor's, at 1 m, is 1
  const std::vector<double> tilted = meam::returnedLight(viewOf({ at(mesh, 0.0, 500.0, M_PI / 3.0) }), camera());
  EXPECT_NEAR(tilted[Middle], 2.0, 1e-6);
}

TEST(TimeOfFlight, flyingPixelsLieBetweenBothDepths)
{
  const meam::TriangleMesh mesh = plate();
  const meam::View view = viewOf({ at(mesh, 0.0, 500.0) });
  const std::vector<double> light = meam::returnedLight(view, camera());
  const std::vector<double> depths = meam::mixedDepths(view.depths, light, camera(), 0.7);
  // Across the plate's right border, between columns 60 and 61.
  const std::size_t inside = Middle + 10;
  EXPECT_GT(depths[inside], 501.0);
  EXPECT_LT(depths[inside], depths[inside + 1]);
  EXPECT_LT(depths[inside + 1], 999.0);
  // By hand: of a Gaussian with sigma 0.7 about a fifth of the light comes from beyond the border, and the plate's is
  // about four times as strong.
  const double beyond = 1.0 - 0.5 * std::erfc(-0.5 / 0.7 / std::sqrt(2.0));
  EXPECT_NEAR(depths[inside + 1], (4 * beyond * 500 + (1 - beyond) * 1000) / (4 * beyond + 1 - beyond), 30.0);
  // Far from the border nothing mixes.
  EXPECT_NEAR(depths[Middle], 500.0, 1e-9);
  EXPECT_NEAR(depths[Middle + 20], 1000.0, 1e-9);
  for (const double depth : depths)
  {
    EXPECT_TRUE(depth > 499.999 && depth < 1000.001);
  }
}

TEST(TimeOfFlight, cornersSeemDeeperAndPlanesStay)
{
  const meam::TriangleMesh mesh = plate();
  // A valley: two plates at a right angle that meet on the axis, 500 mm deep.
  meam::Body left = at(mesh, -50.0 * std::sqrt(0.5), 500.0 - 50.0 * std::sqrt(0.5), -M_PI / 4.0);
  meam::Body right = at(mesh, 50.0 * std::sqrt(0.5), 500.0 - 50.0 * std::sqrt(0.5), M_PI / 4.0);
  const meam::View valley = viewOf({ left, right });
  ASSERT_NEAR(valley.depths[Middle + 2], 500.0 / 1.02, 1e-4);
  const std::vector<double> depths = multipath(valley, 0.5);
  const double nearCorner = depths[Middle + 2] - valley.depths[Middle + 2];
  const double farther = depths[Middle + 8] - valley.depths[Middle + 8];
  EXPECT_GT(nearCorner, 0.5);
  EXPECT_LT(nearCorner, 20.0);
  EXPECT_GT(farther, 0.0);
  // More light on the way, more of the error.
  EXPECT_LT(multipath(valley, 0.2)[Middle + 2], depths[Middle + 2]);
  EXPECT_EQ(multipath(valley, 0.0), valley.depths);
  // A ridge and a plane.
  left = at(mesh, -50.0 * std::sqrt(0.5), 500.0 + 50.0 * std::sqrt(0.5), M_PI / 4.0);
  right = at(mesh, 50.0 * std::sqrt(0.5), 500.0 + 50.0 * std::sqrt(0.5), -M_PI / 4.0);
  const meam::View ridge = viewOf({ left, right });
  EXPECT_NEAR(multipath(ridge, 0.5)[Middle + 2], ridge.depths[Middle + 2], 1e-9);
  const meam::View plane = viewOf({ at(mesh, 0.0, 500.0, 0.3) });
  EXPECT_NEAR(multipath(plane, 0.5)[Middle + 2], plane.depths[Middle + 2], 1e-6);
}
