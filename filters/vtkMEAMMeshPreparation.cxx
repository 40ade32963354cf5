// SPDX-License-Identifier: BSD-3-Clause
#include "vtkMEAMMeshPreparation.h"

#include "mesh/MeshPreparation.h"
#include "vtkMEAMConversion.h"

#include "vtkInformation.h"
#include "vtkObjectFactory.h"
#include "vtkPolyData.h"

vtkStandardNewMacro(vtkMEAMMeshPreparation);

vtkMEAMMeshPreparation::vtkMEAMMeshPreparation()
{
  const meam::MeshPreparationSettings settings;
  this->Scale = settings.scale;
  std::copy_n(settings.offset.data(), 3, this->Offset);
}

int vtkMEAMMeshPreparation::RequestData(
  vtkInformation*, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  using namespace vtkMEAMConversion;
  vtkPolyData* input = vtkPolyData::GetData(inputVector[0]);
  vtkPolyData* output = vtkPolyData::GetData(outputVector);
  const auto work = [&]
  {
    meam::MeshPreparationSettings settings;
    settings.scale = this->Scale;
    settings.offset = Eigen::Vector3d(this->Offset);
    const meam::PreparedMesh prepared = meam::prepareMesh(toMesh(input), settings, progressOf(this));
    fromMesh(prepared.mesh, output);
    const meam::MeshReport& report = prepared.report;
    setFieldValue(output, "InputVertices", report.inputVertices);
    setFieldValue(output, "InputTriangles", report.inputTriangles);
    setFieldValue(output, "Vertices", report.vertices);
    setFieldValue(output, "Triangles", report.triangles);
    setFieldValue(output, "MergedVertices", report.mergedVertices);
    setFieldValue(output, "IsolatedVertices", report.isolatedVertices);
    setFieldValue(output, "DegenerateTriangles", report.degenerateTriangles);
    setFieldValue(output, "DuplicateTriangles", report.duplicateTriangles);
    setFieldValue(output, "FlippedComponents", report.flippedComponents);
    setFieldValue(output, "Components", report.components);
    setFieldValue(output, "BorderEdges", report.borderEdges);
    setFieldValue(output, "Closed", report.closed ? 1.0 : 0.0);
    setFieldValue(output, "Area", report.area);
    setFieldValue(output, "Volume", report.volume);
    setDiameter(output, report.diameter);
  };
  return vtkMEAMRun(this, work, output);
}

void vtkMEAMMeshPreparation::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Scale: " << this->Scale << "\n";
  os << indent << "Offset: " << this->Offset[0] << " " << this->Offset[1] << " " << this->Offset[2] << "\n";
}
