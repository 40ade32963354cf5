// SPDX-License-Identifier: BSD-3-Clause
#include "pick/proposal/GraspSpread.h"

#include <gtest/gtest.h>

namespace
{
using meam::FreeTurn;
using meam::Grasp;
using meam::Grasps;

/// Jaws that come from above and close along a direction at an angle (degrees) to x.
Grasp above(double x, double angle, double quality)
{
  Grasp grasp;
  grasp.quality = quality;
  const double radians = angle * M_PI / 180.0;
  grasp.T_model_grasp = meam::graspFrame({ x, 0, 0 }, { 0, 0, -1 }, { std::cos(radians), std::sin(radians), 0 });
  return grasp;
}

/// The qualities of those that are chosen; 10 mm of spread.
std::vector<double> chosen(
  const Grasps& all, int most = 20, FreeTurn turn = FreeTurn::None, const meam::Symmetries& symmetries = {})
{
  std::vector<double> qualities;
  const auto freeTurnOf = [&](const Grasp&) { return turn; };
  for (const Grasp& grasp : meam::spreadOut(all, symmetries, 10.0, 100.0, most, freeTurnOf))
  {
    EXPECT_EQ(grasp.freeTurn, turn);
    qualities.push_back(grasp.quality);
  }
  return qualities;
}

using Qualities = std::vector<double>;
}

TEST(GraspSpread, nearOnesThatFaceTheSameWayAreOne)
{
  EXPECT_EQ(chosen({ above(0, 0, 1.0), above(5, 0, 0.9), above(12, 0, 0.8) }), Qualities({ 1.0, 0.8 }));
  EXPECT_EQ(chosen({ above(0, 0, 1.0), above(0, 30, 0.9), above(0, 60, 0.8) }), Qualities({ 1.0, 0.8 }));
  EXPECT_EQ(chosen({ above(0, 0, 1.0), above(0, 180, 0.9) }), Qualities({ 1.0 })); // the jaws have changed places
  EXPECT_TRUE(chosen({}).empty());
}

TEST(GraspSpread, equalOnesAreOne)
{
  const Grasps all{ above(30, 0, 1.0), above(-30, 0, 0.9), above(0, 90, 0.8), above(0, 0, 0.7) };
  EXPECT_EQ(chosen(all).size(), 4u);
  meam::Symmetries half;
  half.discrete.push_back(meam::turnAbout(Eigen::Vector3d::UnitZ(), M_PI, Eigen::Vector3d::Zero()));
  EXPECT_EQ(chosen(all, 20, FreeTurn::None, half), Qualities({ 1.0, 0.8, 0.7 }));
  EXPECT_EQ(chosen(all, 20, FreeTurn::Approach), Qualities({ 1.0, 0.9, 0.8 }));
}

TEST(GraspSpread, onePlaceDoesNotTakeAll)
{
  // Turned by 60 degrees at one place, and a worse one elsewhere: worth 0.7 * 0.8 with the same way in, and the second
  // at the first place 0.9 * 0.8 * 0.8, and the third the same twice.
  const Grasps all{ above(0, 0, 1.0), above(0, 60, 0.9), above(0, 120, 0.85), above(50, 0, 0.7) };
  EXPECT_EQ(chosen(all, 3), Qualities({ 1.0, 0.9, 0.7 }));
}
