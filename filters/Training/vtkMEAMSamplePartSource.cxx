// SPDX-License-Identifier: BSD-3-Clause
#include "vtkMEAMSamplePartSource.h"

#include "mesh/ConvexHull.h"
#include "mesh/TriangleMesh.h"
#include "simulation/parts/ExampleParts.h"
#include "simulation/parts/SamplePart.h"
#include "vtkMEAMArrays.h"
#include "vtkMEAMMeshConversion.h"
#include "vtkMEAMRun.h"

#include "vtkInformationVector.h"
#include "vtkObjectFactory.h"
#include "vtkPolyData.h"

vtkStandardNewMacro(vtkMEAMSamplePartSource);

vtkMEAMSamplePartSource::vtkMEAMSamplePartSource() { this->SetNumberOfInputPorts(0); }

int vtkMEAMSamplePartSource::RequestData(vtkInformation*, vtkInformationVector**, vtkInformationVector* outputVector)
{
  auto* output = vtkPolyData::GetData(outputVector);
  return vtkMEAMRun(
    this,
    [&]
    {
      const meam::TriangleMesh mesh =
        this->Part == RibbedFlange ? meam::makeSamplePart()
                                   : meam::makeExamplePart(static_cast<meam::ExamplePart>(this->Part - RidgedDisc));
      vtkMEAMConversion::fromMesh(mesh, output);
      vtkMEAMConversion::setDiameter(output, meam::diameter(mesh.vertices));
    },
    output);
}

void vtkMEAMSamplePartSource::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Part: " << this->Part << "\n";
}
