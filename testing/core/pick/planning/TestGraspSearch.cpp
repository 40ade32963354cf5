// SPDX-License-Identifier: BSD-3-Clause
#include "pick/planning/GraspSearch.h"

#include "TestGrippers.h"

namespace
{
using Eigen::Vector3d;

/// The grasp's way in goes down, along the scene's z; tilted about its y.
meam::Pose lying(double x, double tilt = 0.0)
{
  meam::Pose pose;
  pose.T_scene_model.translation() = Vector3d(x, 0.0, 500.0);
  pose.T_scene_model.linear() = Eigen::AngleAxisd(tilt * M_PI / 180.0, Vector3d::UnitY()).toRotationMatrix();
  return pose;
}

/// Picks the first of the poses, all of which stand in the way.
meam::Pick pickFirst(const meam::Poses& poses, const meam::Gripper& gripper = grippers::jaws(),
  const meam::Grasp& grasp = grippers::fromAbove())
{
  meam::GraspSearch search(grippers::block(), {}, { grasp }, gripper, {});
  meam::PickSurroundings around;
  around.up = -Vector3d::UnitZ();
  for (int i = 0; i < static_cast<int>(poses.size()); ++i)
  {
    around.copies.push_back(i);
  }
  search.setObstacles(poses, std::vector<const meam::GraspSearch*>(poses.size(), &search), std::nullopt, around);
  return search.pickAt(poses[0], 0, 0, around);
}
}

TEST(GraspSearch, TiltIsBetweenTheWayInAndStraightDown)
{
  const Vector3d up = -Vector3d::UnitZ();
  Eigen::Isometry3d T = Eigen::Isometry3d::Identity(); // z, the way in, goes down
  EXPECT_NEAR(meam::tiltOf(T, up), 0.0, 1e-9);
  T.linear() = Eigen::AngleAxisd(M_PI / 6.0, Vector3d::UnitX()).toRotationMatrix();
  EXPECT_NEAR(meam::tiltOf(T, up), 30.0, 1e-9);
  T.linear() = Eigen::AngleAxisd(M_PI, Vector3d::UnitX()).toRotationMatrix();
  EXPECT_NEAR(meam::tiltOf(T, up), 180.0, 1e-9);
}

TEST(GraspSearch, ARotationIsNeededWhereTheJawsDoNotTouchThePartAtEachNearSymmetry)
{
  const auto needsRotation = [](double degrees, const meam::PlanSettings& settings = {})
  {
    meam::Symmetries symmetries;
    symmetries.near.push_back({ meam::turnAbout(Vector3d::UnitZ(), degrees * M_PI / 180.0, Vector3d::Zero()) });
    return meam::GraspSearch(grippers::block(), symmetries, { grippers::fromAbove() }, grippers::jaws(), settings)
      .needsRotation(0);
  };
  EXPECT_FALSE(needsRotation(180.0)) << "the jaws are on the other faces";
  EXPECT_TRUE(needsRotation(90.0)) << "10 mm inside the block";
  meam::PlanSettings counts;
  counts.rotationCounts = true;
  EXPECT_TRUE(needsRotation(180.0, counts));
  EXPECT_TRUE(
    meam::GraspSearch(grippers::block(), {}, { grippers::fromAbove() }, grippers::jaws(), {}).needsRotation(0))
    << "nothing is known";
}

TEST(GraspSearch, AFreePartIsTakenFromAbove)
{
  const meam::Pick pick = pickFirst({ lying(0) });
  EXPECT_TRUE(pick.possible()) << meam::describe(pick);
  EXPECT_NEAR(pick.tilt, 0.0, 1e-6);
  EXPECT_NEAR((pick.T_scene_grasp.translation() - Vector3d(0, 0, 500)).norm(), 0.0, 1e-9);
}

TEST(GraspSearch, AnotherCopyAtAFingerIsNamed)
{
  // The fingers reach from 13 to 21 mm; the second copy begins at 18.
  const meam::Pick blocked = pickFirst({ lying(0), lying(28) });
  EXPECT_EQ(blocked.obstruction, meam::PickObstruction::Instance);
  EXPECT_EQ(blocked.obstacle, 1);
  // At 30 mm it leaves 9 mm.
  const meam::Pick free = pickFirst({ lying(0), lying(40) });
  EXPECT_TRUE(free.possible()) << meam::describe(free);
  EXPECT_NEAR(free.clearance, 9.0, 1e-3);
}

TEST(GraspSearch, WhatTheGripperCannotDo)
{
  EXPECT_EQ(
    pickFirst({ lying(0) }, grippers::jaws(25.0)).obstruction, meam::PickObstruction::TooWide); // 20 + 2 * 3 > 25
  EXPECT_TRUE(pickFirst({ lying(0) }, grippers::jaws(26.0)).possible());
  meam::Gripper cup = grippers::jaws();
  cup.kind = meam::GraspKind::Suction;
  EXPECT_EQ(pickFirst({ lying(0) }, cup).obstruction, meam::PickObstruction::WrongKind);
  EXPECT_TRUE(pickFirst({ lying(0, 59.0) }).possible());
  const meam::Pick slanted = pickFirst({ lying(0, 61.0) }); // 60 degrees at most
  EXPECT_EQ(slanted.obstruction, meam::PickObstruction::Tilted);
  EXPECT_NEAR(slanted.tilt, 61.0, 1e-6);
}

TEST(GraspSearch, GraspsAreCheckedBefore)
{
  meam::Grasp far = grippers::fromAbove();
  far.T_model_grasp.translation().x() += 100.0;
  EXPECT_THROW(meam::GraspSearch(grippers::block(), {}, { far }, grippers::jaws(), {}), meam::Error);
  EXPECT_THROW(meam::GraspSearch(grippers::block(), {}, {}, grippers::jaws(), {}), meam::Error);
}
