// SPDX-License-Identifier: BSD-3-Clause
#include "TypeNames.h"

#include "vtkDataObject.h"
#include "vtkFileSeriesReader.h"
#include "vtkMEAMPartNames.h"
#include "vtkNew.h"
#include "vtkPVArrayInformation.h"
#include "vtkPVDataInformation.h"
#include "vtkSMPropertyHelper.h"
#include "vtkSMSourceProxy.h"
#include "vtkSMTransferFunctionManager.h"

#include <algorithm>
#include <string>

namespace
{
/// As many as have a color of their own: RankColors.
constexpr int MostTypes = 5;

/// ParaView wraps VTK's readers.
std::string fileOf(vtkAlgorithm* algorithm)
{
  auto* reader = vtkFileSeriesReader::SafeDownCast(algorithm);
  const char* file = reader ? reader->GetCurrentFileName() : nullptr;
  return file ? file : "";
}
}

void addMEAMTypeNames() { vtkMEAMConversion::setFileOf(fileOf); }

void nameTypes(vtkSMSourceProxy* poses)
{
  vtkPVArrayInformation* names = poses->GetDataInformation(0)->GetArrayInformation("PartName", vtkDataObject::FIELD);
  if (!names)
  {
    return;
  }
  vtkNew<vtkSMTransferFunctionManager> colors;
  vtkSMProxy* map = colors->GetColorTransferFunction("PartId", poses->GetSessionProxyManager());
  vtkSMPropertyHelper listed(map, "Annotations");
  const int count = std::min(static_cast<int>(names->GetNumberOfTuples()), MostTypes);
  listed.SetNumberOfElements(2 * count);
  for (int type = 0; type < count; ++type)
  {
    const bool isKnown = type < names->GetNumberOfStringValues(); // of many only the first ones are
    listed.Set(2 * type, std::to_string(type).c_str());
    listed.Set(2 * type + 1, isKnown ? names->GetStringValue(type) : ("part " + std::to_string(type + 1)).c_str());
  }
  map->UpdateVTKObjects();
}
