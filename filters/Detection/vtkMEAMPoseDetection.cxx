// SPDX-License-Identifier: BSD-3-Clause
#include "vtkMEAMPoseDetection.h"

#include "baselines/BaselineSettings.h"
#include "pose/voting/PoseDetection.h"
#include "scene/Scene.h"
#include "scene/Units.h"
#include "vtkMEAMRun.h"
#include "vtkMEAMSceneConversion.h"
#include "vtkMEAMSceneRequests.h"
#include "vtkMEAMSettings.h"
#include "vtkMEAMSharedData.h"

#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkObjectFactory.h"
#include "vtkPartitionedDataSetCollection.h"
#include "vtkPolyData.h"

vtkStandardNewMacro(vtkMEAMPoseDetection);

struct vtkMEAMPoseDetection::SharedData
{
  std::shared_ptr<const meam::TrainedModel> Model;
  std::shared_ptr<const meam::Scene> Scene;
  std::shared_ptr<const meam::LocalPoses> Poses;
};

vtkMEAMPoseDetection::vtkMEAMPoseDetection()
  : Shared(new SharedData)
  , Settings(new meam::PoseDetectionSettings)
{
  this->SetNumberOfInputPorts(3);
}

vtkMEAMPoseDetection::~vtkMEAMPoseDetection() = default;

vtkMEAMClampedSettingMacro(vtkMEAMPoseDetection, Features, int, features, Edges, Both)
vtkMEAMClampedSettingMacro(vtkMEAMPoseDetection, ReferenceShare, double, referenceShare, 0.0, 1.0)
vtkMEAMClampedSettingMacro(vtkMEAMPoseDetection, ReferredShare, double, referredShare, 1e-6, 1.0)
vtkMEAMClampedSettingMacro(vtkMEAMPoseDetection, PeaksPerReference, int, peaksPerReference, 1, 100)
vtkMEAMSettingMacro(vtkMEAMPoseDetection, SignedTangents, bool, signedTangents)
vtkMEAMSettingMacro(vtkMEAMPoseDetection, SmoothPeaks, bool, smoothPeaks)
vtkMEAMClampedSettingMacro(vtkMEAMPoseDetection, Seed, int, seed, 0, VTK_INT_MAX)
vtkMEAMParametersMacro(vtkMEAMPoseDetection, Paper, meam::paperDetectionSettings());
vtkMEAMParametersMacro(vtkMEAMPoseDetection, Recommended, {});
vtkMEAMParametersMacro(vtkMEAMPoseDetection, OriginalPPF, meam::originalDetectionSettings());

int vtkMEAMPoseDetection::FillInputPortInformation(int port, vtkInformation* info)
{
  const char* types[] = { "vtkPolyData", "vtkPartitionedDataSetCollection", "vtkPointSet" };
  return vtkMEAMConversion::fillInputPort(info, { types[port] }, vtkMEAMConversion::Connections::OneOrNone);
}

int vtkMEAMPoseDetection::RequestInformation(
  vtkInformation*, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  vtkMEAMSceneRequests::announceTime(inputVector, { 2, 0 }, outputVector);
  return 1;
}

int vtkMEAMPoseDetection::RequestData(
  vtkInformation*, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  using namespace vtkMEAMConversion;
  vtkPolyData* edges = vtkPolyData::GetData(inputVector[0]);
  auto* trained = vtkPartitionedDataSetCollection::GetData(inputVector[1]);
  vtkPointSet* surface = vtkPointSet::GetData(inputVector[2]);
  vtkPolyData* output = vtkPolyData::GetData(outputVector);
  const auto work = [&]
  {
    requireInputs(this, { "Scene Edges", "Model" });
    this->Settings->threads = this->NumberOfThreads;
    const auto model = sharedModel(trained);
    const meam::Sensor sensor = sensorOf(this->Projection, this->ViewDirection, this->SensorPosition, surface);
    const auto scene = sharedScene(edges, surface, sensor, model->diameter, this->NumberOfThreads);
    meam::Poses poses = meam::detectPoses(*scene, *model, *this->Settings, progressOf(this));
    *this->Shared = { model, scene, sharePoses({ scene->T_local_scene(), std::move(poses) }, *model, output) };
    const std::string warning = meam::unitsWarning(scene->edgePoints().points, model->diameter);
    if (!warning.empty())
    {
      vtkWarningMacro(<< warning);
    }
  };
  return vtkMEAMRun(this, work, output);
}

void vtkMEAMPoseDetection::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Features: " << meam::nameOf(this->Settings->features) << "\n";
  os << indent << "ReferenceShare: " << this->GetReferenceShare() << "\n";
  os << indent << "ReferredShare: " << this->GetReferredShare() << "\n";
  os << indent << "PeaksPerReference: " << this->GetPeaksPerReference() << "\n";
  os << indent << "SignedTangents: " << this->GetSignedTangents() << "\n";
  os << indent << "SmoothPeaks: " << this->GetSmoothPeaks() << "\n";
  os << indent << "Seed: " << this->GetSeed() << "\n";
}
