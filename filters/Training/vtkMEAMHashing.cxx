// SPDX-License-Identifier: BSD-3-Clause
#include "vtkMEAMHashing.h"

#include "model/MEAMHashing.h"
#include "vtkMEAMArrays.h"
#include "vtkMEAMCloudConversion.h"
#include "vtkMEAMModelConversion.h"
#include "vtkMEAMRun.h"
#include "vtkMEAMSettings.h"
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
  , Settings(new meam::MEAMHashingSettings)
{
  this->SetNumberOfInputPorts(2);
}

vtkMEAMHashing::~vtkMEAMHashing() = default;

vtkMEAMClampedSettingMacro(vtkMEAMHashing, Features, int, features, Edges, Both)
vtkMEAMClampedSettingMacro(vtkMEAMHashing, SurfaceDistanceStep, double, surface.distanceStep, 0.001, 1.0)
vtkMEAMClampedSettingMacro(vtkMEAMHashing, SurfaceAngleStep, double, surface.angleStep, 1.0, 90.0)
vtkMEAMClampedSettingMacro(vtkMEAMHashing, SurfaceLeafSize, double, surface.leafSize, 0.001, 1.0)
vtkMEAMClampedSettingMacro(vtkMEAMHashing, Feature, int, feature, Paper, Oriented)
vtkMEAMClampedSettingMacro(vtkMEAMHashing, DistanceStep, double, distanceStep, 0.001, 1.0)
vtkMEAMClampedSettingMacro(vtkMEAMHashing, AngleStep, double, angleStep, 1.0, 90.0)
vtkMEAMClampedSettingMacro(vtkMEAMHashing, ViewMerging, int, merging, Points, None)
vtkMEAMClampedSettingMacro(vtkMEAMHashing, VoxelSize, double, voxelSize, 0.0, VTK_DOUBLE_MAX)
vtkMEAMClampedSettingMacro(vtkMEAMHashing, LeafSize, double, leafSize, 0.0, VTK_DOUBLE_MAX)
vtkMEAMClampedSettingMacro(vtkMEAMHashing, CoVisibilityDirections, int, coVisibilityDirections, 0, 32)
vtkMEAMParametersMacro(vtkMEAMHashing, Paper, meam::paperHashingSettings());
vtkMEAMParametersMacro(vtkMEAMHashing, Recommended, {});

int vtkMEAMHashing::FillInputPortInformation(int port, vtkInformation* info)
{
  using namespace vtkMEAMConversion;
  return port == 0 ? fillInputPort(info, { "vtkPartitionedDataSetCollection" }, Connections::One)
                   : fillInputPort(info, { "vtkPolyData" }, Connections::OneOrNone);
}

int vtkMEAMHashing::RequestData(vtkInformation*, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  using namespace vtkMEAMConversion;
  auto* input = vtkPartitionedDataSetCollection::GetData(inputVector[0]);
  vtkPolyData* samples = vtkPolyData::GetData(inputVector[1]);
  auto* output = vtkPartitionedDataSetCollection::GetData(outputVector);
  const auto work = [&]
  {
    const meam::PointCloud surface = toCloud(samples);
    if (samples)
    {
      meam::requirePoints(surface.points, "The part's surface");
      if (surface.normals.empty())
      {
        throw meam::Error("The part's surface has no point array 'Normals': use the output of SurfaceSampling.");
      }
    }
    const meam::PartGeometry part{ surface, diameterOf(input), symmetriesOf(samples) };
    const auto model = std::make_shared<const meam::TrainedModel>(
      meam::hashModels(toAppearanceModels(input), part, *this->Settings, progressOf(this)));
    fromTrainedModel(*model, output);
    shareModel(output, model);
    this->Shared->Model = model;
  };
  return vtkMEAMRun(this, work, output);
}

void vtkMEAMHashing::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Features: " << meam::nameOf(static_cast<meam::Features>(this->GetFeatures())) << "\n";
  os << indent << "SurfaceDistanceStep: " << this->GetSurfaceDistanceStep() << "\n";
  os << indent << "SurfaceAngleStep: " << this->GetSurfaceAngleStep() << "\n";
  os << indent << "SurfaceLeafSize: " << this->GetSurfaceLeafSize() << "\n";
  os << indent << "Feature: " << (this->GetFeature() == Paper ? "Paper" : "Oriented") << "\n";
  os << indent << "DistanceStep: " << this->GetDistanceStep() << "\n";
  os << indent << "AngleStep: " << this->GetAngleStep() << "\n";
  os << indent << "ViewMerging: " << this->GetViewMerging() << "\n";
  os << indent << "VoxelSize: " << this->GetVoxelSize() << "\n";
  os << indent << "LeafSize: " << this->GetLeafSize() << "\n";
  os << indent << "CoVisibilityDirections: " << this->GetCoVisibilityDirections() << "\n";
}
