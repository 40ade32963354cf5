// SPDX-License-Identifier: BSD-3-Clause
#include "vtkMEAMBoundaryExtraction.h"

#include "mesh/TriangleMesh.h"
#include "model/BoundaryExtraction.h"
#include "vtkMEAMMeshConversion.h"
#include "vtkMEAMModelConversion.h"
#include "vtkMEAMRun.h"

#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkObjectFactory.h"
#include "vtkPartitionedDataSetCollection.h"
#include "vtkPolyData.h"

vtkStandardNewMacro(vtkMEAMBoundaryExtraction);

vtkMEAMBoundaryExtraction::vtkMEAMBoundaryExtraction()
{
  const meam::BoundaryExtractionSettings settings;
  this->SetNumberOfInputPorts(2);
  this->Method = static_cast<int>(settings.method);
  this->Radius = settings.radius;
  this->Angle = settings.angle;
  this->SharpAngle = settings.sharpAngle;
}

int vtkMEAMBoundaryExtraction::FillInputPortInformation(int port, vtkInformation* info)
{
  info->Set(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), port == 0 ? "vtkPartitionedDataSetCollection" : "vtkPolyData");
  if (port == 1)
  {
    info->Set(vtkAlgorithm::INPUT_IS_OPTIONAL(), 1);
  }
  return 1;
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
    meam::BoundaryExtractionSettings settings;
    settings.method = static_cast<meam::BoundaryMethod>(this->Method);
    settings.radius = this->Radius;
    settings.angle = this->Angle;
    settings.sharpAngle = this->SharpAngle;
    const meam::TriangleMesh mesh = meshInput ? toMesh(meshInput) : meam::TriangleMesh();
    fromAppearanceModels(
      meam::extractBoundary(toAppearanceModels(input), settings, meshInput ? &mesh : nullptr, progressOf(this)),
      output);
  };
  return vtkMEAMRun(this, work, output);
}

void vtkMEAMBoundaryExtraction::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Method: " << (this->Method == MeshEdges ? "MeshEdges" : "PointBoundary") << "\n";
  os << indent << "Radius: " << this->Radius << "\n";
  os << indent << "Angle: " << this->Angle << "\n";
  os << indent << "SharpAngle: " << this->SharpAngle << "\n";
}
