// SPDX-License-Identifier: BSD-3-Clause
#include "vtkMEAMPartNames.h"

#include "vtkAbstractPolyDataReader.h"
#include "vtkDataObject.h"
#include "vtkFieldData.h"
#include "vtkStringArray.h"

#include <filesystem>

namespace vtkMEAMConversion
{
namespace
{
FileOf FileOfOthers = nullptr;

std::string fileOf(vtkAlgorithm* algorithm)
{
  if (auto* reader = vtkAbstractPolyDataReader::SafeDownCast(algorithm))
  {
    return reader->GetFileName() ? reader->GetFileName() : "";
  }
  return FileOfOthers ? FileOfOthers(algorithm) : "";
}

/// What feeds an algorithm first; null: nothing does.
vtkAlgorithm* before(vtkAlgorithm* algorithm)
{
  const bool isFed = algorithm->GetNumberOfInputPorts() > 0 && algorithm->GetNumberOfInputConnections(0) > 0;
  return isFed ? algorithm->GetInputAlgorithm(0, 0) : nullptr;
}
}

void setFileOf(FileOf fileOf) { FileOfOthers = fileOf; }

std::string partNameOf(vtkAlgorithm* filter, int connection)
{
  vtkFieldData* fields = filter->GetInputDataObject(0, connection)->GetFieldData();
  auto* name = vtkStringArray::SafeDownCast(fields->GetAbstractArray("Name"));
  if (name && name->GetNumberOfValues() > 0)
  {
    return name->GetValue(0);
  }
  for (vtkAlgorithm* from = filter->GetInputAlgorithm(0, connection); from; from = before(from))
  {
    const std::string file = fileOf(from);
    if (!file.empty())
    {
      return std::filesystem::path(file).stem().string();
    }
  }
  return "part " + std::to_string(connection + 1);
}
}
