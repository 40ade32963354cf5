// SPDX-License-Identifier: BSD-3-Clause
#include "vtkMEAMPickTrial.h"

#include "base/sequences/Sequences.h"
#include "pick/PickTrial.h"
#include "vtkMEAMArrays.h"
#include "vtkMEAMGraspConversion.h"
#include "vtkMEAMMeshConversion.h"
#include "vtkMEAMPickConversion.h"
#include "vtkMEAMPoseConversion.h"
#include "vtkMEAMRun.h"
#include "vtkMEAMSettings.h"

#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkIntArray.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkStringArray.h"

#include <algorithm>
#include <iterator>

vtkStandardNewMacro(vtkMEAMPickTrial);

vtkMEAMPickTrial::vtkMEAMPickTrial()
  : Settings(new meam::PickTrialSettings)
{
  this->SetNumberOfInputPorts(4);
}

vtkMEAMPickTrial::~vtkMEAMPickTrial() = default;

vtkMEAMSettingMacro(vtkMEAMPickTrial, WayIn, double, wayIn)
vtkMEAMSettingMacro(vtkMEAMPickTrial, CupSlack, double, cupSlack)

int vtkMEAMPickTrial::FillInputPortInformation(int, vtkInformation* info)
{
  return vtkMEAMConversion::fillInputPort(info, { "vtkPolyData" }, vtkMEAMConversion::Connections::OneOrNone);
}

int vtkMEAMPickTrial::RequestData(
  vtkInformation*, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  using namespace vtkMEAMConversion;
  auto* picksInput = vtkPolyData::GetData(inputVector[0]);
  auto* part = vtkPolyData::GetData(inputVector[1]);
  auto* truthInput = vtkPolyData::GetData(inputVector[2]);
  auto* gripperInput = vtkPolyData::GetData(inputVector[3]);
  auto* output = vtkPolyData::GetData(outputVector);
  return vtkMEAMRun(
    this,
    [&]
    {
      requireInputs(this, { "Picks", "Part", "True poses" });
      const meam::Progress progress = progressOf(this);
      const meam::Grasps picks = toGrasps(picksInput); // their frames are the scene's
      const std::vector<bool> possible = possiblePicks(picksInput);
      const meam::TriangleMesh mesh = toMesh(part);
      const auto truths = meam::mapped<Eigen::Isometry3d>(
        toPoses(truthInput), [&](const meam::Pose& pose) { return pose.T_scene_model; });
      std::optional<meam::Bin> bin = binOf(truthInput);
      if (!bin)
      {
        bin = binOf(picksInput);
      }
      std::optional<meam::Gripper> gripper = gripperOf(picksInput);
      if (gripperInput)
      {
        gripper = meam::Gripper();
        gripper->mesh = toMesh(gripperInput);
      }
      if (!gripper)
      {
        throw meam::Error(
          "The picks have no field data 'Gripper': use the output of Pick Planning as it is, and connect "
          "the gripper's mesh when they were planned with one.");
      }
      meam::Grasps tried;
      std::copy_if(picks.begin(), picks.end(), std::back_inserter(tried),
        [&](const meam::Grasp& pick) { return possible[&pick - picks.data()]; });
      const std::vector<meam::PickTrial> trials =
        meam::tryPicks(mesh, *gripper, tried, truths, bin ? &*bin : nullptr, *this->Settings, progress);

      std::vector<const meam::PickTrial*> trialOf; // null of a pick that is not tried
      auto trial = trials.data();
      for (const bool isTried : possible)
      {
        trialOf.push_back(isTried ? trial++ : nullptr);
      }
      output->ShallowCopy(picksInput);
      vtkPointData* arrays = output->GetPointData();
      arrays->AddArray(columnOf<vtkIntArray>("Outcome", trialOf,
        [](const meam::PickTrial* one) { return one ? static_cast<int>(one->outcome) : NotTried; }));
      arrays->AddArray(columnOf<vtkStringArray>("OutcomeName", trialOf,
        [](const meam::PickTrial* one) { return one ? meam::describe(one->outcome) : "not tried"; }));
      arrays->AddArray(columnOf<vtkIntArray>(
        "TrueInstance", trialOf, [](const meam::PickTrial* one) { return one ? one->instance + 1 : 0; }));
    },
    output);
}

void vtkMEAMPickTrial::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "WayIn: " << this->GetWayIn() << " mm\n";
  os << indent << "CupSlack: " << this->GetCupSlack() << " mm\n";
}
