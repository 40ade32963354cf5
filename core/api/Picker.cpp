// SPDX-License-Identifier: BSD-3-Clause
#include "calibration/RobotFrameFile.h"
#include "api/Conversion.h"
#include "mesh/Symmetries.h"
#include "pick/BinDetection.h"
#include "pick/Grasp.h"
#include "pick/PickPlanning.h"
#include "pick/io/GraspFile.h"
#include "picks.h"

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
  const auto start = std::chrono::steady_clock::now();
  PickPlan plan;
  if (place.hasBin)
  {
    plan.bin = place.bin ? *place.bin : detectBin(scan, subProgress(progress, 0.0, AfterBin));
  }
  const Picks picks =
    this->Planner->plan(posesOf(found), cloudOf(scan), plan.bin, subProgress(progress, AfterBin, 1.0));
  for (const Pick& pick : picks)
  {
    PlannedPick planned;
    planned.possible = pick.possible();
    planned.reason = planned.possible ? std::string() : describe(pick);
    planned.T_scan_grasp = pick.T_scene_grasp;
    if (place.T_robot_camera)
    {
      planned.T_robot_grasp = *place.T_robot_camera * pick.T_scene_grasp;
    }
    planned.instance = pick.pose;
    planned.grasp = pick.grasp;
    planned.graspName = this->Given[pick.grasp].name;
    planned.width = this->Given[pick.grasp].width;
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

Bin detectBin(const Scan& scan, const Progress& progress)
{
  if (scan.height < 2)
  {
    throw Error("The bin is found in an organized scan: give one, or the bin (Workplace::bin), or set "
                "Workplace::hasBin to false.");
  }
  return detectBin(cloudOf(scan), progress);
}

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
