// SPDX-License-Identifier: BSD-3-Clause
// What picks.h declares, through the shared libraries; the core beside them says what is right.
#include "TestAPI.h"
#include "TestFiles.h"
#include "TestGrids.h"
#include "TestGrippers.h"
#include "TestScene.h"
#include "calibration/RobotFrameFile.h"
#include "mesh/preparation/MeshPreparation.h"
#include "pick/GraspProposal.h"
#include "pick/PickPlanning.h"
#include "picks.h"

#include <cmath>
#include <functional>

namespace
{
using namespace api;
using Eigen::Vector3d;

meam::Grasp acrossTheLeg()
{
  meam::Grasp grasp = meam::graspAt(meam::GraspKind::Parallel, { 40, 6, 7 }, { 0, 0, 2 }, { 0, 3, 0 }, 12.0);
  grasp.name = "leg";
  return grasp;
}

meam::Grasp onTheLeg() { return meam::graspAt(meam::GraspKind::Suction, { 40, 6, 0 }, { 0, 0, 1 }); }

/// On a floor 500 mm below the sensor.
meam::Detections twoBrackets()
{
  meam::Detections found;
  for (const double x : { -50.0, 10.0 })
  {
    meam::DetectedPose pose;
    pose.T_scan_part.translation() = Vector3d(x, -20, 485);
    pose.probability = x < 0.0 ? 0.9 : 0.3;
    found.poses.push_back(pose);
  }
  return found;
}

meam::Bin bin() { return grippers::bin(300, 200, 100); }

/// A point each mm of a floor, with a rim 60 mm above it around 160 x 120 mm.
meam::Scan scanOfBin()
{
  return api::scanOf(grids::centered(240, 200,
    [](double x, double y)
    {
      const double u = std::abs(x), v = std::abs(y);
      return u < 85 && v < 65 && (u > 80 || v > 60) ? 440.0 : 500.0;
    }));
}

meam::Workplace given()
{
  meam::Workplace place;
  place.bin = bin();
  return place;
}

meam::GripperModel slim()
{
  meam::GripperModel gripper;
  gripper.opening = 40.0;
  gripper.fingerWidth = 6.0;
  gripper.fingerThickness = 4.0;
  gripper.bodyWidth = 20.0;
  return gripper;
}
}

TEST(PickAPI, PlansWhatTheCorePlans)
{
  meam::PlanSettings settings;
  settings.minimumProbability = 0.5;
  const meam::Grasp leg = acrossTheLeg(), cup = onTheLeg();
  const meam::Picker picker(bracketModel(), bracketMesh(), { leg, cup }, slim(), settings);
  meam::Workplace place = given();
  place.T_robot_camera = Eigen::Translation3d(100, 200, 300) * Eigen::AngleAxisd(M_PI, Vector3d::UnitX());
  const meam::PickPlan plan = picker.plan(twoBrackets(), {}, place);

  meam::Gripper gripper;
  static_cast<meam::GripperLengths&>(gripper) = slim();
  meam::Poses poses(2);
  for (int k = 0; k < 2; ++k)
  {
    poses[k].T_scene_model = twoBrackets().poses[k].T_scan_part;
    poses[k].probability = twoBrackets().poses[k].probability;
  }
  const meam::Picks picks =
    meam::PickPlanner(parts::lBracket(), scenes::bracket().symmetries, { leg, cup }, gripper).plan(poses, {}, bin());
  ASSERT_EQ(plan.picks.size(), picks.size());
  ASSERT_EQ(picks.size(), 4u);
  for (std::size_t k = 0; k < picks.size(); ++k)
  {
    EXPECT_EQ(plan.picks[k].T_scan_grasp.matrix(), picks[k].T_scene_grasp.matrix());
    EXPECT_TRUE(plan.picks[k].T_robot_grasp->isApprox(*place.T_robot_camera * picks[k].T_scene_grasp, 1e-12));
    EXPECT_EQ(plan.picks[k].possible, picks[k].possible());
    EXPECT_EQ(plan.picks[k].reason, picks[k].possible() ? "" : meam::describe(picks[k]));
    EXPECT_EQ(plan.picks[k].instance, picks[k].pose);
    EXPECT_EQ(plan.picks[k].clearance, picks[k].clearance);
    EXPECT_EQ(plan.picks[k].reach, picks[k].reach);
    EXPECT_EQ(plan.picks[k].tilt, picks[k].tilt);
    EXPECT_EQ(plan.picks[k].score, picks[k].score);
  }
  EXPECT_TRUE(plan.picks[0].possible);
  EXPECT_EQ(plan.picks[0].graspName, "leg");
  EXPECT_EQ(plan.picks[0].width, 12.0);
  EXPECT_EQ(plan.report, meam::describe(picks));
  EXPECT_TRUE(plan.bin.has_value());
  EXPECT_FALSE(picker.plan(twoBrackets(), {}, given()).picks[0].T_robot_grasp.has_value());

  settings.minimumProbability = 0.2; // the other one is picked, too
  const meam::PickPlan both =
    meam::Picker(bracketModel(), bracketMesh(), { leg }, slim(), settings).plan(twoBrackets(), {}, given());
  EXPECT_TRUE(both.picks[0].possible && both.picks[1].possible) << both.report;
}

TEST(PickAPI, PlansPicksOfSeveralTypesOfPart)
{
  const meam::Grasp leg = acrossTheLeg(), cup = onTheLeg();
  meam::PlanSettings settings;
  settings.minimumProbability = 0.2;
  const meam::Picker first(bracketModel(), bracketMesh(), { cup, leg }, slim(), settings);
  const meam::Picker second(bracketModel(), bracketMesh(), { leg }, slim(), settings);
  meam::Detections found = twoBrackets();
  found.poses[1].part = 1;
  const meam::PickPlan plan = meam::Picker::planAll({ first, second }, found, {}, given());
  ASSERT_EQ(plan.picks.size(), 3u);
  for (const meam::PlannedPick& pick : plan.picks)
  {
    EXPECT_EQ(pick.part, pick.instance);
    EXPECT_EQ(pick.graspName == "leg", pick.grasp == 1 - pick.part);
    EXPECT_EQ(pick.possible, pick.graspName == "leg") << pick.reason;
  }
  // The other type is in the way.
  found.poses[1].T_scan_part = found.poses[0].T_scan_part * Eigen::Translation3d(0, 13, 0);
  EXPECT_FALSE(meam::Picker::planAll({ first, second }, found, {}, given()).picks[0].possible);

  const auto errorOf = [&](const std::vector<meam::Picker>& pickers)
  { return files::errorOf([&] { meam::Picker::planAll(pickers, found, {}, given()); }); };
  const std::string few = "The poses are of 2 types of part and there are pickers of 1:";
  EXPECT_TRUE(files::contains(errorOf({ first }), few)) << errorOf({ first });
  EXPECT_TRUE(files::contains(files::errorOf([&] { first.plan(found, {}, given()); }), few));
  EXPECT_TRUE(files::contains(errorOf({}), "pickers of 0"));
  found.poses.erase(found.poses.begin());
  EXPECT_EQ(second.plan(found, {}, given()).picks.front().part, 1);
}

TEST(PickAPI, FindsTheBin)
{
  const meam::Bin found = meam::detectBin(scanOfBin());
  EXPECT_TRUE(found.size.isApprox(Vector3d(160, 120, 60), 0.03)) << found.size.transpose();
  const meam::Picker picker(bracketModel(), bracketMesh(), { acrossTheLeg() }, slim());
  const meam::PickPlan plan = picker.plan({}, scanOfBin());
  ASSERT_TRUE(plan.bin.has_value());
  EXPECT_EQ(plan.bin->size, found.size);
  meam::Workplace none;
  none.hasBin = false;
  EXPECT_FALSE(picker.plan({}, scanOfBin(), none).bin.has_value());
  const auto stop = [](double) { return false; };
  EXPECT_THROW(picker.plan({}, scanOfBin(), {}, stop), meam::Aborted);
}

TEST(PickAPI, ProposesGraspsAndKeepsThem)
{
  meam::ProposeSettings settings;
  settings.maximumGrasps = 6;
  settings.threads = 2;
  const meam::Grasps grasps = meam::proposeGrasps(bracketModel(), bracketMesh(), slim(), settings);
  meam::Gripper gripper;
  static_cast<meam::GripperLengths&>(gripper) = slim();
  meam::ProposeSettings proposal;
  proposal.maximumGrasps = 6;
  const meam::Grasps expected =
    meam::proposeGrasps(meam::prepareMesh(parts::lBracket()).mesh, scenes::bracket().symmetries, gripper, proposal);
  ASSERT_EQ(grasps.size(), 6u);
  ASSERT_EQ(expected.size(), 6u);
  const files::Folder folder;
  meam::saveGrasps(folder.path("bracket.grasps.json"), grasps);
  const meam::Grasps loaded = meam::loadGrasps(folder.path("bracket.grasps.json"));
  ASSERT_EQ(loaded.size(), 6u);
  for (std::size_t k = 0; k < grasps.size(); ++k)
  {
    EXPECT_EQ(grasps[k].T_model_grasp.matrix(), expected[k].T_model_grasp.matrix());
    EXPECT_TRUE(loaded[k].T_model_grasp.isApprox(grasps[k].T_model_grasp, 1e-12));
    EXPECT_EQ(loaded[k].name, grasps[k].name);
  }
  const meam::PickPlan plan =
    meam::Picker(bracketModel(), bracketMesh(), loaded, slim()).plan(twoBrackets(), {}, given());
  EXPECT_EQ(plan.picks.size(), 12u);
}

TEST(PickAPI, TakesAGripperOfAnyShape)
{
  meam::GripperModel wall = slim();
  const meam::TriangleMesh box = parts::box({ -200, 10, -50 }, { 200, 20, 5 });
  wall.mesh = { box.vertices, box.triangles };
  const meam::PickPlan plan =
    meam::Picker(bracketModel(), bracketMesh(), { acrossTheLeg() }, wall).plan(twoBrackets(), {}, given());
  EXPECT_FALSE(plan.picks[0].possible); // it reaches through both walls
}

TEST(PickAPI, ShowsTheGripperAtAGrasp)
{
  // Fingers to 12 / 2 + 3 + 8 mm aside, the body to 60 / 2 + 8; back from the tips 50 of a finger and 100 of the body.
  const meam::Mesh mesh = meam::gripperMesh(meam::GripperModel(), acrossTheLeg());
  Eigen::AlignedBox3f all, fingers;
  for (const Eigen::Vector3f& vertex : mesh.vertices)
  {
    all.extend(vertex);
    if (vertex.z() > 0.0f)
    {
      fingers.extend(vertex);
    }
  }
  EXPECT_EQ(36, mesh.triangles.size());
  EXPECT_TRUE(all.min().isApprox(Eigen::Vector3f(-38, -30, -144)) && all.max().isApprox(Eigen::Vector3f(38, 30, 6)));
  EXPECT_TRUE(fingers.max().isApprox(Eigen::Vector3f(17, 6, 6)) && fingers.min().isApprox(Eigen::Vector3f(-17, -6, 6)));
  meam::GripperModel without;
  without.fingerWidth = 0.0;
  EXPECT_THROW(meam::gripperMesh(without, acrossTheLeg()), meam::Error);
}

TEST(PickAPI, ReadsTheRobotsFrame)
{
  const files::Folder folder;
  const Eigen::Isometry3d T(Eigen::Translation3d(1, 2, 3));
  meam::writeRobotFrame(folder.path("robot.json"), T);
  EXPECT_TRUE(meam::loadRobotFrame(folder.path("robot.json")).isApprox(T));
}

TEST(PickAPI, WrongInputIsOneSentence)
{
  const meam::Mesh metres = bracketMesh(0.001f);
  const meam::Grasps leg{ acrossTheLeg() };
  meam::PlanSettings steep;
  steep.maximumTilt = 500.0;
  const meam::Model model = bracketModel();
  EXPECT_NO_THROW(meam::Picker({}, bracketMesh(), leg, slim())); // a part without symmetries
  const meam::Picker picker(model, bracketMesh(), leg, slim());
  meam::Scan torn = scanOfBin();
  torn.points.pop_back();
  const std::pair<std::function<void()>, const char*> cases[] = { { [&] { meam::Picker(model, metres, leg, slim()); },
                                                                    "in mm" },
    { [&] { meam::Picker(model, {}, leg, slim()); }, "no faces" },
    { [&] { meam::Picker(model, bracketMesh(), {}, slim()); }, "no grasp" },
    { [&] { meam::Picker(model, bracketMesh(), leg, slim(), steep); }, "tilt has to be 0 to 180" },
    { [&] { meam::proposeGrasps(model, metres, slim()); }, "in mm" },
    { [&] { picker.plan(twoBrackets(), {}); }, "organized scan" },
    { [&] { picker.plan(twoBrackets(), torn, given()); }, "a point for each" },
    { [&] { meam::loadGrasps("none.json"); }, "none.json" },
    { [&] {
       meam::graspAt(meam::GraspKind::Parallel, { 0, 0, 0 }, { 0, 0, 1 }, { 0, 0, 1 }, 5.0);
     },
      "not parallel" } };
  for (const auto& [act, words] : cases)
  {
    const std::string error = files::errorOf(act);
    EXPECT_TRUE(files::contains(error, words)) << words << ": " << error;
  }
}
