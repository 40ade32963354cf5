// SPDX-License-Identifier: BSD-3-Clause
#include "vtkMEAMOFFReader.h"

#include "io/OFFFile.h"
#include "mesh/TriangleMesh.h"
#include "vtkMEAMMeshConversion.h"
#include "vtkMEAMRun.h"

#include "vtkInformation.h"
#include "vtkObjectFactory.h"
#include "vtkPolyData.h"

vtkStandardNewMacro(vtkMEAMOFFReader);

vtkMEAMOFFReader::vtkMEAMOFFReader() { this->SetNumberOfInputPorts(0); }

vtkMEAMOFFReader::~vtkMEAMOFFReader() { this->SetFileName(nullptr); }

int vtkMEAMOFFReader::CanReadFile(const char* fileName) { return fileName && meam::isOFF(fileName) ? 1 : 0; }

int vtkMEAMOFFReader::RequestData(vtkInformation*, vtkInformationVector**, vtkInformationVector* outputVector)
{
  vtkPolyData* output = vtkPolyData::GetData(outputVector);
  const auto work = [&]
  {
    if (!this->FileName || !*this->FileName)
    {
      throw meam::Error("No file is given: set FileName to the name of an OFF file.");
    }
    const meam::TriangleMesh mesh = meam::readOFF(this->FileName, vtkMEAMConversion::progressOf(this));
    if (mesh.triangles.empty())
    {
      throw meam::Error(std::string("The OFF file '") + this->FileName + "' has no faces: it holds no surface.");
    }
    vtkMEAMConversion::fromMesh(mesh, output);
  };
  return vtkMEAMRun(this, work, output);
}

void vtkMEAMOFFReader::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "FileName: " << (this->FileName ? this->FileName : "(none)") << "\n";
}
