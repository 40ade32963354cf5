// SPDX-License-Identifier: BSD-3-Clause
#include "vtkMEAMPCDReader.h"

#include "io/cloud/PCDFile.h"

#include "vtkObjectFactory.h"

vtkStandardNewMacro(vtkMEAMPCDReader);

namespace
{
/// Width and height, or zeros for a file that cannot be read: reading it says what is wrong with it.
std::array<int, 2> sizeOf(const char* fileName)
{
  try
  {
    return meam::readPCDSize(fileName ? fileName : "");
  }
  catch (const std::exception&)
  {
    return { 0, 0 };
  }
}
}

int vtkMEAMPCDReader::CanReadFile(const char* fileName) { return StartOf(fileName, { ".pcd" }) ? 1 : 0; }

std::array<int, 2> vtkMEAMPCDReader::GridSize() { return sizeOf(this->FileName); }

meam::MeasuredCloud vtkMEAMPCDReader::Read(const std::function<bool(double)>& progress)
{
  return meam::readPCD(this->FileName, progress);
}
