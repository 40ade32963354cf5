// SPDX-License-Identifier: BSD-3-Clause
#include "vtkMEAMFeatureEdges.h"

#include "mesh/ConvexHull.h"
#include "mesh/FeatureEdges.h"
#include "mesh/TriangleMesh.h"
#include "vtkMEAMArrays.h"
#include "vtkMEAMCloudConversion.h"
#include "vtkMEAMMeshConversion.h"
#include "vtkMEAMRun.h"

#include "vtkInformation.h"
#include "vtkObjectFactory.h"
#include "vtkPolyData.h"

vtkStandardNewMacro(vtkMEAMFeatureEdges);

vtkMEAMFeatureEdges::vtkMEAMFeatureEdges()
{
  const meam::FeatureEdgesSettings settings;
  this->Angle = settings.angle;
  this->Spacing = settings.spacing;
}

int vtkMEAMFeatureEdges::RequestData(
  vtkInformation*, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  using namespace vtkMEAMConversion;
  vtkPolyData* input = vtkPolyData::GetData(inputVector[0]);
  vtkPolyData* output = vtkPolyData::GetData(outputVector);
  const auto work = [&]
  {
    meam::FeatureEdgesSettings settings;
    settings.angle = this->Angle;
    settings.spacing = this->Spacing;
    const meam::TriangleMesh mesh = toMesh(input);
    fromCloud(meam::extractFeatureEdges(mesh, settings, progressOf(this)), output);
    setDiameter(output, meam::diameter(mesh.vertices));
  };
  return vtkMEAMRun(this, work, output);
}

void vtkMEAMFeatureEdges::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Angle: " << this->Angle << "\n";
  os << indent << "Spacing: " << this->Spacing << "\n";
}
