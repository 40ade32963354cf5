// SPDX-License-Identifier: BSD-3-Clause
#include "vtkMEAMCameraReader.h"

vtkMEAMCameraReader::vtkMEAMCameraReader() { this->SetNumberOfInputPorts(0); }

vtkMEAMCameraReader::~vtkMEAMCameraReader()
{
  this->SetFileName(nullptr);
  this->SetCameraFile(nullptr);
}

void vtkMEAMCameraReader::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "FileName: " << (this->FileName ? this->FileName : "(none)") << "\n";
  os << indent << "CameraFile: " << (this->CameraFile ? this->CameraFile : "(none)") << "\n";
  os << indent << "FocalLength: " << this->FocalLength[0] << ", " << this->FocalLength[1] << " pixels\n";
  os << indent << "PrincipalPoint: " << this->PrincipalPoint[0] << ", " << this->PrincipalPoint[1] << " pixels\n";
}
