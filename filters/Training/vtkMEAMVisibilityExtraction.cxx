// SPDX-License-Identifier: BSD-3-Clause
#include "vtkMEAMVisibilityExtraction.h"

#include "mesh/TriangleMesh.h"
#include "model/VisibilityExtraction.h"
#include "vtkMEAMCloudConversion.h"
#include "vtkMEAMMeshConversion.h"
#include "vtkMEAMModelConversion.h"
#include "vtkMEAMRun.h"
#include "vtkMEAMSettings.h"

#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkObjectFactory.h"
#include "vtkPartitionedDataSetCollection.h"
#include "vtkPolyData.h"

vtkStandardNewMacro(vtkMEAMVisibilityExtraction);

vtkMEAMVisibilityExtraction::vtkMEAMVisibilityExtraction()
  : Settings(new meam::VisibilityExtractionSettings)
{
  this->SetNumberOfInputPorts(2);
}

vtkMEAMVisibilityExtraction::~vtkMEAMVisibilityExtraction() = default;

vtkMEAMClampedSettingMacro(vtkMEAMVisibilityExtraction, Method, int, method, HiddenPointRemoval, MeshVisibility)
vtkMEAMClampedSettingMacro(vtkMEAMVisibilityExtraction, NumberOfViewpoints, int, viewpoints, 0, 1000)
vtkMEAMClampedSettingMacro(vtkMEAMVisibilityExtraction, ConeAngle, double, coneAngle, 1.0, 180.0)
vtkMEAMClampedSettingMacro(vtkMEAMVisibilityExtraction, RadiusFactor, double, radiusFactor, 1.0, VTK_DOUBLE_MAX)
vtkMEAMClampedSettingMacro(
  vtkMEAMVisibilityExtraction, ViewpointDistance, double, viewpointDistance, 1.0, VTK_DOUBLE_MAX)

int vtkMEAMVisibilityExtraction::FillInputPortInformation(int port, vtkInformation* info)
{
  using namespace vtkMEAMConversion;
  return port == 0 ? fillInputPort(info, { "vtkPolyData" }, Connections::One)
                   : fillInputPort(info, { "vtkPolyData" }, Connections::OneOrNone);
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
    meam::VisibilityExtractionSettings settings = *this->Settings;
    settings.coneDirection = Eigen::Vector3d(this->ConeDirection);
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
  os << indent << "Method: " << (this->GetMethod() == MeshVisibility ? "MeshVisibility" : "HiddenPointRemoval") << "\n";
  os << indent << "NumberOfViewpoints: " << this->GetNumberOfViewpoints() << "\n";
  os << indent << "ConeDirection: " << this->ConeDirection[0] << " " << this->ConeDirection[1] << " "
     << this->ConeDirection[2] << "\n";
  os << indent << "ConeAngle: " << this->GetConeAngle() << "\n";
  os << indent << "RadiusFactor: " << this->GetRadiusFactor() << "\n";
  os << indent << "ViewpointDistance: " << this->GetViewpointDistance() << "\n";
}
