// SPDX-License-Identifier: BSD-3-Clause
#include "vtkMEAMPoseRefinement.h"

#include "pose/refinement/PoseRefinement.h"
#include "vtkMEAMArrays.h"
#include "vtkMEAMModelConversion.h"
#include "vtkMEAMPoseConversion.h"
#include "vtkMEAMRun.h"
#include "vtkMEAMSceneConversion.h"
#include "vtkMEAMSceneTime.h"

#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkObjectFactory.h"
#include "vtkPartitionedDataSetCollection.h"
#include "vtkPolyData.h"
#include "scene/Units.h"

vtkStandardNewMacro(vtkMEAMPoseRefinement);

vtkMEAMPoseRefinement::vtkMEAMPoseRefinement()
{
  this->SetNumberOfInputPorts(4);
  this->SetParametersToRecommended();
}

void vtkMEAMPoseRefinement::SetParametersToPaper() { this->SetParameters(meam::paperRefinementSettings()); }

void vtkMEAMPoseRefinement::SetParametersToRecommended() { this->SetParameters({}); }

void vtkMEAMPoseRefinement::SetParameters(const meam::PoseRefinementSettings& settings)
{
  this->Method = static_cast<int>(settings.method);
  this->NumberOfIterations = settings.iterations;
  this->MaximumDistance = settings.maximumDistance;
  this->Modified();
}

int vtkMEAMPoseRefinement::FillInputPortInformation(int port, vtkInformation* info)
{
  const char* types[] = { "vtkPolyData", "vtkPartitionedDataSetCollection", "vtkPolyData", "vtkPointSet" };
  info->Set(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), types[port]);
  if (port == 3)
  {
    info->Set(vtkAlgorithm::INPUT_IS_OPTIONAL(), 1);
  }
  return 1;
}

int vtkMEAMPoseRefinement::RequestInformation(
  vtkInformation*, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  vtkMEAMSceneTime::announce(inputVector, { 3, 2, 0 }, outputVector);
  return 1;
}

int vtkMEAMPoseRefinement::RequestData(
  vtkInformation*, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  using namespace vtkMEAMConversion;
  vtkPolyData* candidates = vtkPolyData::GetData(inputVector[0]);
  auto* trained = vtkPartitionedDataSetCollection::GetData(inputVector[1]);
  vtkPolyData* edges = vtkPolyData::GetData(inputVector[2]);
  vtkPointSet* surface = vtkPointSet::GetData(inputVector[3]);
  vtkPolyData* output = vtkPolyData::GetData(outputVector);
  const auto work = [&]
  {
    meam::PoseRefinementSettings settings;
    settings.method = static_cast<meam::RefinementMethod>(this->Method);
    settings.iterations = this->NumberOfIterations;
    settings.maximumDistance = this->MaximumDistance;
    settings.threads = this->NumberOfThreads;
    const meam::TrainedModel model = toTrainedModel(trained);
    const meam::Sensor sensor = sensorOf(this->Projection, this->ViewDirection, this->SensorPosition, surface);
    const meam::Scene scene = sceneOf(edges, surface, sensor, this->NumberOfThreads);
    meam::requireSameUnits(scene.edges.points, model.diameter);
    const meam::Poses poses = toPoses(candidates);
    fromPoses(meam::refinePoses(poses, model, scene, settings, progressOf(this)), output);
    setDiameter(output, model.diameter);
  };
  return vtkMEAMRun(this, work, output);
}

void vtkMEAMPoseRefinement::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Method: " << (this->Method == PointToPoint ? "PointToPoint" : "EdgesAndSurface") << "\n";
  os << indent << "NumberOfIterations: " << this->NumberOfIterations << "\n";
  os << indent << "MaximumDistance: " << this->MaximumDistance << "\n";
}
