// SPDX-License-Identifier: BSD-3-Clause
#include "vtkMEAMModelWriter.h"

#include "model/file/ModelFile.h"
#include "vtkMEAMModelConversion.h"
#include "vtkMEAMRun.h"

#include "vtkErrorCode.h"
#include "vtkInformation.h"
#include "vtkObjectFactory.h"
#include "vtkPartitionedDataSetCollection.h"

vtkStandardNewMacro(vtkMEAMModelWriter);

vtkMEAMModelWriter::~vtkMEAMModelWriter() { this->SetFileName(nullptr); }

int vtkMEAMModelWriter::FillInputPortInformation(int, vtkInformation* info)
{
  info->Set(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkPartitionedDataSetCollection");
  return 1;
}

vtkTypeBool vtkMEAMModelWriter::ProcessRequest(
  vtkInformation* request, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  vtkMEAMConversion::requestPiece(request, inputVector, this->Piece, this->NumberOfPieces);
  return this->Superclass::ProcessRequest(request, inputVector, outputVector);
}

void vtkMEAMModelWriter::WriteData()
{
  if (this->Piece > 0)
  {
    return;
  }
  const int done = vtkMEAMRun(this,
    [&]
    {
      vtkMEAMConversion::requireFileName(this->FileName, "the name of the file to write");
      meam::writeModel(this->FileName,
        vtkMEAMConversion::toTrainedModel(vtkPartitionedDataSetCollection::SafeDownCast(this->GetInput())));
    });
  if (!done)
  {
    this->SetErrorCode(vtkErrorCode::CannotOpenFileError);
  }
}

void vtkMEAMModelWriter::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "NumberOfPieces: " << this->NumberOfPieces << "\n";
  os << indent << "Piece: " << this->Piece << "\n";
  os << indent << "FileName: " << (this->FileName ? this->FileName : "(none)") << "\n";
}
