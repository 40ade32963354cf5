// SPDX-License-Identifier: BSD-3-Clause
#include "vtkMEAMSurfaceSampling.h"

#include "mesh/ConvexHull.h"
#include "mesh/SurfaceSampling.h"
#include "mesh/TriangleMesh.h"
#include "vtkMEAMArrays.h"
#include "vtkMEAMCloudConversion.h"
#include "vtkMEAMMeshConversion.h"
#include "vtkMEAMRun.h"

#include "vtkInformation.h"
#include "vtkObjectFactory.h"
#include "vtkPolyData.h"

vtkStandardNewMacro(vtkMEAMSurfaceSampling);

vtkMEAMSurfaceSampling::vtkMEAMSurfaceSampling()
{
  const meam::SurfaceSamplingSettings settings;
  this->Spacing = settings.spacing;
  this->Seed = static_cast<int>(settings.seed);
}

int vtkMEAMSurfaceSampling::RequestData(
  vtkInformation*, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  using namespace vtkMEAMConversion;
  vtkPolyData* input = vtkPolyData::GetData(inputVector[0]);
  vtkPolyData* output = vtkPolyData::GetData(outputVector);
  const auto work = [&]
  {
    meam::SurfaceSamplingSettings settings;
    settings.spacing = this->Spacing;
    settings.seed = static_cast<unsigned>(this->Seed);
    const meam::TriangleMesh mesh = toMesh(input);
    fromCloud(meam::sampleSurface(mesh, settings, progressOf(this)), output);
    setDiameter(output, meam::diameter(mesh.vertices));
  };
  return vtkMEAMRun(this, work, output);
}

void vtkMEAMSurfaceSampling::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Spacing: " << this->Spacing << "\n";
  os << indent << "Seed: " << this->Seed << "\n";
}
