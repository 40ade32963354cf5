// SPDX-License-Identifier: BSD-3-Clause
#include "vtkMEAMPoseDetection.h"

#include "pose/voting/PoseDetection.h"
#include "vtkMEAMArrays.h"
#include "vtkMEAMCloudConversion.h"
#include "vtkMEAMModelConversion.h"
#include "vtkMEAMPoseConversion.h"
#include "vtkMEAMRun.h"
#include "vtkMEAMSceneConversion.h"
#include "vtkMEAMSceneEdgeConversion.h"

#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkObjectFactory.h"
#include "vtkPartitionedDataSetCollection.h"
#include "vtkPolyData.h"
#include "scene/Units.h"

vtkStandardNewMacro(vtkMEAMPoseDetection);

vtkMEAMPoseDetection::vtkMEAMPoseDetection()
{
  this->SetNumberOfInputPorts(2);
  this->SetParametersToRecommended();
}

void vtkMEAMPoseDetection::SetParametersToPaper() { this->SetParameters(meam::paperDetectionSettings()); }

void vtkMEAMPoseDetection::SetParametersToRecommended()
{
  this->SetParameters({});
  this->SetReferenceShare(0.0);
}

void vtkMEAMPoseDetection::SetParameters(const meam::PoseDetectionSettings& settings)
{
  this->ReferenceShare = settings.referenceShare;
  this->ReferredShare = settings.referredShare;
  this->PeaksPerReference = settings.peaksPerReference;
  this->SignedTangents = settings.signedTangents;
  this->SmoothPeaks = settings.smoothPeaks;
  this->Seed = static_cast<int>(settings.seed);
  this->Modified();
}

int vtkMEAMPoseDetection::FillInputPortInformation(int port, vtkInformation* info)
{
  info->Set(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), port == 0 ? "vtkPolyData" : "vtkPartitionedDataSetCollection");
  return 1;
}

int vtkMEAMPoseDetection::RequestData(
  vtkInformation*, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  using namespace vtkMEAMConversion;
  vtkPolyData* edges = vtkPolyData::GetData(inputVector[0]);
  auto* trained = vtkPartitionedDataSetCollection::GetData(inputVector[1]);
  vtkPolyData* output = vtkPolyData::GetData(outputVector);
  const auto work = [&]
  {
    meam::PoseDetectionSettings settings;
    settings.referenceShare = this->ReferenceShare > 0.0 ? this->ReferenceShare : referenceShareOf(edges);
    settings.referredShare = this->ReferredShare;
    settings.peaksPerReference = this->PeaksPerReference;
    settings.signedTangents = this->SignedTangents;
    settings.smoothPeaks = this->SmoothPeaks;
    settings.seed = static_cast<unsigned>(this->Seed);
    settings.threads = this->NumberOfThreads;
    const meam::TrainedModel model = toTrainedModel(trained);
    const meam::PreciseCloud scene = edgesOf(edges);
    fromPoses(meam::detectPoses(scene, model, settings, progressOf(this)), output);
    setDiameter(output, model.diameter);
    const std::string warning = meam::unitsWarning(toCloud(edges).points, model.diameter);
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
  os << indent << "ReferenceShare: " << this->ReferenceShare << "\n";
  os << indent << "ReferredShare: " << this->ReferredShare << "\n";
  os << indent << "PeaksPerReference: " << this->PeaksPerReference << "\n";
  os << indent << "SignedTangents: " << this->SignedTangents << "\n";
  os << indent << "SmoothPeaks: " << this->SmoothPeaks << "\n";
  os << indent << "Seed: " << this->Seed << "\n";
  os << indent << "NumberOfThreads: " << this->NumberOfThreads << "\n";
}
