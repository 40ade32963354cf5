// SPDX-License-Identifier: BSD-3-Clause
#include "vtkMEAMPoseAlgorithm.h"

#include "vtkMEAMPoseConversion.h"
#include "vtkMEAMPoseWork.h"
#include "vtkMEAMRun.h"
#include "vtkMEAMSceneConversion.h"
#include "vtkMEAMSceneRequests.h"
#include "vtkMEAMSharedData.h"

#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkPartitionedDataSetCollection.h"
#include "vtkPolyData.h"

struct vtkMEAMPoseAlgorithm::SharedData
{
  std::shared_ptr<const meam::TrainedModel> Model;
  std::shared_ptr<const meam::Scene> Scene;
  std::shared_ptr<const meam::LocalPoses> Poses;
};

vtkMEAMPoseAlgorithm::vtkMEAMPoseAlgorithm()
  : Shared(new SharedData)
{
  this->SetNumberOfInputPorts(4);
}

vtkMEAMPoseAlgorithm::~vtkMEAMPoseAlgorithm() = default;

int vtkMEAMPoseAlgorithm::FillInputPortInformation(int port, vtkInformation* info)
{
  const char* types[] = { "vtkPolyData", "vtkPartitionedDataSetCollection", "vtkPolyData", "vtkPointSet" };
  return vtkMEAMConversion::fillInputPort(info, { types[port] }, vtkMEAMConversion::Connections::OneOrNone);
}

int vtkMEAMPoseAlgorithm::RequestInformation(
  vtkInformation*, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  vtkMEAMSceneRequests::announceTime(inputVector, { 3, 2, 0 }, outputVector);
  return 1;
}

int vtkMEAMPoseAlgorithm::RequestData(
  vtkInformation*, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  using namespace vtkMEAMConversion;
  vtkPolyData* input = vtkPolyData::GetData(inputVector[0]);
  auto* trained = vtkPartitionedDataSetCollection::GetData(inputVector[1]);
  vtkPolyData* edges = vtkPolyData::GetData(inputVector[2]);
  vtkPointSet* surface = vtkPointSet::GetData(inputVector[3]);
  vtkPolyData* output = vtkPolyData::GetData(outputVector);
  const auto work = [&]
  {
    requireInputs(this, { "Poses", "Model", "Scene Edges" });
    const auto model = sharedModel(trained);
    const meam::Sensor sensor = sensorOf(this->Projection, this->ViewDirection, this->SensorPosition, surface);
    const auto scene = sharedScene(edges, surface, sensor, model->diameter, this->NumberOfThreads);
    const auto poses = sharedPoses(input, *scene, model->symmetries);
    Work step{ poses->poses, *scene, *model, progressOf(this), evidenceRatesOf(input), {} };
    this->Process(step);
    *this->Shared = { model, scene, sharePoses({ scene->T_local_scene(), std::move(step.result) }, *model, output) };
    setEvidenceRates(output, step.rates);
  };
  return vtkMEAMRun(this, work, output);
}
