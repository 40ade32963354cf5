// SPDX-License-Identifier: BSD-3-Clause
#include "Legends.h"

#include "ShownData.h"

#include "vtkCommand.h"
#include "vtkSMPropertyHelper.h"
#include "vtkSMProxy.h"
#include "vtkSMRenderViewProxy.h"

#include <algorithm>
#include <cstring>
#include <iterator>
#include <string>

namespace
{
/// A fifth of the view's height, and letters of a map.
void showSmall(vtkSMProxy* legend)
{
  vtkSMPropertyHelper(legend, "ScalarBarLength").Set(0.22);
  vtkSMPropertyHelper(legend, "ScalarBarThickness").Set(10);
  vtkSMPropertyHelper(legend, "TitleFontSize").Set(12);
  vtkSMPropertyHelper(legend, "LabelFontSize").Set(12);
  legend->UpdateVTKObjects();
}

/// Whether a color map is used by what is visible in the view. What shows its own colors uses none.
bool isUsed(vtkSMRenderViewProxy* view, vtkSMProxy* colors)
{
  const vtkSMPropertyHelper representations(view, "Representations");
  for (unsigned int k = 0; k < representations.GetNumberOfElements(); ++k)
  {
    vtkSMProxy* shown = representations.GetAsProxy(k);
    if (shown->GetProperty("MapScalars") && vtkSMPropertyHelper(shown, "LookupTable", true).GetAsProxy() == colors &&
        vtkSMPropertyHelper(shown, "Visibility").GetAsInt() != 0 &&
        vtkSMPropertyHelper(shown, "MapScalars").GetAsInt() != 0)
    {
      return true;
    }
  }
  return false;
}
}

void Legends::onAdded(vtkSMRenderViewProxy* view, vtkSMProxy* legend, bool isOfState)
{
  this->Known.emplace_back(view, legend);
  legend->AddObserver(vtkCommand::PropertyModifiedEvent, this, &Legends::onModified);
  if (isOfState)
  {
    return;
  }
  const std::string array = mappedArray(vtkSMPropertyHelper(legend, "LookupTable").GetAsProxy());
  const char* ours[] = { "Rank", "PartId", "Residual", "Possible", "Obstruction", "PoseOutcome" };
  if (std::find(std::begin(ours), std::end(ours), array) != std::end(ours))
  {
    showSmall(legend);
  }
  if (array == "Possible" || array == "Residual") // above stands the answer
  {
    const double leftOfPicks[2] = { 0.42, 0.02 };
    constexpr int AnyLocation = 0, LowerCenter = 3;
    vtkSMPropertyHelper(legend, "WindowLocation").Set(array == "Possible" ? LowerCenter : AnyLocation);
    vtkSMPropertyHelper(legend, "Position").Set(leftOfPicks, 2);
    legend->UpdateVTKObjects();
  }
  this->hideUnused(legend);
}

void Legends::onModified(vtkObject* caller, unsigned long, void* data)
{
  if (data && std::strcmp(static_cast<const char*>(data), "Visibility") == 0)
  {
    this->hideUnused(vtkSMProxy::SafeDownCast(caller));
  }
}

void Legends::hideUnused(vtkSMProxy* legend)
{
  for (const auto& [view, known] : this->Known)
  {
    if (known == legend && view && vtkSMPropertyHelper(legend, "Visibility").GetAsInt() != 0 &&
        !isUsed(view, vtkSMPropertyHelper(legend, "LookupTable").GetAsProxy()))
    {
      vtkSMPropertyHelper(legend, "Visibility").Set(0);
    }
  }
}
