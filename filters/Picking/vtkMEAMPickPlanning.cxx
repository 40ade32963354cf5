// SPDX-License-Identifier: BSD-3-Clause
#include "vtkMEAMPickPlanning.h"

#include "base/Bounds.h"
#include "calibration/RobotFrameFile.h"
#include "pick/BinDetection.h"
#include "pick/PickPlanning.h"
#include "vtkMEAMArrays.h"
#include "vtkMEAMGraspConversion.h"
#include "vtkMEAMMeshConversion.h"
#include "vtkMEAMPickConversion.h"
#include "vtkMEAMPoseConversion.h"
#include "vtkMEAMRun.h"
#include "vtkMEAMScanConversion.h"
#include "vtkMEAMSceneRequests.h"
#include "vtkMEAMSettings.h"
#include "vtkMEAMSymmetryConversion.h"

#include "vtkDataArray.h"
#include "vtkFieldData.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkObjectFactory.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkStructuredGrid.h"
#include "vtkTable.h"

#include <memory>
#include <optional>
#include <string>
#include <vector>

vtkStandardNewMacro(vtkMEAMPickPlanning);

namespace
{
/// What the sensor measured: a grid, or points in no order.
meam::OrganizedCloud cloudOf(vtkPointSet* scan)
{
  if (auto* grid = vtkStructuredGrid::SafeDownCast(scan))
  {
    return vtkMEAMConversion::toOrganizedCloud(grid);
  }
  meam::OrganizedCloud cloud;
  if (scan && scan->GetNumberOfPoints() > 0)
  {
    cloud.points = vtkMEAMConversion::toVectors<float>(scan->GetPoints()->GetData());
    cloud.width = static_cast<int>(cloud.points.size());
    cloud.height = 1;
  }
  return cloud;
}

/// Throws Error where a mesh is not as large as the type of part that is searched at its place.
void requireSize(const meam::TriangleMesh& mesh, int type, vtkPolyData* poses)
{
  constexpr double Off = 0.05; // of the diameter, which is that of samples
  vtkDataArray* diameters = poses->GetFieldData()->GetArray("Diameter");
  if (diameters && type < diameters->GetNumberOfTuples())
  {
    const double diameter = diameters->GetComponent(type, 0);
    const Eigen::Vector3d sides = meam::bounds(mesh.vertices).cast<double>().sizes();
    if ((1.0 - Off) * sides.maxCoeff() > diameter || (1.0 + Off) * sides.norm() < diameter)
    {
      throw meam::Error("Mesh " + std::to_string(type + 1) +
                        " of the input Part is not as large as the part that was " +
                        "searched: connect to Part and to Grasps those of all types, in the order in which they were.");
    }
  }
}
}

vtkMEAMPickPlanning::vtkMEAMPickPlanning()
  : Settings(std::make_unique<meam::PlanSettings>())
{
  this->SetNumberOfInputPorts(5);
  this->SetNumberOfOutputPorts(4);
}

vtkMEAMPickPlanning::~vtkMEAMPickPlanning() { this->SetRobotFrameFile(nullptr); }

int vtkMEAMPickPlanning::FillInputPortInformation(int port, vtkInformation* info)
{
  using namespace vtkMEAMConversion;
  const bool isOfTypes = port == 1 || port == 2;
  return fillInputPort(
    info, { port == 3 ? "vtkPointSet" : "vtkPolyData" }, isOfTypes ? Connections::Any : Connections::OneOrNone);
}

int vtkMEAMPickPlanning::FillOutputPortInformation(int port, vtkInformation* info)
{
  info->Set(vtkDataObject::DATA_TYPE_NAME(), port == 3 ? "vtkTable" : "vtkPolyData");
  return 1;
}

int vtkMEAMPickPlanning::RequestInformation(
  vtkInformation*, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  vtkMEAMSceneRequests::announceTime(inputVector, { 0, 3 }, outputVector);
  return 1;
}

vtkMEAMSettingMacro(vtkMEAMPickPlanning, SafetyMargin, double, safetyMargin);
vtkMEAMSettingMacro(vtkMEAMPickPlanning, WayIn, double, wayIn);
vtkMEAMSettingMacro(vtkMEAMPickPlanning, MinimumProbability, double, minimumProbability);
vtkMEAMSettingMacro(vtkMEAMPickPlanning, RotationCounts, bool, rotationCounts);
vtkMEAMSettingMacro(vtkMEAMPickPlanning, MaximumTilt, double, maximumTilt);
vtkMEAMSettingMacro(vtkMEAMPickPlanning, MaximumCovered, double, maximumCovered);
vtkMEAMSettingMacro(vtkMEAMPickPlanning, TurnStep, double, turnStep);
vtkMEAMSettingMacro(vtkMEAMPickPlanning, Tolerance, double, tolerance);

void vtkMEAMPickPlanning::SetGripper(int gripper)
{
  const auto kind = gripper == SuctionCup ? meam::GraspKind::Suction : meam::GraspKind::Parallel;
  if (this->Lengths->kind != kind)
  {
    this->Lengths->kind = kind;
    this->Modified();
  }
}

int vtkMEAMPickPlanning::GetGripper()
{
  return this->Lengths->kind == meam::GraspKind::Suction ? SuctionCup : ParallelJaws;
}

int vtkMEAMPickPlanning::RequestData(
  vtkInformation*, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  using namespace vtkMEAMConversion;
  auto* posesInput = vtkPolyData::GetData(inputVector[0]);
  auto* scan = vtkPointSet::GetData(inputVector[3]);
  auto* gripperInput = vtkPolyData::GetData(inputVector[4]);
  auto* output = vtkPolyData::GetData(outputVector, 0);
  auto* grippers = vtkPolyData::GetData(outputVector, 1);
  auto* walls = vtkPolyData::GetData(outputVector, 2);
  auto* answer = vtkTable::GetData(outputVector, 3);
  return vtkMEAMRun(
    this,
    [&]
    {
      requireInputs(this, { "Poses", "Part", "Grasps" });
      const meam::Progress progress = progressOf(this);
      const meam::Poses poses = toPoses(posesInput);
      const int types = inputVector[1]->GetNumberOfInformationObjects();
      const std::vector<int> parts = typesOf(posesInput, types);
      if (inputVector[2]->GetNumberOfInformationObjects() != types)
      {
        throw meam::Error("Connect to Grasps the grasps of each type of part, in the order of Part: there are " +
                          std::to_string(types) + " meshes and " +
                          std::to_string(inputVector[2]->GetNumberOfInformationObjects()) + " sets of grasps.");
      }
      meam::Gripper gripper = *this->Lengths;
      if (gripperInput)
      {
        gripper.mesh = toMesh(gripperInput);
      }
      const meam::OrganizedCloud cloud = cloudOf(scan);
      std::optional<meam::Bin> bin;
      if (this->Bin == GivenBin)
      {
        bin = meam::Bin{ placedAt(this->BinPosition, this->BinRotation).T_scene_model, Eigen::Vector3d(this->BinSize),
          this->BinWall };
      }
      else if (this->Bin == DetectedBin)
      {
        bin = meam::detectBin(cloud, meam::subProgress(progress, 0.0, 0.2));
      }
      std::vector<meam::Grasps> grasps;
      std::vector<std::unique_ptr<meam::PickPlanner>> planners;
      std::vector<meam::PickPlanner*> ofTypes;
      for (int type = 0; type < types; ++type)
      {
        auto* part = vtkPolyData::GetData(inputVector[1], type);
        auto* graspsInput = vtkPolyData::GetData(inputVector[2], type);
        meam::Symmetries symmetries = symmetriesOf(part);
        if (!symmetries.exact() && symmetries.near.empty())
        {
          symmetries = symmetriesOf(graspsInput);
        }
        grasps.push_back(toGrasps(graspsInput));
        const meam::TriangleMesh mesh = toMesh(part);
        if (types > 1)
        {
          requireSize(mesh, type, posesInput);
        }
        planners.push_back(
          std::make_unique<meam::PickPlanner>(mesh, symmetries, grasps.back(), gripper, *this->Settings));
        ofTypes.push_back(planners.back().get());
      }
      const auto graspOf = [&](const meam::Pick& pick) -> const meam::Grasp&
      { return grasps[parts[pick.pose]][pick.grasp]; };
      const meam::Picks picks =
        meam::PickPlanner::planAll(ofTypes, poses, parts, cloud, bin, meam::subProgress(progress, 0.4, 1.0));
      const std::vector<bool> drawn = drawnPicks(picks, static_cast<ShownPicks>(this->ShownGrippers), posesInput);
      fromPicks(picks, graspOf, drawn, output);
      if (types > 1)
      {
        addParts(picks, parts, output);
      }
      if (this->RobotFrameFile && *this->RobotFrameFile)
      {
        meam::Pose robot;
        robot.T_scene_model = meam::readRobotFrame(this->RobotFrameFile);
        addInFrame(picks, robot, "RobotTransform", output);
      }
      const std::string report = meam::describe(picks);
      const std::string advice = meam::adviceOn(picks);
      setFieldText(output, "PickReport", report);
      setFieldText(output, "PickAdvice", advice);
      fromAnswer({ report, advice }, answer);
      fromGrippers(picks, graspOf, gripper, drawn, this->WholeGripper, grippers);
      if (!gripperInput)
      {
        setGripper(output, gripper);
      }
      if (bin)
      {
        setBin(output, *bin);
        fromBin(*bin, walls);
      }
    },
    output, grippers, walls, answer);
}

void vtkMEAMPickPlanning::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  const auto print = [&](const char* name, const double values[3])
  { os << indent << name << ": " << values[0] << " " << values[1] << " " << values[2] << "\n"; };
  os << indent << "Gripper: " << this->GetGripper() << "\n";
  os << indent << "Bin: " << this->Bin << "\n";
  print("BinPosition", this->BinPosition);
  print("BinRotation", this->BinRotation);
  print("BinSize", this->BinSize);
  os << indent << "BinWall: " << this->BinWall << " mm\n";
  os << indent << "SafetyMargin: " << this->GetSafetyMargin() << " mm\n";
  os << indent << "WayIn: " << this->GetWayIn() << " mm\n";
  os << indent << "MinimumProbability: " << this->GetMinimumProbability() << "\n";
  os << indent << "RotationCounts: " << this->GetRotationCounts() << "\n";
  os << indent << "MaximumTilt: " << this->GetMaximumTilt() << " degrees\n";
  os << indent << "MaximumCovered: " << this->GetMaximumCovered() << " %\n";
  os << indent << "TurnStep: " << this->GetTurnStep() << " degrees\n";
  os << indent << "Tolerance: " << this->GetTolerance() << " mm\n";
  os << indent << "RobotFrameFile: " << (this->RobotFrameFile ? this->RobotFrameFile : "(none)") << "\n";
  os << indent << "ShownGrippers: " << this->ShownGrippers << "\n";
  os << indent << "WholeGripper: " << this->WholeGripper << "\n";
}
