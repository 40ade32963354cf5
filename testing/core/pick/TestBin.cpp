// SPDX-License-Identifier: BSD-3-Clause
#include "pick/Bin.h"

#include "base/Error.h"
#include "base/sequences/Sequences.h"

#include <gtest/gtest.h>

namespace
{
meam::Bin ownBin()
{
  meam::Bin result;
  result.T_scene_bin.translation() = Eigen::Vector3d(10.0, 20.0, 30.0);
  result.size = Eigen::Vector3d(200.0, 100.0, 50.0);
  result.wall = 4.0;
  return result;
}
}

TEST(Bin, IsAFloorAndFourWalls)
{
  const auto boxes = meam::boxesOf(ownBin());
  ASSERT_EQ(boxes.size(), 5u);
  // The block outside, less the room inside.
  EXPECT_NEAR(meam::sumOf(boxes, [](const auto& box) { return box.size.prod(); }),
    208.0 * 108.0 * 54.0 - 200.0 * 100.0 * 50.0, 1e-6);
}

TEST(Bin, TellsDistances)
{
  const auto from = [](double x, double y, double z)
  { return meam::distanceFrom(ownBin(), Eigen::Vector3d(10.0 + x, 20.0 + y, 30.0 + z)); };
  EXPECT_NEAR(from(0, 0, 12), 12.0, 1e-9);  // over the floor
  EXPECT_NEAR(from(0, 0, -2), 0.0, 1e-9);   // in it
  EXPECT_NEAR(from(-97, 0, 25), 3.0, 1e-9); // before a wall
  EXPECT_NEAR(from(0, 52, 25), 0.0, 1e-9);  // in a wall
  EXPECT_NEAR(from(0, -60, 20), 6.0, 1e-9); // behind it
  EXPECT_NEAR(from(97, 0, 54), 5.0, 1e-9);  // 3 and 4 from the rim
  EXPECT_NEAR(from(0, 0, -14), 10.0, 1e-9); // under the floor
}

TEST(Bin, RefusesWhatIsNone)
{
  meam::Bin flat = ownBin();
  flat.size.z() = 0.0;
  EXPECT_THROW(meam::requireBin(flat), meam::Error);
  meam::Bin scaled = ownBin();
  scaled.T_scene_bin.linear() *= 2.0;
  EXPECT_THROW(meam::requireBin(scaled), meam::Error);
  EXPECT_NO_THROW(meam::requireBin(ownBin()));
}
