// SPDX-License-Identifier: BSD-3-Clause
#include "vtkMEAMFeatureEdges.h"

#include "mesh/ConvexHull.h"
#include "mesh/FeatureEdges.h"
#include "mesh/TriangleMesh.h"
#include "vtkMEAMArrays.h"
#include "vtkMEAMCloudConversion.h"
#include "vtkMEAMMeshConversion.h"
#include "vtkMEAMRun.h"
#include "vtkMEAMSettings.h"

#include "vtkInformation.h"
#include "vtkObjectFactory.h"
#include "vtkPolyData.h"

vtkStandardNewMacro(vtkMEAMFeatureEdges);

vtkMEAMFeatureEdges::vtkMEAMFeatureEdges()
  : Settings(new meam::FeatureEdgesSettings)
{
}

vtkMEAMFeatureEdges::~vtkMEAMFeatureEdges() = default;

vtkMEAMClampedSettingMacro(vtkMEAMFeatureEdges, Angle, double, angle, 0.1, 179.0)
vtkMEAMClampedSettingMacro(vtkMEAMFeatureEdges, Spacing, double, spacing, 0.0, VTK_DOUBLE_MAX)

int vtkMEAMFeatureEdges::RequestData(
  vtkInformation*, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  using namespace vtkMEAMConversion;
  vtkPolyData* input = vtkPolyData::GetData(inputVector[0]);
  vtkPolyData* output = vtkPolyData::GetData(outputVector);
  const auto work = [&]
  {
    const meam::TriangleMesh mesh = toMesh(input);
    fromCloud(meam::extractFeatureEdges(mesh, *this->Settings, progressOf(this)), output);
    setDiameter(output, meam::diameter(mesh.vertices));
  };
  return vtkMEAMRun(this, work, output);
}

void vtkMEAMFeatureEdges::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Angle: " << this->GetAngle() << "\n";
  os << indent << "Spacing: " << this->GetSpacing() << "\n";
}
