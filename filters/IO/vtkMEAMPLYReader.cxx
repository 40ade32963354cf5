// SPDX-License-Identifier: BSD-3-Clause
#include "vtkMEAMPLYReader.h"

#include "io/PLYFile.h"

#include "vtkObjectFactory.h"

vtkStandardNewMacro(vtkMEAMPLYReader);

int vtkMEAMPLYReader::CanReadFile(const char* fileName)
{
  const std::optional<std::string> start = StartOf(fileName, { ".ply" });
  return (start && start->rfind("ply", 0) != 0) || (fileName && meam::isPLYCloud(fileName)) ? 1 : 0;
}

meam::MeasuredCloud vtkMEAMPLYReader::Read(const std::function<bool(double)>& progress)
{
  return meam::readPLYCloud(this->FileName, progress);
}
