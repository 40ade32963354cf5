// SPDX-License-Identifier: BSD-3-Clause
#include "vtkMEAMConflictResolution.h"

#include "pose/selection/ConflictResolution.h"
#include "vtkMEAMModelConversion.h"
#include "vtkMEAMPoseConversion.h"
#include "vtkMEAMRun.h"
#include "vtkMEAMSceneConversion.h"
#include "vtkMEAMSceneTime.h"

#include "vtkDoubleArray.h"
#include "vtkFieldData.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkIntArray.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPartitionedDataSetCollection.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "scene/Units.h"

#include <deque>
#include <string>

vtkStandardNewMacro(vtkMEAMConflictResolution);

namespace
{
/// One type of part as the core has it; it refers to itself, so it stays where it was made.
struct Part
{
  Part(vtkPartitionedDataSetCollection* trained, vtkPolyData* found, const meam::Scene& scene, int threads)
    : Model(vtkMEAMConversion::toTrainedModel(trained))
    , Found(vtkMEAMConversion::toPoses(found))
    , Index(Model, scene, threads)
  {
    meam::requireSameUnits(scene.edges.points, this->Model.diameter);
  }
  Part(const Part&) = delete;
  void operator=(const Part&) = delete;

  meam::TrainedModel Model;
  meam::Poses Found;
  meam::SceneIndex Index;
};

void addPartIds(const std::vector<meam::PartPose>& poses, vtkPolyData* output)
{
  vtkNew<vtkIntArray> ids;
  ids->SetName("PartId");
  for (const meam::PartPose& pose : poses)
  {
    ids->InsertNextValue(pose.part);
  }
  output->GetPointData()->AddArray(ids);
}

/// In place of what came along from the first part.
void setDiameters(const std::deque<Part>& parts, vtkPolyData* output)
{
  vtkNew<vtkDoubleArray> diameters;
  diameters->SetName("Diameter");
  for (const Part& part : parts)
  {
    diameters->InsertNextValue(part.Model.diameter);
  }
  output->GetFieldData()->Initialize();
  output->GetFieldData()->AddArray(diameters);
}
}

vtkMEAMConflictResolution::vtkMEAMConflictResolution()
{
  this->SetNumberOfInputPorts(4);
}

int vtkMEAMConflictResolution::FillInputPortInformation(int port, vtkInformation* info)
{
  const char* types[] = { "vtkPolyData", "vtkPartitionedDataSetCollection", "vtkPolyData", "vtkPointSet" };
  info->Set(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), types[port]);
  if (port < 2)
  {
    info->Set(vtkAlgorithm::INPUT_IS_REPEATABLE(), 1);
  }
  if (port == 3)
  {
    info->Set(vtkAlgorithm::INPUT_IS_OPTIONAL(), 1);
  }
  return 1;
}

int vtkMEAMConflictResolution::RequestInformation(
  vtkInformation*, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  vtkMEAMSceneTime::announce(inputVector, { 3, 2, 0 }, outputVector);
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
      const int count = inputVector[0]->GetNumberOfInformationObjects();
      const int models = inputVector[1]->GetNumberOfInformationObjects();
      if (count != models)
      {
        throw meam::Error("There are poses of " + std::to_string(count) + " parts and models of " +
          std::to_string(models) + ": connect both of each part, in the same order.");
      }
      const meam::Sensor sensor = sensorOf(this->Projection, this->ViewDirection, this->SensorPosition, surface);
      const meam::Scene scene = sceneOf(edges, surface, sensor, this->NumberOfThreads);
      std::deque<Part> parts;
      std::vector<meam::PartDetections> detections;
      for (int i = 0; i < count; ++i)
      {
        const Part& part = parts.emplace_back(vtkPartitionedDataSetCollection::GetData(inputVector[1], i),
          vtkPolyData::GetData(inputVector[0], i), scene, this->NumberOfThreads);
        detections.push_back({ part.Index, part.Found });
      }
      meam::ConflictResolutionSettings settings;
      settings.tolerance = this->Tolerance;
      settings.shared = this->MaximumShared;
      settings.maximumPoses = this->MaximumNumberOfPoses;
      settings.threads = this->NumberOfThreads;
      const std::vector<meam::PartPose> stay = meam::resolveConflicts(detections, settings, progressOf(this));
      meam::Poses poses;
      for (const meam::PartPose& pose : stay)
      {
        poses.push_back(pose.pose);
      }
      fromPoses(poses, output);
      addPartIds(stay, output);
      setDiameters(parts, output);
    },
    output);
}

void vtkMEAMConflictResolution::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Tolerance: " << this->Tolerance << " mm\n";
  os << indent << "MaximumShared: " << this->MaximumShared << "\n";
  os << indent << "MaximumNumberOfPoses: " << this->MaximumNumberOfPoses << "\n";
}
