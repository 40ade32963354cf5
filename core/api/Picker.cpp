// SPDX-License-Identifier: BSD-3-Clause
#include "base/sequences/Sequences.h"
#include "calibration/RobotFrameFile.h"
#include "api/Conversion.h"
#include "mesh/Symmetries.h"
#include "pick/BinDetection.h"
#include "pick/Grasp.h"
#include "pick/PickPlanning.h"
#include "pick/io/GraspFile.h"
#include "picks.h"

#include <algorithm>
#include <chrono>

namespace meam
{
namespace
{
constexpr double AfterBin = 0.2; // share of the work, for the progress

OrganizedCloud cloudOf(const Scan& scan)
{
  if (!scan.points.empty())
  {
    requireGrid(scan);
  }
  return { scan.width, scan.height, scan.points };
}

Poses posesOf(const Detections& found)
{
  Poses poses;
  for (const DetectedPose& each : found.poses)
  {
    Pose pose;
    pose.T_scene_model = each.T_scan_part;
    pose.score = each.score;
    pose.placeProbability = each.placeProbability;
    pose.probability = each.probability;
    poses.push_back(pose);
  }
  return poses;
}

/// Of each pose the index of its picker. Poses of one type may be of any of the models.
std::vector<int> pickersOf(const Detections& found, std::size_t pickers)
{
  std::vector<int> parts;
  int types = 0;
  bool isOne = true;
  for (const DetectedPose& each : found.poses)
  {
    parts.push_back(each.part);
    types = std::max(types, each.part + 1);
    isOne = isOne && each.part == parts.front();
  }
  if (pickers == 1 && isOne)
  {
    return std::vector<int>(parts.size(), 0);
  }
  if (pickers == 0 || static_cast<std::size_t>(types) > pickers)
  {
    throw Error("The poses are of " + std::to_string(types) + " types of part and there are pickers of " +
                std::to_string(pickers) + ": give Picker::planAll one of each type, in the order of the models.");
  }
  return parts;
}
}

Mesh gripperMesh(const GripperModel& gripper, const Grasp& grasp)
{
  const Gripper shape = gripperOf(gripper);
  requireGripper(shape);
  const TriangleMesh mesh = meshOf(shape, grasp);
  return { mesh.vertices, mesh.triangles };
}

Picker::Picker(
  const Model& model, const Mesh& part, const Grasps& grasps, const GripperModel& gripper, const PlanSettings& settings)
  : Given(grasps)
{
  const TriangleMesh mesh = partOf(model, part);
  this->Planner = std::make_shared<PickPlanner>(mesh, symmetriesOf(model), grasps, gripperOf(gripper), settings);
}

PickPlan Picker::plan(const Detections& found, const Scan& scan, const Workplace& place, const Progress& progress) const
{
  return planAll({ *this }, found, scan, place, progress);
}

PickPlan Picker::planAll(const std::vector<Picker>& pickers, const Detections& found, const Scan& scan,
  const Workplace& place, const Progress& progress)
{
  const auto start = std::chrono::steady_clock::now();
  const std::vector<int> parts = pickersOf(found, pickers.size());
  const auto planners = mapped<PickPlanner*>(pickers, [&](const Picker& picker) { return picker.Planner.get(); });
  PickPlan plan;
  if (place.hasBin)
  {
    plan.bin = place.bin ? *place.bin : detectBin(scan, subProgress(progress, 0.0, AfterBin));
  }
  const Picks picks = PickPlanner::planAll(
    planners, posesOf(found), parts, cloudOf(scan), plan.bin, subProgress(progress, AfterBin, 1.0));
  for (const Pick& pick : picks)
  {
    const Grasp& grasp = pickers[parts[pick.pose]].Given[pick.grasp];
    PlannedPick planned;
    planned.possible = pick.possible();
    planned.reason = planned.possible ? std::string() : describe(pick);
    planned.T_scan_grasp = pick.T_scene_grasp;
    if (place.T_robot_camera)
    {
      planned.T_robot_grasp = *place.T_robot_camera * pick.T_scene_grasp;
    }
    planned.instance = pick.pose;
    planned.part = found.poses[pick.pose].part;
    planned.grasp = pick.grasp;
    planned.graspName = grasp.name;
    planned.width = grasp.width;
    planned.clearance = pick.clearance;
    planned.reach = pick.reach;
    planned.tilt = pick.tilt;
    planned.covered = pick.covered;
    planned.score = pick.score;
    plan.picks.push_back(planned);
  }
  plan.report = describe(picks);
  plan.advice = adviceOn(picks);
  plan.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return plan;
}

Bin detectBin(const Scan& scan, const Progress& progress) { return detectBin(cloudOf(scan), progress); }

Grasp graspAt(GraspKind kind, const Eigen::Vector3d& position, const Eigen::Vector3d& approach,
  const Eigen::Vector3d& closing, double width)
{
  Grasp grasp;
  grasp.kind = kind;
  const bool turns = kind == GraspKind::Suction && closing.isZero();
  grasp.T_model_grasp = graspFrame(position, approach, turns ? approach.unitOrthogonal() : closing);
  grasp.width = width;
  grasp.freeTurn = turns ? FreeTurn::Approach : FreeTurn::None;
  requireGrasp(grasp);
  return grasp;
}

Grasps loadGrasps(const std::string& path) { return readGrasps(path); }

void saveGrasps(const std::string& path, const Grasps& grasps) { writeGrasps(path, grasps); }

Eigen::Isometry3d loadRobotFrame(const std::string& path) { return readRobotFrame(path); }
}
