// SPDX-License-Identifier: BSD-3-Clause
#include "vtkMEAMBoundaryExtraction.h"

#include "mesh/TriangleMesh.h"
#include "model/BoundaryExtraction.h"
#include "vtkMEAMMeshConversion.h"
#include "vtkMEAMModelConversion.h"
#include "vtkMEAMRun.h"
#include "vtkMEAMSettings.h"

#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkObjectFactory.h"
#include "vtkPartitionedDataSetCollection.h"
#include "vtkPolyData.h"

vtkStandardNewMacro(vtkMEAMBoundaryExtraction);

vtkMEAMBoundaryExtraction::vtkMEAMBoundaryExtraction()
  : Settings(new meam::BoundaryExtractionSettings)
{
  this->SetNumberOfInputPorts(2);
}

vtkMEAMBoundaryExtraction::~vtkMEAMBoundaryExtraction() = default;

vtkMEAMClampedSettingMacro(vtkMEAMBoundaryExtraction, Method, int, method, PointBoundary, MeshEdges)
vtkMEAMClampedSettingMacro(vtkMEAMBoundaryExtraction, Radius, double, radius, 0.0, VTK_DOUBLE_MAX)
vtkMEAMClampedSettingMacro(vtkMEAMBoundaryExtraction, Angle, double, angle, 0.0, 360.0)
vtkMEAMClampedSettingMacro(vtkMEAMBoundaryExtraction, SharpAngle, double, sharpAngle, 1.0, 179.0)

int vtkMEAMBoundaryExtraction::FillInputPortInformation(int port, vtkInformation* info)
{
  using namespace vtkMEAMConversion;
  return port == 0 ? fillInputPort(info, { "vtkPartitionedDataSetCollection" }, Connections::One)
                   : fillInputPort(info, { "vtkPolyData" }, Connections::OneOrNone);
}

int vtkMEAMBoundaryExtraction::RequestData(
  vtkInformation*, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  using namespace vtkMEAMConversion;
  auto* input = vtkPartitionedDataSetCollection::GetData(inputVector[0]);
  vtkPolyData* meshInput = vtkPolyData::GetData(inputVector[1]);
  auto* output = vtkPartitionedDataSetCollection::GetData(outputVector);
  const auto work = [&]
  {
    const meam::TriangleMesh mesh = meshInput ? toMesh(meshInput) : meam::TriangleMesh();
    fromAppearanceModels(
      meam::extractBoundary(toAppearanceModels(input), *this->Settings, meshInput ? &mesh : nullptr, progressOf(this)),
      output);
  };
  return vtkMEAMRun(this, work, output);
}

void vtkMEAMBoundaryExtraction::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Method: " << (this->GetMethod() == MeshEdges ? "MeshEdges" : "PointBoundary") << "\n";
  os << indent << "Radius: " << this->GetRadius() << "\n";
  os << indent << "Angle: " << this->GetAngle() << "\n";
  os << indent << "SharpAngle: " << this->GetSharpAngle() << "\n";
}
