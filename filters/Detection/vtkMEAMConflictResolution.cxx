// SPDX-License-Identifier: BSD-3-Clause
#include "vtkMEAMConflictResolution.h"

#include "base/sequences/Sequences.h"
#include "pose/search/ConflictResolution.h"
#include "vtkMEAMPoseConversion.h"
#include "vtkMEAMRun.h"
#include "vtkMEAMSceneConversion.h"
#include "vtkMEAMSceneRequests.h"
#include "vtkMEAMSettings.h"
#include "vtkMEAMSharedData.h"

#include "vtkFieldData.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkObjectFactory.h"
#include "vtkPartitionedDataSetCollection.h"
#include "vtkPolyData.h"

#include <algorithm>
#include <iterator>
#include <memory>
#include <string>
#include <vector>

vtkStandardNewMacro(vtkMEAMConflictResolution);

namespace
{
/// One type of part as the core has it.
struct Part
{
  std::shared_ptr<const meam::TrainedModel> model;
  std::shared_ptr<const meam::Scene> scene;
  std::shared_ptr<const meam::LocalPoses> found;
  meam::Poses input; ///< the same in the scene's coordinates
};
}

vtkMEAMConflictResolution::vtkMEAMConflictResolution()
  : Settings(new meam::ConflictResolutionSettings)
{
  this->SetNumberOfInputPorts(4);
}

vtkMEAMConflictResolution::~vtkMEAMConflictResolution() = default;

vtkMEAMClampedSettingMacro(vtkMEAMConflictResolution, MaximumShared, double, shared, 0.0, 1.0)
vtkMEAMClampedSettingMacro(vtkMEAMConflictResolution, MaximumNumberOfPoses, int, maximumPoses, 0, VTK_INT_MAX)

int vtkMEAMConflictResolution::FillInputPortInformation(int port, vtkInformation* info)
{
  using namespace vtkMEAMConversion;
  const char* types[] = { "vtkPolyData", "vtkPartitionedDataSetCollection", "vtkPolyData", "vtkPointSet" };
  return fillInputPort(info, { types[port] }, port < 2 ? Connections::Any : Connections::OneOrNone);
}

int vtkMEAMConflictResolution::RequestInformation(
  vtkInformation*, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  vtkMEAMSceneRequests::announceTime(inputVector, { 3, 2, 0 }, outputVector);
  return 1;
}

int vtkMEAMConflictResolution::RequestData(
  vtkInformation*, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  using namespace vtkMEAMConversion;
  vtkPolyData* edges = vtkPolyData::GetData(inputVector[2]);
  vtkPointSet* surface = vtkPointSet::GetData(inputVector[3]);
  vtkPolyData* output = vtkPolyData::GetData(outputVector);
  return vtkMEAMRun(
    this,
    [&]
    {
      requireInputs(this, { "Poses", "Models", "Scene Edges" });
      const int count = inputVector[0]->GetNumberOfInformationObjects();
      const int models = inputVector[1]->GetNumberOfInformationObjects();
      if (count != models)
      {
        throw meam::Error("There are poses of " + std::to_string(count) + " parts and models of " +
                          std::to_string(models) + ": connect both of each part, in the same order.");
      }
      const meam::Sensor sensor = sensorOf(this->Projection, this->ViewDirection, this->SensorPosition, surface);
      std::vector<Part> parts;
      for (int i = 0; i < count; ++i)
      {
        Part part;
        part.model = sharedModel(vtkPartitionedDataSetCollection::GetData(inputVector[1], i));
        part.scene = sharedScene(edges, surface, sensor, part.model->diameter, this->NumberOfThreads);
        auto* found = vtkPolyData::GetData(inputVector[0], i);
        part.found = sharedPoses(found, *part.scene, part.model->symmetries);
        part.input = toPoses(found);
        parts.push_back(part);
      }
      const auto detections = meam::mapped<meam::PartDetections>(parts,
        [&](const Part& part) {
          return meam::PartDetections{ *part.scene, *part.model, part.found->poses };
        });
      this->Settings->threads = this->NumberOfThreads;
      const std::vector<meam::PartPose> stay = meam::resolveConflicts(detections, *this->Settings, progressOf(this));
      meam::Poses poses;
      for (const meam::PartPose& pose : stay)
      {
        poses.push_back(parts[pose.part].input[pose.index]); // where it came from, to the last bit
        poses.back().viewId = pose.pose.viewId;
      }
      fromPoses(poses, output);
      std::vector<const meam::TrainedModel*> trained;
      std::transform(
        parts.begin(), parts.end(), std::back_inserter(trained), [](const Part& part) { return part.model.get(); });
      output->GetFieldData()->Initialize(); // of what came along from the first part
      setParts(stay, trained, output);
    },
    output);
}

void vtkMEAMConflictResolution::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "MaximumShared: " << this->GetMaximumShared() << "\n";
  os << indent << "MaximumNumberOfPoses: " << this->GetMaximumNumberOfPoses() << "\n";
}
