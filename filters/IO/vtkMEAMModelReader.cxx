// SPDX-License-Identifier: BSD-3-Clause
#include "vtkMEAMModelReader.h"

#include "model/file/ModelFile.h"
#include "vtkMEAMArrays.h"
#include "vtkMEAMModelConversion.h"
#include "vtkMEAMRun.h"

#include "vtkInformation.h"
#include "vtkObjectFactory.h"
#include "vtkPartitionedDataSetCollection.h"

vtkStandardNewMacro(vtkMEAMModelReader);

vtkMEAMModelReader::vtkMEAMModelReader() { this->SetNumberOfInputPorts(0); }

vtkMEAMModelReader::~vtkMEAMModelReader() { this->SetFileName(nullptr); }

int vtkMEAMModelReader::CanReadFile(const char* fileName) { return fileName && meam::isModel(fileName) ? 1 : 0; }

int vtkMEAMModelReader::RequestData(vtkInformation*, vtkInformationVector**, vtkInformationVector* outputVector)
{
  auto* output = vtkPartitionedDataSetCollection::GetData(outputVector);
  const auto work = [&]
  {
    vtkMEAMConversion::requireFileName(this->FileName, "the name of a trained model's file");
    vtkMEAMConversion::fromTrainedModel(meam::readModel(this->FileName), output);
    vtkMEAMConversion::setNameOf(this->FileName, output);
  };
  return vtkMEAMRun(this, work, output);
}

void vtkMEAMModelReader::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "FileName: " << (this->FileName ? this->FileName : "(none)") << "\n";
}
