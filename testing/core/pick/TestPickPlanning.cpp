// SPDX-License-Identifier: BSD-3-Clause
#include "pick/PickPlanning.h"

#include "TestFiles.h"
#include "TestGrippers.h"

#include <gtest/gtest.h>

namespace
{
using Eigen::Vector3d;

/// From above, across the block.
meam::Grasp fromAbove(double y = 0.0)
{
  meam::Grasp grasp;
  grasp.name = "above";
  grasp.T_model_grasp = meam::graspFrame({ 0, y, 0 }, { 0, 0, 1 }, { 1, 0, 0 });
  grasp.width = 20.0;
  return grasp;
}

meam::Pose poseAt(double x, double y, double probability = 1.0)
{
  meam::Pose pose;
  pose.T_scene_model.translation() = Vector3d(x, y, 490.0);
  pose.probability = probability;
  return pose;
}

/// 300 x 300 mm and 100 high under the sensor.
meam::Bin bin()
{
  meam::Bin result;
  result.T_scene_bin.linear() = Vector3d(1.0, -1.0, -1.0).asDiagonal();
  result.T_scene_bin.translation().z() = 500.0;
  result.size = Vector3d(300.0, 300.0, 100.0);
  return result;
}

/// What a sensor straight above measures of a height z(x, y), a point each mm; NaN: nothing.
template <typename Height>
meam::OrganizedCloud scan(Height&& height)
{
  meam::OrganizedCloud cloud;
  cloud.width = cloud.height = 200;
  for (int row = 0; row < cloud.height; ++row)
  {
    for (int column = 0; column < cloud.width; ++column)
    {
      const float x = static_cast<float>(column) - 99.5f;
      const float y = static_cast<float>(row) - 99.5f;
      cloud.points.emplace_back(x, y, height(x, y));
    }
  }
  return cloud;
}

float blockOnFloor(float x, float y) { return std::abs(x) < 10.0f && std::abs(y) < 20.0f ? 480.0f : 500.0f; }

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
    scan([](float x, float y) { return x > 20.0f && x < 40.0f && std::abs(y) < 20.0f ? 480.0f : blockOnFloor(x, y); });
  const meam::Pick pick = onlyPick({ poseAt(0, 0) }, cloud);
  EXPECT_EQ(pick.obstruction, meam::PickObstruction::Measured) << meam::describe(pick);
  EXPECT_TRUE(onlyPick({ poseAt(0, 0), poseAt(-60, 0) }, scan(blockOnFloor)).possible());
}

TEST(PickPlanning, WhatIsCoveredStays)
{
  // A plate over a third of the block.
  const auto cloud = scan([](float x, float y) { return y > 7.0f && y < 60.0f ? 470.0f : blockOnFloor(x, y); });
  const meam::Pick pick = onlyPick({ poseAt(0, 0) }, cloud);
  EXPECT_EQ(pick.obstruction, meam::PickObstruction::Covered);
  EXPECT_NEAR(pick.covered, 13.0 / 40.0, 0.05);
  meam::Grasp side = fromAbove();
  side.T_model_grasp = meam::graspFrame({ 0, 0, 0 }, { 0, 1, 0 }, { 1, 0, 0 });
  meam::PickPlanner planner(grippers::block(), {}, { side, fromAbove() }, grippers::jaws());
  const meam::Picks picks = planner.plan({ poseAt(0, 0) }, cloud, bin());
  EXPECT_EQ(picks[0].grasp, 1) << "what is shown of it is the grasp that comes from above";
  EXPECT_NEAR(picks[1].tilt, 90.0, 1e-6);
  meam::PlanSettings bold;
  bold.maximumCovered = 50.0;
  EXPECT_NE(onlyPick({ poseAt(0, 0) }, cloud, fromAbove(), bold).obstruction, meam::PickObstruction::Covered);
}

TEST(PickPlanning, TiltUncertaintyWidthAndKind)
{
  meam::Grasp side = fromAbove();
  side.T_model_grasp = meam::graspFrame({ 0, 0, 0 }, { 0, 1, 0 }, { 1, 0, 0 });
  const meam::Pick tilted = onlyPick({ poseAt(0, 0) }, {}, side);
  EXPECT_EQ(tilted.obstruction, meam::PickObstruction::Tilted);
  EXPECT_EQ(meam::describe(tilted), "tilted by 90 degrees");
  EXPECT_EQ(meam::labelOf(tilted, 7), "tilted");
  EXPECT_EQ(onlyPick({ poseAt(0, 0, 0.2) }).obstruction, meam::PickObstruction::Uncertain);
  meam::Grasp wide = fromAbove();
  wide.width = 35.0; // and 3 mm on either side
  EXPECT_EQ(onlyPick({ poseAt(0, 0) }, {}, wide).obstruction, meam::PickObstruction::TooWide);
  meam::Grasp cup = fromAbove();
  cup.kind = meam::GraspKind::Suction;
  EXPECT_EQ(onlyPick({ poseAt(0, 0) }, {}, cup).obstruction, meam::PickObstruction::WrongKind);
  meam::Grasp narrow = fromAbove();
  narrow.width = 10.0; // the jaws come down on the block
  EXPECT_EQ(onlyPick({ poseAt(0, 0) }, {}, narrow).obstruction, meam::PickObstruction::PartItself);
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
  EXPECT_EQ(meam::adviceOn(picks), "Copies too uncertain: lower the minimum probability, or scan again.");
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
      scan([x](float u, float v) { return std::abs(u - x) < 5.0 && std::abs(v) < 5.0f ? 460.0f : blockOnFloor(u, v); });
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
  const auto plan = [](
                      const meam::Grasps& grasps, const meam::Gripper& gripper, const meam::PlanSettings& settings = {})
  { meam::PickPlanner(grippers::block(), {}, grasps, gripper, settings).plan({ poseAt(0, 0) }, {}, bin()); };
  EXPECT_NE(files::errorOf([&] { plan({}, grippers::jaws()); }).find("no grasp"), std::string::npos);
  EXPECT_NE(
    files::errorOf([&] { plan({ fromAbove(500.0) }, grippers::jaws()); }).find("outside the part"), std::string::npos);
  meam::Gripper huge = grippers::jaws();
  huge.fingerWidth = 400.0;
  EXPECT_NE(files::errorOf([&] { plan({ fromAbove() }, huge); }).find("does not go into the bin"), std::string::npos);
  meam::PlanSettings settings;
  settings.maximumTilt = 200.0;
  EXPECT_EQ(files::errorOf([&] { plan({ fromAbove() }, grippers::jaws(), settings); }),
    "The maximum tilt has to be 0 to 180 degrees, not 200.");
  settings.maximumTilt = 60.0;
  settings.wayIn = NAN;
  EXPECT_EQ(files::errorOf([&] { plan({ fromAbove() }, grippers::jaws(), settings); }),
    "The way in has to be 0 mm or more, not nan.");
  meam::Pose nowhere = poseAt(0, 0);
  nowhere.T_scene_model.translation().x() = NAN;
  meam::PickPlanner planner(grippers::block(), {}, { fromAbove() }, grippers::jaws());
  EXPECT_THROW(planner.plan({ nowhere }, {}, bin()), meam::Error);
}
