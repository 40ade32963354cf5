// SPDX-License-Identifier: BSD-3-Clause
#include "vtkMEAMHashing.h"

#include "model/MEAMHashing.h"
#include "vtkMEAMArrays.h"
#include "vtkMEAMCloudConversion.h"
#include "vtkMEAMModelConversion.h"
#include "vtkMEAMRun.h"
#include "vtkMEAMSharedData.h"
#include "vtkMEAMSymmetryConversion.h"

#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkObjectFactory.h"
#include "vtkPartitionedDataSetCollection.h"
#include "vtkPolyData.h"

vtkStandardNewMacro(vtkMEAMHashing);

struct vtkMEAMHashing::SharedData
{
  std::shared_ptr<const meam::TrainedModel> Model;
};

vtkMEAMHashing::vtkMEAMHashing()
  : Shared(new SharedData)
{
  this->SetNumberOfInputPorts(2);
  this->SetParametersToRecommended();
}

vtkMEAMHashing::~vtkMEAMHashing() = default;

void vtkMEAMHashing::SetParametersToPaper() { this->SetParameters(meam::paperHashingSettings()); }

void vtkMEAMHashing::SetParametersToRecommended() { this->SetParameters({}); }

void vtkMEAMHashing::SetParameters(const meam::MEAMHashingSettings& settings)
{
  this->Features = static_cast<int>(settings.features);
  this->SurfaceDistanceStep = settings.surface.distanceStep;
  this->SurfaceAngleStep = settings.surface.angleStep;
  this->SurfaceLeafSize = settings.surface.leafSize;
  this->Feature = static_cast<int>(settings.feature);
  this->DistanceStep = settings.distanceStep;
  this->AngleStep = settings.angleStep;
  this->ViewMerging = static_cast<int>(settings.merging);
  this->VoxelSize = settings.voxelSize;
  this->LeafSize = settings.leafSize;
  this->CoVisibilityDirections = settings.coVisibilityDirections;
  this->Modified();
}

int vtkMEAMHashing::FillInputPortInformation(int port, vtkInformation* info)
{
  info->Set(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), port == 0 ? "vtkPartitionedDataSetCollection" : "vtkPolyData");
  if (port == 1)
  {
    info->Set(vtkAlgorithm::INPUT_IS_OPTIONAL(), 1);
  }
  return 1;
}

int vtkMEAMHashing::RequestData(vtkInformation*, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  using namespace vtkMEAMConversion;
  auto* input = vtkPartitionedDataSetCollection::GetData(inputVector[0]);
  vtkPolyData* samples = vtkPolyData::GetData(inputVector[1]);
  auto* output = vtkPartitionedDataSetCollection::GetData(outputVector);
  const auto work = [&]
  {
    meam::MEAMHashingSettings settings;
    settings.features = static_cast<meam::Features>(this->Features);
    settings.surface.distanceStep = this->SurfaceDistanceStep;
    settings.surface.angleStep = this->SurfaceAngleStep;
    settings.surface.leafSize = this->SurfaceLeafSize;
    settings.feature = static_cast<meam::PairFeatureKind>(this->Feature);
    settings.distanceStep = this->DistanceStep;
    settings.angleStep = this->AngleStep;
    settings.merging = static_cast<meam::ViewMerging>(this->ViewMerging);
    settings.voxelSize = this->VoxelSize;
    settings.leafSize = this->LeafSize;
    settings.coVisibilityDirections = this->CoVisibilityDirections;
    const meam::PointCloud surface = toCloud(samples);
    if (samples)
    {
      meam::requirePoints(surface.points, "The part's surface");
      if (surface.normals.empty())
      {
        throw meam::Error("The part's surface has no point array 'Normals': use the output of SurfaceSampling.");
      }
    }
    const meam::PartSurface part{ surface, diameterOf(input), symmetriesOf(samples) };
    const auto model = std::make_shared<const meam::TrainedModel>(
      meam::hashModels(toAppearanceModels(input), part, settings, progressOf(this)));
    fromTrainedModel(*model, output);
    shareModel(output, model);
    this->Shared->Model = model;
  };
  return vtkMEAMRun(this, work, output);
}

void vtkMEAMHashing::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Features: " << meam::nameOf(static_cast<meam::Features>(this->Features)) << "\n";
  os << indent << "SurfaceDistanceStep: " << this->SurfaceDistanceStep << "\n";
  os << indent << "SurfaceAngleStep: " << this->SurfaceAngleStep << "\n";
  os << indent << "SurfaceLeafSize: " << this->SurfaceLeafSize << "\n";
  os << indent << "Feature: " << (this->Feature == Paper ? "Paper" : "Oriented") << "\n";
  os << indent << "DistanceStep: " << this->DistanceStep << "\n";
  os << indent << "AngleStep: " << this->AngleStep << "\n";
  os << indent << "ViewMerging: " << this->ViewMerging << "\n";
  os << indent << "VoxelSize: " << this->VoxelSize << "\n";
  os << indent << "LeafSize: " << this->LeafSize << "\n";
  os << indent << "CoVisibilityDirections: " << this->CoVisibilityDirections << "\n";
}
