// SPDX-License-Identifier: BSD-3-Clause
#include "pick/PickTrial.h"

#include "TestGrippers.h"

namespace
{
meam::TriangleMesh smallCube() { return parts::box({ -10, -10, -10 }, { 10, 10, 10 }); }

Eigen::Isometry3d shifted(double x, double y, double z) { return Eigen::Isometry3d(Eigen::Translation3d(x, y, z)); }

/// From above, along z, the jaws 23 mm apart.
meam::PickTrial pick(const Eigen::Isometry3d& where, const std::vector<Eigen::Isometry3d>& truths)
{
  meam::Gripper gripper;
  gripper.jawClearance = 1.5;
  meam::Grasp grasp;
  grasp.width = 20.0;
  meam::Bin bin = grippers::bin(300.0, 300.0, 60.0);
  bin.T_scene_bin.translation().z() = 20.0;
  grasp.T_model_grasp = where;
  return meam::tryPicks(smallCube(), gripper, { grasp }, truths, &bin).front();
}
}

TEST(PickTrial, HoldsWhatIsThere)
{
  const auto trial = pick(shifted(0, 0, 0), { shifted(60, 0, 0), shifted(0, 0, 0) });
  EXPECT_EQ(trial.outcome, meam::TrialOutcome::Success);
  EXPECT_EQ(trial.instance, 1);
  EXPECT_EQ(
    pick(shifted(1, 0, 0), { shifted(0, 0, 0) }).outcome, meam::TrialOutcome::Success); // a jaw has 1.5 mm of room
}

TEST(PickTrial, FailsAsAPoseIsWrong)
{
  EXPECT_EQ(pick(shifted(2, 0, 0), { shifted(0, 0, 0) }).outcome, meam::TrialOutcome::HitsPart);
  EXPECT_EQ(pick(shifted(0, 0, -40), { shifted(0, 0, 0) }).outcome, meam::TrialOutcome::HoldsNothing);
  EXPECT_EQ(pick(shifted(0, 40, 0), { shifted(0, 0, 0) }).outcome, meam::TrialOutcome::HoldsNothing);
  EXPECT_EQ(pick(shifted(0, 0, 15), { shifted(0, 0, 0) }).outcome, meam::TrialOutcome::HitsBin); // the tips reach to 21
  EXPECT_EQ(pick(shifted(0, 0, 0), { shifted(0, 0, 0), shifted(25, 0, 0) }).outcome, meam::TrialOutcome::HitsOther);
  EXPECT_EQ(pick(shifted(0, 15.5, 0), { shifted(0, 0, 0), shifted(0, 31, 0) }).outcome,
    meam::TrialOutcome::HitsOther); // of two
}

TEST(PickTrial, ACupGivesWay)
{
  meam::Gripper cup;
  cup.kind = meam::GraspKind::Suction;
  cup.cupDiameter = 10.0;
  meam::Grasp grasp;
  grasp.kind = meam::GraspKind::Suction;
  const auto outcome = [&](double z) // the top of the cube is at -10
  {
    grasp.T_model_grasp = shifted(0, 0, z);
    return meam::tryPicks(smallCube(), cup, { grasp }, { shifted(0, 0, 0) }, nullptr).front().outcome;
  };
  EXPECT_EQ(outcome(-10.0), meam::TrialOutcome::Success);
  EXPECT_EQ(outcome(-11.0), meam::TrialOutcome::Success);
  EXPECT_EQ(outcome(-9.0), meam::TrialOutcome::Success);
  EXPECT_EQ(outcome(-13.0), meam::TrialOutcome::HoldsNothing);
  EXPECT_EQ(outcome(-7.0), meam::TrialOutcome::HitsPart);
}
