// SPDX-License-Identifier: BSD-3-Clause
#include "vtkMEAMXYZReader.h"

#include "io/cloud/XYZFile.h"

#include "vtkObjectFactory.h"

vtkStandardNewMacro(vtkMEAMXYZReader);

int vtkMEAMXYZReader::CanReadFile(const char* fileName)
{
  const std::optional<std::string> start = StartOf(fileName, { ".xyz", ".asc", ".pts" });
  // PLOT3D and other texts of numbers begin with a number, in binary files one of 32 bits.
  const bool isNumber =
    start && (start->find('\0') != std::string::npos || start->find_first_of("+-.0123456789 \t\r\n") == 0);
  return (start && !isNumber) || (fileName && meam::isXYZ(fileName)) ? 1 : 0;
}

meam::MeasuredCloud vtkMEAMXYZReader::Read(const std::function<bool(double)>& progress)
{
  return meam::readXYZ(this->FileName, progress);
}
