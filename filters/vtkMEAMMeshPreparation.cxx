// SPDX-License-Identifier: BSD-3-Clause
#include "vtkMEAMMeshPreparation.h"

#include "mesh/preparation/MeshPreparation.h"
#include "vtkMEAMArrays.h"
#include "vtkMEAMMeshConversion.h"
#include "vtkMEAMRun.h"

#include "vtkFieldData.h"
#include "vtkInformation.h"
#include "vtkObjectFactory.h"
#include "vtkPolyData.h"

vtkStandardNewMacro(vtkMEAMMeshPreparation);

vtkMEAMMeshPreparation::vtkMEAMMeshPreparation()
{
  const meam::MeshPreparationSettings settings;
  this->Scale = settings.scale;
  std::copy_n(settings.offset.data(), 3, this->Offset);
  this->KeptComponents = static_cast<int>(settings.keptComponents);
  this->HoleSize = settings.holeSize;
  this->MaximumError = settings.maximumError;
  this->EdgeLength = settings.edgeLength;
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
    settings.keptComponents = static_cast<meam::KeptComponents>(this->KeptComponents);
    settings.holeSize = this->HoleSize;
    settings.maximumError = this->MaximumError;
    settings.edgeLength = this->EdgeLength;
    const meam::PreparedMesh prepared = meam::prepareMesh(toMesh(input), settings, progressOf(this));
    fromMesh(prepared.mesh, output);
    const meam::MeshReport& report = prepared.report;
    setFieldText(output, "Report", meam::describe(report));
    setFieldValue(output, "InputVertices", report.inputVertices);
    setFieldValue(output, "InputTriangles", report.inputTriangles);
    setFieldValue(output, "Vertices", report.vertices);
    setFieldValue(output, "Triangles", report.triangles);
    setFieldValue(output, "MergedVertices", report.mergedVertices);
    setFieldValue(output, "NearVertices", report.nearVertices);
    setFieldValue(output, "IsolatedVertices", report.isolatedVertices);
    setFieldValue(output, "DegenerateTriangles", report.degenerateTriangles);
    setFieldValue(output, "DuplicateTriangles", report.duplicateTriangles);
    setFieldValue(output, "FlippedComponents", report.flippedComponents);
    setFieldValue(output, "DroppedComponents", report.droppedComponents);
    setFieldValue(output, "Components", report.components);
    setFieldValue(output, "ClosedHoles", report.closedHoles);
    setFieldValue(output, "Intersections", report.intersections);
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
  os << indent << "KeptComponents: " << (this->KeptComponents == Largest ? "Largest" : "All") << "\n";
  os << indent << "HoleSize: " << this->HoleSize << "\n";
  os << indent << "MaximumError: " << this->MaximumError << "\n";
  os << indent << "EdgeLength: " << this->EdgeLength << "\n";
}
