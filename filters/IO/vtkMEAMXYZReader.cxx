// SPDX-License-Identifier: BSD-3-Clause
#include "vtkMEAMXYZReader.h"

#include "io/cloud/XYZFile.h"

#include "vtkObjectFactory.h"

vtkStandardNewMacro(vtkMEAMXYZReader);

int vtkMEAMXYZReader::CanReadFile(const char* fileName) { return fileName && meam::isXYZ(fileName) ? 1 : 0; }

meam::MeasuredCloud vtkMEAMXYZReader::Read(const std::function<bool(double)>& progress)
{
  return meam::readXYZ(this->FileName, progress);
}
