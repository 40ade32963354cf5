// SPDX-License-Identifier: BSD-3-Clause
#include "pick/PickCollisions.h"

#include "TestGrippers.h"

namespace
{
using Eigen::Translation3d;

/// A gripper that is one square finger 10 mm wide, seen as a mesh or by the lengths of jaws that stand 20 mm apart.
meam::Gripper finger()
{
  meam::Gripper gripper = grippers::jaws();
  gripper.jawClearance = gripper.tipLength = 5.0;
  gripper.fingerThickness = 10.0;
  return gripper;
}

meam::Grasp grasp()
{
  meam::Grasp result;
  result.width = 10.0; // jaws from 10 to 20 mm on either side
  return result;
}

/// A cube of 10 mm about the origin.
meam::TriangleMesh cube() { return parts::box({ -5, -5, -5 }, { 5, 5, 5 }); }

Eigen::Isometry3d at(double x, double y, double z) { return Eigen::Isometry3d(Translation3d(x, y, z)); }

meam::Clearance clearance(const meam::PickCollisions& world, int held = 0, double wayIn = 30.0, double most = 50.0)
{
  return world.clearance(grasp(), Eigen::Isometry3d::Identity(), held, wayIn, most, 1.0);
}
}

TEST(PickCollisions, NothingAroundIsTheMost)
{
  const meam::PickCollisions world(cube(), finger());
  EXPECT_EQ(clearance(world).obstacle, meam::Obstacle::None);
  EXPECT_DOUBLE_EQ(clearance(world).distance, 50.0);
}

TEST(PickCollisions, DistancesOfAnotherCopyAreExact)
{
  meam::PickCollisions world(cube(), finger());
  world.setInstances({ at(0, 0, 0), at(32, 0, 0) }); // from 27 on; the jaw ends at 20
  auto found = clearance(world);
  EXPECT_EQ(found.obstacle, meam::Obstacle::Instance);
  EXPECT_EQ(found.instance, 1);
  EXPECT_NEAR(found.distance, 7.0, 1e-3);
  world.setInstances({ at(0, 0, 0), at(28, 13, 0) }); // 3 along x and 3 along y from the jaw's edge
  EXPECT_NEAR(clearance(world).distance, std::sqrt(18.0), 1e-3);
  world.setInstances({ at(0, 0, 0), at(24, 0, 0) });
  EXPECT_EQ(clearance(world).distance, 0.0);
  EXPECT_EQ(clearance(world).instance, 1);
  world.setInstances({ at(0, 0, 0) });
  EXPECT_EQ(clearance(world).obstacle, meam::Obstacle::None); // it is held
}

TEST(PickCollisions, TheWayInIsChecked)
{
  meam::PickCollisions world(cube(), finger());
  // Beside the jaws, behind the body: only the way in comes there.
  world.setInstances({ at(0, 0, 0), at(15, 0, -200) });
  EXPECT_EQ(clearance(world, 0, 30.0).obstacle, meam::Obstacle::Instance);
  EXPECT_NEAR(clearance(world, 0, 30.0).distance, 20.0, 1e-3);
  EXPECT_EQ(clearance(world, 0, 60.0).distance, 0.0);
}

TEST(PickCollisions, WhatIsBetweenTheJawsIsPressed)
{
  meam::PickCollisions world(cube(), finger());
  world.setInstances({ at(0, 0, 0), at(0, 9, 0) }); // from 4 to 14 along y: the jaws are 10 wide, from -5 to 5
  EXPECT_EQ(clearance(world).distance, 0.0);
  world.setInstances({ at(0, 0, 0), at(0, 11, 0) });
  EXPECT_GT(clearance(world).distance, 0.0);
}

TEST(PickCollisions, TheBinsWallsAndFloor)
{
  meam::PickCollisions world(cube(), finger());
  meam::Bin bin = grippers::bin(56.0, 200.0, 300.0);
  // Up is against the way in, z; the floor is 12 mm beyond the origin, 7 from the tips. The body is 40 + 2 * 10 wide:
  // wider than the bin.
  bin.T_scene_bin.translation().z() = 12.0;
  world.setBin(&bin);
  EXPECT_EQ(clearance(world).obstacle, meam::Obstacle::Bin);
  EXPECT_EQ(clearance(world).distance, 0.0);
  bin.size.x() = 100.0;
  world.setBin(&bin);
  EXPECT_NEAR(clearance(world).distance, 7.0, 1e-3);
  bin.size.x() = 66.0; // the body is 60 wide
  world.setBin(&bin);
  EXPECT_NEAR(clearance(world).distance, 3.0, 1e-3);
  world.setBin(nullptr);
  EXPECT_EQ(clearance(world).obstacle, meam::Obstacle::None);
}

TEST(PickCollisions, MeasuredPointsAreCubes)
{
  meam::PickCollisions world(cube(), finger());
  meam::Points points(3, Eigen::Vector3f(29.0f, 1.0f, 1.0f)); // in the cube from 28 to 30
  world.setMeasured(points, 2.0, 3);
  EXPECT_EQ(clearance(world).obstacle, meam::Obstacle::Measured);
  EXPECT_NEAR(clearance(world).distance, 8.0, 1e-3);
  world.setMeasured(points, 2.0, 4); // too few
  EXPECT_EQ(clearance(world).obstacle, meam::Obstacle::None);
  points.assign(3, Eigen::Vector3f(15.0f, 0.5f, 0.5f));
  world.setMeasured(points, 2.0, 3);
  EXPECT_EQ(clearance(world).distance, 0.0);
}

TEST(PickCollisions, AMeshIsLookedAtOnItsWay)
{
  meam::Gripper gripper;
  gripper.mesh = parts::box({ -2, -2, -20 }, { 2, 2, 0 });
  meam::PickCollisions world(cube(), gripper);
  world.setInstances({ at(0, 0, 100), at(9, 0, -60) }); // from 4 to 14; 2 beside the finger's way
  EXPECT_NEAR(clearance(world, 0, 50.0).distance, 2.0, 1e-3);
  EXPECT_GT(clearance(world, 0, 10.0).distance, 20.0);
  EXPECT_TRUE(world.touchesHeld(grasp(), 0.0, 1.0)); // its tip is in the middle of the cube
}

TEST(PickCollisions, TellsWhetherTheHeldPartIsTouched)
{
  const meam::PickCollisions world(cube(), finger());
  EXPECT_FALSE(world.touchesHeld(grasp(), 30.0, 1.0));
  meam::Grasp narrow = grasp();
  narrow.width = 0.0; // jaws from 5 mm on; a little less, and they touch
  narrow.T_model_grasp.translation().x() = 1.0;
  EXPECT_TRUE(world.touchesHeld(narrow, 30.0, 1.0));
}
