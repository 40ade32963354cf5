// SPDX-License-Identifier: BSD-3-Clause
#include "TypeNames.h"

#include "ShownData.h"

#include "vtkDataObject.h"
#include "vtkFileSeriesReader.h"
#include "vtkMEAMPartNames.h"
#include "vtkNew.h"
#include "vtkPVArrayInformation.h"
#include "vtkPVDataInformation.h"
#include "vtkSMPVRepresentationProxy.h"
#include "vtkSMPropertyHelper.h"
#include "vtkSMProxyIterator.h"
#include "vtkSMSessionProxyManager.h"
#include "vtkSMSourceProxy.h"
#include "vtkSMTransferFunctionManager.h"
#include "vtkSMViewProxy.h"

#include <cstring>
#include <string>
#include <vector>

namespace
{
constexpr const char* Named = "PPFMEAM.TypeNames"; // annotation of a color map: the legend as it was given

using Texts = std::vector<std::string>; // of a legend, a value and its name in turn

/// ParaView wraps VTK's readers.
std::string fileOf(vtkAlgorithm* algorithm)
{
  auto* reader = vtkFileSeriesReader::SafeDownCast(algorithm);
  const char* file = reader ? reader->GetCurrentFileName() : nullptr;
  return file ? file : "";
}

/// The color map of types of part that a representation has; null: it has none.
vtkSMProxy* typeColors(vtkSMProxy* representation)
{
  vtkSMProxy* colors = vtkSMPropertyHelper(representation, "LookupTable", true).GetAsProxy();
  return mappedArray(colors) == "PartId" ? colors : nullptr;
}

vtkSMSourceProxy* estimationOf(vtkSMProxy* representation)
{
  const ShownData shown(representation);
  const auto isEstimation = [](vtkSMSourceProxy* source, unsigned int)
  { return source->GetVTKClassName() && std::strcmp(source->GetVTKClassName(), "vtkMEAMPoseEstimation") == 0; };
  return shown.source ? firstUpstream(shown.source, shown.port, isEstimation) : nullptr;
}

std::string nameOf(int type) { return "part " + std::to_string(type + 1); }

Texts legendOf(vtkSMSourceProxy* estimation)
{
  Texts legend;
  vtkPVArrayInformation* names = estimation->GetDataInformation(0)->GetArrayInformation("PartName", vtkDataObject::FIELD);
  for (int type = 0; names && type < names->GetNumberOfTuples(); ++type)
  {
    const bool isKnown = type < names->GetNumberOfStringValues(); // of many only the first ones are
    legend.insert(legend.end(), { std::to_string(type), isKnown ? names->GetStringValue(type) : nameOf(type) });
  }
  return legend;
}

Texts legendIn(vtkSMProxy* colors)
{
  Texts legend;
  const vtkSMPropertyHelper listed(colors, "Annotations");
  for (unsigned int k = 0; k < listed.GetNumberOfElements(); ++k)
  {
    legend.emplace_back(listed.GetAsString(k));
  }
  return legend;
}

std::string joined(const Texts& legend)
{
  std::string text;
  for (const std::string& one : legend)
  {
    text += one + "\n";
  }
  return text;
}

/// Whether the user has changed the legend.
bool isUsers(vtkSMProxy* colors)
{
  const Texts legend = legendIn(colors);
  if (colors->HasAnnotation(Named))
  {
    return joined(legend) != colors->GetAnnotation(Named);
  }
  for (std::size_t k = 0; k < legend.size(); ++k) // as RankColors has it
  {
    const int type = static_cast<int>(k / 2);
    if (legend[k] != (k % 2 == 0 ? std::to_string(type) : nameOf(type)))
    {
      return true;
    }
  }
  return false;
}

/// Whether representations of another estimation have the color map, for other types.
bool isOfOthers(vtkSMProxy* colors, vtkSMSourceProxy* estimation)
{
  const Texts legend = legendOf(estimation);
  vtkNew<vtkSMProxyIterator> all;
  all->SetSession(colors->GetSession());
  for (all->Begin("representations"); !all->IsAtEnd(); all->Next())
  {
    vtkSMSourceProxy* other = typeColors(all->GetProxy()) == colors ? estimationOf(all->GetProxy()) : nullptr;
    if (other && other != estimation && !legendOf(other).empty() && legendOf(other) != legend)
    {
      return true;
    }
  }
  return false;
}

/// Gives the representation a color map of its own, and that the legend's place.
vtkSMProxy* separateColors(vtkSMProxy* representation, vtkSMProxy* shared)
{
  auto* shown = vtkSMPVRepresentationProxy::SafeDownCast(representation);
  if (!shown || !shown->GetProperty("UseSeparateColorMap"))
  {
    return nullptr;
  }
  vtkSMViewProxy* view = vtkSMViewProxy::FindView(shown);
  const bool hasLegend = view && shown->IsScalarBarVisible(view);
  vtkSMPropertyHelper(shown, "UseSeparateColorMap").Set(1);
  shown->SetScalarColoring("PartId", vtkSMPropertyHelper(shown, "ColorArrayName").GetInputArrayAssociation());
  if (hasLegend)
  {
    vtkNew<vtkSMTransferFunctionManager> manager;
    manager->HideScalarBarIfNotNeeded(shared, view);
    shown->SetScalarBarVisibility(view, true);
  }
  return typeColors(shown);
}
}

void addMEAMTypeNames() { vtkMEAMConversion::setFileOf(fileOf); }

void nameTypes(vtkSMProxy* representation)
{
  vtkSMProxy* colors = typeColors(representation);
  vtkSMSourceProxy* estimation = colors ? estimationOf(representation) : nullptr;
  const Texts legend = estimation ? legendOf(estimation) : Texts();
  if (legend.empty() || legend == legendIn(colors))
  {
    return;
  }
  if (isOfOthers(colors, estimation))
  {
    colors = separateColors(representation, colors);
  }
  if (!colors || isUsers(colors))
  {
    return;
  }
  if (legendIn(colors).empty()) // one of its own begins without ours
  {
    vtkNew<vtkSMTransferFunctionManager> manager;
    colors->Copy(manager->GetColorTransferFunction("PartId", colors->GetSessionProxyManager()), "vtkSMProxyProperty");
  }
  vtkSMPropertyHelper listed(colors, "Annotations");
  listed.SetNumberOfElements(static_cast<unsigned int>(legend.size()));
  for (std::size_t k = 0; k < legend.size(); ++k)
  {
    listed.Set(static_cast<unsigned int>(k), legend[k].c_str());
  }
  colors->UpdateVTKObjects();
  colors->SetAnnotation(Named, joined(legend).c_str());
}
