// SPDX-License-Identifier: BSD-3-Clause
#include "vtkMEAMGraspWriter.h"

#include "pick/io/GraspFile.h"
#include "vtkMEAMGraspConversion.h"
#include "vtkMEAMRun.h"

#include "vtkErrorCode.h"
#include "vtkInformation.h"
#include "vtkObjectFactory.h"
#include "vtkPolyData.h"

vtkStandardNewMacro(vtkMEAMGraspWriter);

vtkMEAMGraspWriter::~vtkMEAMGraspWriter() { this->SetFileName(nullptr); }

int vtkMEAMGraspWriter::FillInputPortInformation(int, vtkInformation* info)
{
  info->Set(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkPolyData");
  return 1;
}

vtkTypeBool vtkMEAMGraspWriter::ProcessRequest(
  vtkInformation* request, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  vtkMEAMConversion::requestPiece(request, inputVector, this->Piece, this->NumberOfPieces);
  return this->Superclass::ProcessRequest(request, inputVector, outputVector);
}

void vtkMEAMGraspWriter::WriteData()
{
  if (this->Piece > 0)
  {
    return;
  }
  const int done = vtkMEAMRun(this,
    [this]
    {
      vtkMEAMConversion::requireFileName(this->FileName, "the name of the file to write");
      meam::writeGrasps(this->FileName, vtkMEAMConversion::toGrasps(vtkPolyData::SafeDownCast(this->GetInput())));
    });
  this->SetErrorCode(done ? vtkErrorCode::NoError : vtkErrorCode::CannotOpenFileError);
}

void vtkMEAMGraspWriter::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "NumberOfPieces: " << this->NumberOfPieces << "\n";
  os << indent << "Piece: " << this->Piece << "\n";
  os << indent << "FileName: " << (this->FileName ? this->FileName : "(none)") << "\n";
}
