// SPDX-License-Identifier: BSD-3-Clause
#include "vtkMEAMVisibilityExtraction.h"

#include "mesh/TriangleMesh.h"
#include "model/VisibilityExtraction.h"
#include "vtkMEAMCloudConversion.h"
#include "vtkMEAMMeshConversion.h"
#include "vtkMEAMModelConversion.h"
#include "vtkMEAMRun.h"

#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkObjectFactory.h"
#include "vtkPartitionedDataSetCollection.h"
#include "vtkPolyData.h"

#include <algorithm>

vtkStandardNewMacro(vtkMEAMVisibilityExtraction);

vtkMEAMVisibilityExtraction::vtkMEAMVisibilityExtraction()
{
  const meam::VisibilityExtractionSettings settings;
  this->SetNumberOfInputPorts(2);
  this->Method = static_cast<int>(settings.method);
  std::copy_n(settings.coneDirection.data(), 3, this->ConeDirection);
  this->ConeAngle = settings.coneAngle;
  this->NumberOfViewpoints = settings.viewpoints;
  this->RadiusFactor = settings.radiusFactor;
  this->ViewpointDistance = settings.viewpointDistance;
}

int vtkMEAMVisibilityExtraction::FillInputPortInformation(int port, vtkInformation* info)
{
  info->Set(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkPolyData");
  if (port == 1)
  {
    info->Set(vtkAlgorithm::INPUT_IS_OPTIONAL(), 1);
  }
  return 1;
}

int vtkMEAMVisibilityExtraction::RequestData(
  vtkInformation*, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  using namespace vtkMEAMConversion;
  vtkPolyData* input = vtkPolyData::GetData(inputVector[0]);
  vtkPolyData* meshInput = vtkPolyData::GetData(inputVector[1]);
  auto* output = vtkPartitionedDataSetCollection::GetData(outputVector);
  const auto work = [&]
  {
    meam::VisibilityExtractionSettings settings;
    settings.method = static_cast<meam::VisibilityMethod>(this->Method);
    settings.viewpoints = this->NumberOfViewpoints;
    settings.coneDirection = Eigen::Vector3d(this->ConeDirection);
    settings.coneAngle = this->ConeAngle;
    settings.radiusFactor = this->RadiusFactor;
    settings.viewpointDistance = this->ViewpointDistance;
    const meam::PointCloud surface = toCloud(input);
    meam::requirePoints(surface.points, "The part's surface");
    const meam::TriangleMesh mesh = meshInput ? toMesh(meshInput) : meam::TriangleMesh();
    fromAppearanceModels(
      meam::extractVisibility(meam::finitePoints(surface), settings, meshInput ? &mesh : nullptr, progressOf(this)),
      output);
  };
  return vtkMEAMRun(this, work, output);
}

void vtkMEAMVisibilityExtraction::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Method: " << (this->Method == MeshVisibility ? "MeshVisibility" : "HiddenPointRemoval") << "\n";
  os << indent << "NumberOfViewpoints: " << this->NumberOfViewpoints << "\n";
  os << indent << "ConeDirection: " << this->ConeDirection[0] << " " << this->ConeDirection[1] << " "
     << this->ConeDirection[2] << "\n";
  os << indent << "ConeAngle: " << this->ConeAngle << "\n";
  os << indent << "RadiusFactor: " << this->RadiusFactor << "\n";
  os << indent << "ViewpointDistance: " << this->ViewpointDistance << "\n";
}
