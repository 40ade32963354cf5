// SPDX-License-Identifier: BSD-3-Clause
#include "vtkMEAMMeshReader.h"

#include "io/MeshFile.h"
#include "io/cad/CADSettings.h"
#include "mesh/preparation/StrayComponents.h"
#include "vtkMEAMArrays.h"
#include "vtkMEAMMeshConversion.h"
#include "vtkMEAMPartTrainer.h"
#include "vtkMEAMRun.h"

#include "vtkInformation.h"
#include "vtkObjectFactory.h"
#include "vtkPolyData.h"

vtkStandardNewMacro(vtkMEAMMeshReader);

vtkMEAMMeshReader::vtkMEAMMeshReader() { this->SetNumberOfInputPorts(0); }

vtkMEAMMeshReader::~vtkMEAMMeshReader() { this->SetFileName(nullptr); }

int vtkMEAMMeshReader::RequestData(vtkInformation*, vtkInformationVector**, vtkInformationVector* outputVector)
{
  vtkPolyData* output = vtkPolyData::GetData(outputVector);
  const auto work = [&]
  {
    vtkMEAMConversion::requireFileName(this->FileName, "the name of a .step, .iges, .stl, .obj, .ply or .off file");
    const meam::Progress progress = vtkMEAMConversion::progressOf(this);
    if (meam::isBRepFile(this->FileName) || this->Solid != 0)
    {
      vtkMEAMPartTrainer::Create("To read " + std::string(this->FileName), "give a mesh of it")
        ->ReadCAD(this->FileName, { this->Solid }, output, progress);
    }
    else
    {
      const meam::TriangleMesh mesh = meam::readMesh(this->FileName, progress);
      vtkMEAMConversion::fromMesh(mesh, output);
      if (const std::string report = meam::strayReport(this->FileName, mesh, meam::MeshFileUnit); !report.empty())
      {
        vtkMEAMConversion::setFieldText(output, "CADReport", report);
      }
    }
    vtkMEAMConversion::setNameOf(this->FileName, output);
  };
  return vtkMEAMRun(this, work, output);
}

void vtkMEAMMeshReader::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "FileName: " << (this->FileName ? this->FileName : "(none)") << "\n";
  os << indent << "Solid: " << this->Solid << "\n";
}
