// SPDX-License-Identifier: BSD-3-Clause
#include "pick/PickPlanning.h"

#include "TestGrids.h"
#include "TestGrippers.h"
#include "TestSteps.h"

namespace
{
using Eigen::Vector3d;
using grippers::fromAbove;

meam::Pose poseAt(double x, double y, double probability = 1.0)
{
  meam::Pose pose;
  pose.T_scene_model.translation() = Vector3d(x, y, 490.0);
  pose.probability = probability;
  return pose;
}

/// 300 x 300 mm and 100 high under the sensor.
meam::Bin bin() { return grippers::bin(300, 300, 100); }

/// What a sensor straight above measures of a height z(x, y), a point each mm.
meam::OrganizedCloud scan(const std::function<double(double, double)>& height)
{
  return grids::centered(200, 200, height);
}

/// Across the block, too.
meam::Grasp fromTheSide()
{
  meam::Grasp side = fromAbove();
  side.T_model_grasp = meam::graspFrame({ 0, 0, 0 }, { 0, 1, 0 }, { 1, 0, 0 });
  return side;
}

double blockOnFloor(double x, double y) { return std::abs(x) < 10.0 && std::abs(y) < 20.0 ? 480.0 : 500.0; }

meam::Pick onlyPick(const meam::Poses& poses, const meam::OrganizedCloud& cloud = {},
  const meam::Grasp& grasp = fromAbove(), const meam::PlanSettings& settings = {},
  const std::optional<meam::Bin>& inBin = bin())
{
  meam::PickPlanner planner(grippers::block(), {}, { grasp }, grippers::jaws(), settings);
  const meam::Picks picks = planner.plan(poses, cloud, inBin);
  EXPECT_EQ(picks.size(), poses.size());
  const auto found = std::find_if(picks.begin(), picks.end(), [](const meam::Pick& pick) { return pick.pose == 0; });
  return *found;
}

}

TEST(PickPlanning, OneBlockOnTheFloor)
{
  const meam::Pick pick = onlyPick({ poseAt(0, 0) }, scan(blockOnFloor));
  EXPECT_TRUE(pick.possible()) << meam::describe(pick);
  EXPECT_NEAR(pick.clearance, 4.0, 1e-3); // the tips are at 496
  EXPECT_NEAR(pick.tilt, 0.0, 1e-6);
  EXPECT_NEAR(pick.reach, 90.0, 1e-6); // the rim is at 400
  EXPECT_EQ(pick.covered, 0.0);
  EXPECT_NEAR(pick.score, 0.4, 1e-4); // of 10 mm
  EXPECT_TRUE(pick.T_scene_grasp.translation().isApprox(Vector3d(0, 0, 490)));
}

TEST(PickPlanning, WithoutABinTheFloorIsSomethingMeasured)
{
  const meam::Pick pick = onlyPick({ poseAt(0, 0) }, scan(blockOnFloor), fromAbove(), {}, std::nullopt);
  EXPECT_TRUE(pick.possible()) << meam::describe(pick);
  EXPECT_NEAR(pick.clearance, 4.0, 2.0); // to the cubes about the points, which are 4 mm wide
  EXPECT_NEAR(pick.reach, 10.0, 1e-4);
  const meam::Pick nothing = onlyPick({ poseAt(0, 0) }, {}, fromAbove(), {}, std::nullopt);
  EXPECT_NEAR(nothing.clearance, 10.0, 1e-9);
}

TEST(PickPlanning, TheNeighbourThatIsInTheWayIsNamed)
{
  // The neighbour begins at 22, 1 mm beside the jaw.
  const meam::Poses poses{ poseAt(0, 0), poseAt(-60, -60), poseAt(32, 0) };
  meam::Pick pick = onlyPick(poses);
  EXPECT_EQ(pick.obstruction, meam::PickObstruction::Instance);
  EXPECT_EQ(pick.obstacle, 2);
  EXPECT_NEAR(pick.clearance, 1.0, 1e-3);
  EXPECT_EQ(meam::describe(pick), "collides with instance 3");
  EXPECT_EQ(meam::labelOf(pick, 7), "hits 3");
  meam::PlanSettings narrow;
  narrow.safetyMargin = 0.5;
  EXPECT_TRUE(onlyPick(poses, {}, fromAbove(), narrow).possible());
  // One that is not likely is none.
  EXPECT_TRUE(onlyPick({ poseAt(0, 0), poseAt(-60, -60), poseAt(32, 0, 0.3) }).possible());
}

TEST(PickPlanning, SomethingMeasuredThatIsNoKnownCopy)
{
  const auto cloud =
    scan([](double x, double y) { return x > 20.0 && x < 40.0 && std::abs(y) < 20.0 ? 480.0 : blockOnFloor(x, y); });
  const meam::Pick pick = onlyPick({ poseAt(0, 0) }, cloud);
  EXPECT_EQ(pick.obstruction, meam::PickObstruction::Measured) << meam::describe(pick);
  EXPECT_TRUE(onlyPick({ poseAt(0, 0), poseAt(-60, 0) }, scan(blockOnFloor)).possible());
}

TEST(PickPlanning, WhatIsCoveredStays)
{
  // A plate over a third of the block.
  const auto cloud = scan([](double x, double y) { return y > 7.0 && y < 60.0 ? 470.0 : blockOnFloor(x, y); });
  const meam::Pick pick = onlyPick({ poseAt(0, 0) }, cloud);
  EXPECT_EQ(pick.obstruction, meam::PickObstruction::Covered);
  EXPECT_NEAR(pick.covered, 13.0 / 40.0, 0.05);
  meam::PickPlanner planner(grippers::block(), {}, { fromTheSide(), fromAbove() }, grippers::jaws());
  const meam::Picks picks = planner.plan({ poseAt(0, 0) }, cloud, bin());
  EXPECT_EQ(picks[0].grasp, 1) << "what is shown of it is the grasp that comes from above";
  EXPECT_NEAR(picks[1].tilt, 90.0, 1e-6);
  meam::PlanSettings bold;
  bold.maximumCovered = 50.0;
  EXPECT_NE(onlyPick({ poseAt(0, 0) }, cloud, fromAbove(), bold).obstruction, meam::PickObstruction::Covered);
}

TEST(PickPlanning, TiltUncertaintyWidthAndKind)
{
  const meam::Pick tilted = onlyPick({ poseAt(0, 0) }, {}, fromTheSide());
  EXPECT_EQ(tilted.obstruction, meam::PickObstruction::Tilted);
  EXPECT_EQ(meam::describe(tilted), "tilted by 90 degrees");
  EXPECT_EQ(meam::labelOf(tilted, 7), "tilted");
  EXPECT_EQ(onlyPick({ poseAt(0, 0, 0.2) }).obstruction, meam::PickObstruction::Uncertain);
  meam::Grasp grasp = fromAbove();
  grasp.width = 35.0; // and 3 mm on either side
  EXPECT_EQ(onlyPick({ poseAt(0, 0) }, {}, grasp).obstruction, meam::PickObstruction::TooWide);
  grasp.width = 10.0; // the jaws come down on the block
  EXPECT_EQ(onlyPick({ poseAt(0, 0) }, {}, grasp).obstruction, meam::PickObstruction::PartItself);
  grasp.kind = meam::GraspKind::Suction;
  EXPECT_EQ(onlyPick({ poseAt(0, 0) }, {}, grasp).obstruction, meam::PickObstruction::WrongKind);
}

TEST(PickPlanning, ACupMayLieOnThePart)
{
  meam::Grasp cup = fromAbove();
  cup.kind = meam::GraspKind::Suction;
  cup.T_model_grasp.translation().z() = -10.0;
  meam::Gripper gripper;
  gripper.kind = meam::GraspKind::Suction;
  const auto picked = [&]
  { return meam::PickPlanner(grippers::block(), {}, { cup }, gripper).plan({ poseAt(0, 0) }, {}, bin()).front(); };
  EXPECT_TRUE(picked().possible()) << meam::describe(picked());
  EXPECT_EQ(meam::labelOf(picked(), 7), "pick 7");
  cup.T_model_grasp.translation().z() = 0.0; // in the middle of it
  EXPECT_EQ(picked().obstruction, meam::PickObstruction::PartItself);
}

TEST(PickPlanning, TheOpenGripperDoesNotGrazeThePart)
{
  // The body comes down to 44 mm behind the grasp; the block is held so deep that it ends half a millimetre before it.
  meam::Grasp deep = fromAbove();
  deep.T_model_grasp.translation().z() = 33.5;
  EXPECT_EQ(onlyPick({ poseAt(0, 0) }, {}, deep, {}, std::nullopt).obstruction, meam::PickObstruction::PartItself);
  deep.T_model_grasp.translation().z() -= 1.0; // more than the margin
  EXPECT_TRUE(onlyPick({ poseAt(0, 0) }, {}, deep, {}, std::nullopt).possible());
}

TEST(PickPlanning, TheWallIsInTheWay)
{
  const meam::Pick pick =
    onlyPick({ poseAt(125, 0) }); // the jaw ends at 146, the wall begins at 150; the body ends at 153
  EXPECT_EQ(pick.obstruction, meam::PickObstruction::Bin);
  EXPECT_EQ(meam::describe(pick), "collides with the bin");
}

TEST(PickPlanning, ASymmetricPartIsHeldWhereThereIsRoom)
{
  // Something stands beside one end of the block; a turn by 180 degrees takes the grasp to the other.
  const meam::Poses poses{ poseAt(0, 0), poseAt(32, 25) };
  EXPECT_FALSE(onlyPick(poses, {}, fromAbove(15.0)).possible());
  meam::Symmetries half;
  half.discrete.push_back(meam::turnAbout(Vector3d::UnitZ(), M_PI, Vector3d::Zero()));
  meam::PickPlanner planner(grippers::block(), half, { fromAbove(15.0) }, grippers::jaws());
  const meam::Picks picks = planner.plan(poses, {}, bin());
  ASSERT_EQ(picks.size(), 2u);
  const meam::Pick& pick = picks[picks[0].pose == 0 ? 0 : 1];
  EXPECT_TRUE(pick.possible()) << meam::describe(pick);
  EXPECT_NEAR(pick.T_scene_grasp.translation().y(), -15.0, 1e-6);
}

TEST(PickPlanning, TheBestComesFirstAndTheImpossibleLast)
{
  meam::PickPlanner planner(grippers::block(), {}, { fromAbove() }, grippers::jaws());
  const meam::Picks picks = planner.plan({ poseAt(-60, 0, 0.6), poseAt(0, 0, 0.9), poseAt(60, 0, 0.2) }, {}, bin());
  ASSERT_EQ(picks.size(), 3u);
  EXPECT_EQ(picks[0].pose, 1);
  EXPECT_EQ(picks[1].pose, 0);
  EXPECT_EQ(picks[2].pose, 2);
  EXPECT_FALSE(picks[2].possible());
  EXPECT_EQ(meam::describe(picks), "2 of 3 copies can be picked, by 2 of 3 picks; the others: 1 too uncertain.");
  EXPECT_EQ(meam::adviceOn(picks), "Copies too uncertain: lower MinimumProbability, or scan again.");
}

TEST(PickPlanning, SeveralTypesEachWithItsGraspsAreInEachOthersWay)
{
  // A block, held in its middle or at its end, and a pillar 1 mm beside the jaw in the middle.
  const meam::TriangleMesh pillar = parts::box({ -5, -5, -30 }, { 5, 5, 10 });
  meam::Grasp ofPillar = fromAbove();
  ofPillar.T_model_grasp.translation().z() = -20.0;
  ofPillar.width = 10.0;
  meam::PickPlanner first(grippers::block(), {}, { fromAbove(15.0), fromAbove() }, grippers::jaws());
  meam::PickPlanner second(pillar, {}, { ofPillar }, grippers::jaws());
  const auto planned = [&](double x)
  {
    const auto cloud =
      scan([x](double u, double v) { return std::abs(u - x) < 5.0 && std::abs(v) < 5.0 ? 460.0 : blockOnFloor(u, v); });
    return meam::PickPlanner::planAll({ &first, &second }, { poseAt(x, 0), poseAt(0, 0) }, { 1, 0 }, cloud, bin());
  };
  const meam::Picks near = planned(27.0);
  ASSERT_EQ(near.size(), 3u);
  EXPECT_EQ(meam::describe(near), "2 of 2 copies can be picked, by 2 of 3 picks.");
  for (const meam::Pick& pick : near)
  {
    EXPECT_EQ(pick.possible(), pick.pose == 0 || pick.grasp == 0) << meam::describe(pick);
    EXPECT_NEAR(pick.T_scene_grasp.translation().z(), pick.pose == 0 ? 470.0 : 490.0, 1e-9);
  }
  EXPECT_EQ(near.back().obstruction, meam::PickObstruction::Instance) << meam::describe(near.back());
  EXPECT_EQ(near.back().obstacle, 0);
  EXPECT_EQ(meam::describe(planned(60.0)), "2 of 2 copies can be picked, by 3 of 3 picks.");
}

TEST(PickPlanning, MovesWithTheScene)
{
  const Eigen::Isometry3d motion = Eigen::Translation3d(300, -200, 100) *
                                   Eigen::AngleAxisd(1.2, Vector3d(1, 2, 3).normalized()) *
                                   Eigen::Isometry3d::Identity();
  meam::PickPlanner planner(grippers::block(), {}, { fromAbove() }, grippers::jaws());
  meam::Poses poses{ poseAt(-60, 10, 0.9), poseAt(0, 0, 0.8), poseAt(25, 45, 0.7) };
  const meam::Picks before = planner.plan(poses, {}, bin());
  meam::Bin moved = bin();
  moved.T_scene_bin = motion * moved.T_scene_bin;
  for (meam::Pose& pose : poses)
  {
    pose = meam::moved(pose, motion);
  }
  const meam::Picks after = planner.plan(poses, {}, moved);
  ASSERT_EQ(before.size(), after.size());
  for (std::size_t k = 0; k < before.size(); ++k)
  {
    EXPECT_EQ(before[k].pose, after[k].pose);
    EXPECT_EQ(before[k].obstruction, after[k].obstruction);
    EXPECT_NEAR(before[k].clearance, after[k].clearance, 1e-3);
    EXPECT_TRUE((motion * before[k].T_scene_grasp).isApprox(after[k].T_scene_grasp, 1e-9));
  }
}

TEST(PickPlanning, WrongInputIsOneSentence)
{
  struct Given
  {
    meam::Grasps grasps{ fromAbove() };
    meam::Gripper gripper = grippers::jaws();
    meam::PlanSettings settings;
    meam::Pose pose = poseAt(0, 0);
  };
  const auto plan = [](const Given& given)
  {
    meam::PickPlanner(grippers::block(), {}, given.grasps, given.gripper, given.settings)
      .plan({ given.pose }, {}, bin());
  };
  steps::expectRefused<Given>(plan,
    { { [](auto& g) { g.grasps.clear(); }, "no grasp" },
      { [](auto& g) { g.grasps = { fromAbove(500.0) }; }, "outside the part" },
      { [](auto& g) { g.gripper.fingerWidth = 400.0; }, "does not go into the bin" },
      { [](auto& g) { g.settings.maximumTilt = 200.0; }, "The maximum tilt has to be 0 to 180 degrees, not 200." },
      { [](auto& g) { g.settings.wayIn = NAN; }, "The way in has to be 0 mm or more, not nan." },
      { [](auto& g) { g.pose.T_scene_model.translation().x() = NAN; } } });
}
