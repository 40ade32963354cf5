// SPDX-License-Identifier: BSD-3-Clause
#include "vtkMEAMPoseInstances.h"

#include "base/sequences/Sequences.h"
#include "vtkMEAMArrays.h"
#include "vtkMEAMInstanceConversion.h"
#include "vtkMEAMPoseConversion.h"
#include "vtkMEAMRun.h"
#include "vtkMEAMSettings.h"

#include "vtkDataArray.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkTable.h"

#include <algorithm>
#include <vector>

vtkStandardNewMacro(vtkMEAMPoseInstances);

vtkMEAMPoseInstances::vtkMEAMPoseInstances()
  : Settings(new vtkMEAMConversion::InstanceSettings)
{
  this->SetNumberOfInputPorts(2);
  this->SetNumberOfOutputPorts(3);
}

vtkMEAMPoseInstances::~vtkMEAMPoseInstances() = default;

vtkMEAMClampedSettingMacro(vtkMEAMPoseInstances, MaximumNumberOfInstances, int, most, 0, VTK_INT_MAX)
vtkMEAMClampedSettingMacro(vtkMEAMPoseInstances, MinimumProbability, double, minimumProbability, 0.0, 1.0)

int vtkMEAMPoseInstances::FillInputPortInformation(int port, vtkInformation* info)
{
  using namespace vtkMEAMConversion;
  return fillInputPort(info, { "vtkPolyData" }, port == 1 ? Connections::Any : Connections::OneOrNone);
}

int vtkMEAMPoseInstances::FillOutputPortInformation(int port, vtkInformation* info)
{
  info->Set(vtkDataObject::DATA_TYPE_NAME(), port == 2 ? "vtkTable" : "vtkPolyData");
  return 1;
}

int vtkMEAMPoseInstances::RequestData(
  vtkInformation*, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  auto* posesInput = vtkPolyData::GetData(inputVector[0]);
  auto* output = vtkPolyData::GetData(outputVector, 0);
  auto* ellipsoids = vtkPolyData::GetData(outputVector, 1);
  auto* answer = vtkTable::GetData(outputVector, 2);
  return vtkMEAMRun(
    this,
    [&]
    {
      vtkMEAMConversion::requireInputs(this, { "Poses", "Part" });
      const meam::Progress progress = vtkMEAMConversion::progressOf(this);
      const meam::Poses poses = vtkMEAMConversion::toPoses(posesInput);
      vtkDataArray* ranks = posesInput->GetPointData()->GetArray("Rank");
      const auto rankOf = [&](std::size_t k)
      { return ranks ? std::max(1, vtkMEAMConversion::wholeIn(ranks, k)) : static_cast<int>(k) + 1; };
      const auto meshes = meam::ofIndices<vtkPolyData*>(inputVector[1]->GetNumberOfInformationObjects(),
        [&](int type) { return vtkPolyData::GetData(inputVector[1], type); });
      const std::vector<int> types = vtkMEAMConversion::typesOf(posesInput, static_cast<int>(meshes.size()));
      if (meshes.size() == 1)
      {
        vtkMEAMConversion::fromInstances(meshes.front(), poses, rankOf, *this->Settings, progress, output);
      }
      else
      {
        const auto ofTypes = meam::ofIndices<meam::PartPose>(poses.size(),
          [&](int k) {
            return meam::PartPose{ types[k], k, poses[k] };
          });
        vtkMEAMConversion::fromInstances(meshes, ofTypes, rankOf, *this->Settings, progress, output);
      }
      vtkMEAMConversion::fromAnswer(
        { vtkMEAMConversion::describeHidden(poses, this->Settings->minimumProbability, "MinimumProbability") }, answer);
      if (this->UncertaintyScale > 0.0)
      {
        const auto extent = vtkMEAMConversion::partExtentOf(posesInput);
        const auto isRefined = [](const meam::Pose& pose) { return pose.fit.iterations > 0; };
        if (!extent || !std::all_of(poses.begin(), poses.end(), isRefined))
        {
          throw meam::Error("The poses do not tell how uncertain they are: connect those of MEAM Pose Estimation, "
                            "or set UncertaintyScale to 0.");
        }
        vtkMEAMConversion::fromUncertainties(
          poses, *extent, this->UncertaintyScale, rankOf, *this->Settings, ellipsoids);
      }
    },
    output, ellipsoids, answer);
}

void vtkMEAMPoseInstances::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "MaximumNumberOfInstances: " << this->GetMaximumNumberOfInstances() << "\n";
  os << indent << "MinimumProbability: " << this->GetMinimumProbability() << "\n";
  os << indent << "UncertaintyScale: " << this->UncertaintyScale << "\n";
}
