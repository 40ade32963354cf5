// SPDX-License-Identifier: BSD-3-Clause
#include "vtkMEAMMeshPreparation.h"

#include "mesh/preparation/MeshPreparation.h"
#include "vtkMEAMArrays.h"
#include "vtkMEAMMeshConversion.h"
#include "vtkMEAMRun.h"
#include "vtkMEAMSettings.h"

#include "vtkFieldData.h"
#include "vtkInformation.h"
#include "vtkObjectFactory.h"
#include "vtkPolyData.h"

vtkStandardNewMacro(vtkMEAMMeshPreparation);

vtkMEAMMeshPreparation::vtkMEAMMeshPreparation()
  : Settings(new meam::MeshPreparationSettings)
{
}

vtkMEAMMeshPreparation::~vtkMEAMMeshPreparation() = default;

vtkMEAMSettingMacro(vtkMEAMMeshPreparation, Scale, double, scale)
vtkMEAMClampedSettingMacro(vtkMEAMMeshPreparation, KeptComponents, int, keptComponents, All, Largest)
vtkMEAMClampedSettingMacro(vtkMEAMMeshPreparation, HoleSize, double, holeSize, 0.0, VTK_DOUBLE_MAX)
vtkMEAMClampedSettingMacro(vtkMEAMMeshPreparation, MaximumError, double, maximumError, 0.0, VTK_DOUBLE_MAX)
vtkMEAMClampedSettingMacro(vtkMEAMMeshPreparation, EdgeLength, double, edgeLength, 0.0, VTK_DOUBLE_MAX)

int vtkMEAMMeshPreparation::RequestData(
  vtkInformation*, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  using namespace vtkMEAMConversion;
  vtkPolyData* input = vtkPolyData::GetData(inputVector[0]);
  vtkPolyData* output = vtkPolyData::GetData(outputVector);
  const auto work = [&]
  {
    meam::MeshPreparationSettings settings = *this->Settings;
    settings.offset = Eigen::Vector3d(this->Offset);
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
  os << indent << "Scale: " << this->GetScale() << "\n";
  os << indent << "Offset: " << this->Offset[0] << " " << this->Offset[1] << " " << this->Offset[2] << "\n";
  os << indent << "KeptComponents: " << (this->GetKeptComponents() == Largest ? "Largest" : "All") << "\n";
  os << indent << "HoleSize: " << this->GetHoleSize() << "\n";
  os << indent << "MaximumError: " << this->GetMaximumError() << "\n";
  os << indent << "EdgeLength: " << this->GetEdgeLength() << "\n";
}
