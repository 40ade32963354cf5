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

#include <algorithm>
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

constexpr double MostTypes = 1000; // more are numbers of something else

/// Of the types of the estimation or, when there is none, of those that the data have.
Texts legendOf(vtkSMProxy* representation, vtkSMSourceProxy* estimation)
{
  Texts legend;
  vtkPVArrayInformation* names =
    estimation ? estimation->GetDataInformation(0)->GetArrayInformation("PartName", vtkDataObject::FIELD) : nullptr;
  for (int type = 0; names && type < names->GetNumberOfTuples(); ++type)
  {
    const bool isKnown = type < names->GetNumberOfStringValues(); // of many only the first ones are
    legend.insert(legend.end(), { std::to_string(type), isKnown ? names->GetStringValue(type) : nameOf(type) });
  }
  vtkPVArrayInformation* types =
    estimation ? nullptr : ShownData(representation).data()->GetArrayInformation("PartId", vtkDataObject::POINT);
  const double last = types ? types->GetComponentRange(0)[1] : -1.0;
  for (int type = 0; last < MostTypes && type <= last; ++type)
  {
    legend.insert(legend.end(), { std::to_string(type), nameOf(type) });
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

/// What is colored by types of part, but for one representation.
std::vector<vtkSMProxy*> othersOf(vtkSMProxy* representation)
{
  std::vector<vtkSMProxy*> others;
  vtkNew<vtkSMProxyIterator> all;
  all->SetSession(representation->GetSession());
  for (all->Begin("representations"); !all->IsAtEnd(); all->Next())
  {
    if (all->GetProxy() != representation && typeColors(all->GetProxy()) && ShownData(all->GetProxy()).source)
    {
      others.push_back(all->GetProxy());
    }
  }
  return others;
}

/// Whether representations of another estimation have the color map, for other types.
bool isOfOthers(vtkSMProxy* colors, vtkSMProxy* representation, vtkSMSourceProxy* estimation)
{
  const Texts legend = legendOf(representation, estimation);
  const std::vector<vtkSMProxy*> others = othersOf(representation);
  return std::any_of(others.begin(), others.end(),
    [&](vtkSMProxy* other)
    {
      vtkSMSourceProxy* from = estimationOf(other);
      const Texts theirs = typeColors(other) == colors && from != estimation ? legendOf(other, from) : Texts();
      return !theirs.empty() && theirs != legend;
    });
}

/// Gives the representation the color map of what else shows its estimation or, when nothing does, one of its own, and that
/// the legend's place.
vtkSMProxy* separateColors(vtkSMProxy* representation, vtkSMSourceProxy* estimation, vtkSMProxy* shared)
{
  auto* shown = vtkSMPVRepresentationProxy::SafeDownCast(representation);
  if (!shown || !shown->GetProperty("UseSeparateColorMap"))
  {
    return nullptr;
  }
  vtkSMViewProxy* view = vtkSMViewProxy::FindView(shown);
  const bool hasLegend = view && shown->IsScalarBarVisible(view);
  vtkSMPropertyHelper(shown, "UseSeparateColorMap").Set(1);
  const std::vector<vtkSMProxy*> others = othersOf(shown);
  const auto same = std::find_if(others.begin(), others.end(),
    [&](vtkSMProxy* other) { return typeColors(other) != shared && estimationOf(other) == estimation; });
  if (same != others.end())
  {
    vtkSMPropertyHelper(shown, "LookupTable").Set(typeColors(*same));
    shown->UpdateVTKObjects();
  }
  else
  {
    shown->SetScalarColoring("PartId", vtkSMPropertyHelper(shown, "ColorArrayName").GetInputArrayAssociation());
  }
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
  if (!colors || !ShownData(representation).source)
  {
    return;
  }
  vtkSMSourceProxy* estimation = estimationOf(representation);
  const Texts legend = legendOf(representation, estimation);
  if (legend.empty())
  {
    return;
  }
  if (legend == legendIn(colors)) // also in a state of an earlier version, which has no such annotation
  {
    colors->SetAnnotation(Named, joined(legend).c_str());
    return;
  }
  if (isOfOthers(colors, representation, estimation))
  {
    colors = separateColors(representation, estimation, colors);
  }
  if (!colors || isUsers(colors))
  {
    return;
  }
  const Texts before = legendIn(colors);
  if (!estimation && before.size() > legend.size() && std::equal(legend.begin(), legend.end(), before.begin()))
  {
    return; // other data have more types
  }
  if (before.empty()) // one of its own begins without ours
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
