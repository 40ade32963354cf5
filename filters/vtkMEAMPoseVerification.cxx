// SPDX-License-Identifier: BSD-3-Clause
#include "vtkMEAMPoseVerification.h"

#include "pose/verification/PoseVerification.h"
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

vtkStandardNewMacro(vtkMEAMPoseVerification);

vtkMEAMPoseVerification::vtkMEAMPoseVerification()
{
  this->SetNumberOfInputPorts(4);
  this->SetParametersToRecommended();
}

void vtkMEAMPoseVerification::SetParametersToPaper() { this->SetParameters(meam::paperVerificationSettings()); }

void vtkMEAMPoseVerification::SetParametersToRecommended() { this->SetParameters({}); }

void vtkMEAMPoseVerification::SetParameters(const meam::PoseVerificationSettings& settings)
{
  this->Method = static_cast<int>(settings.method);
  this->Tolerance = settings.tolerance;
  this->EvidenceWeights[0] = settings.evidence.edgeWeight;
  this->EvidenceWeights[1] = settings.evidence.surfaceWeight;
  this->EvidenceWeights[2] = settings.evidence.explainedWeight;
  this->FreeSpace = settings.evidence.freeSpace;
  this->SameVisibility = settings.evidence.sameVisibility;
  this->MinimumScore = settings.minimumScore;
  this->PosesPerView = settings.posesPerView;
  this->ClusterDistance = settings.clusterDistance;
  this->ClusterAngle = settings.clusterAngle;
  this->PosesPerInstance = settings.posesPerInstance;
  this->MaximumNumberOfPoses = settings.maximumPoses;
  this->MinimumProbability = settings.minimumProbability;
  this->Modified();
}

int vtkMEAMPoseVerification::FillInputPortInformation(int port, vtkInformation* info)
{
  const char* types[] = { "vtkPolyData", "vtkPartitionedDataSetCollection", "vtkPolyData", "vtkPointSet" };
  info->Set(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), types[port]);
  if (port == 3)
  {
    info->Set(vtkAlgorithm::INPUT_IS_OPTIONAL(), 1);
  }
  return 1;
}

int vtkMEAMPoseVerification::RequestInformation(
  vtkInformation*, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  vtkMEAMSceneTime::announce(inputVector, { 3, 2, 0 }, outputVector);
  return 1;
}

int vtkMEAMPoseVerification::RequestData(
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
    meam::PoseVerificationSettings settings;
    settings.method = static_cast<meam::VerificationMethod>(this->Method);
    settings.tolerance = this->Tolerance;
    settings.evidence.edgeWeight = this->EvidenceWeights[0];
    settings.evidence.surfaceWeight = this->EvidenceWeights[1];
    settings.evidence.explainedWeight = this->EvidenceWeights[2];
    settings.evidence.freeSpace = this->FreeSpace;
    settings.evidence.sameVisibility = this->SameVisibility;
    settings.minimumScore = this->MinimumScore;
    settings.posesPerView = this->PosesPerView;
    settings.clusterDistance = this->ClusterDistance;
    settings.clusterAngle = this->ClusterAngle;
    settings.posesPerInstance = this->PosesPerInstance;
    settings.maximumPoses = this->MaximumNumberOfPoses;
    settings.minimumProbability = this->MinimumProbability;
    settings.threads = this->NumberOfThreads;
    const meam::TrainedModel model = toTrainedModel(trained);
    const meam::Sensor sensor = sensorOf(this->Projection, this->ViewDirection, this->SensorPosition, surface);
    const meam::Scene scene = sceneOf(edges, surface, sensor, this->NumberOfThreads);
    meam::requireSameUnits(scene.edges.points, model.diameter);
    const meam::Poses poses = toPoses(candidates);
    fromPoses(meam::verifyPoses(poses, model, scene, settings, progressOf(this)), output);
    setDiameter(output, model.diameter);
  };
  return vtkMEAMRun(this, work, output);
}

void vtkMEAMPoseVerification::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Method: " << (this->Method == EdgeCoverage ? "EdgeCoverage" : "VisibleEvidence") << "\n";
  os << indent << "Tolerance: " << this->Tolerance << "\n";
  os << indent << "EvidenceWeights: " << this->EvidenceWeights[0] << " " << this->EvidenceWeights[1] << " "
     << this->EvidenceWeights[2] << "\n";
  os << indent << "FreeSpace: " << this->FreeSpace << "\n";
  os << indent << "SameVisibility: " << this->SameVisibility << "\n";
  os << indent << "MinimumScore: " << this->MinimumScore << "\n";
  os << indent << "PosesPerView: " << this->PosesPerView << "\n";
  os << indent << "ClusterDistance: " << this->ClusterDistance << "\n";
  os << indent << "ClusterAngle: " << this->ClusterAngle << "\n";
  os << indent << "PosesPerInstance: " << this->PosesPerInstance << "\n";
  os << indent << "MaximumNumberOfPoses: " << this->MaximumNumberOfPoses << "\n";
  os << indent << "MinimumProbability: " << this->MinimumProbability << "\n";
}
