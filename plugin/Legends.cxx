// SPDX-License-Identifier: BSD-3-Clause
#include "Legends.h"

#include "ShownData.h"

#include "vtkCommand.h"
#include "vtkSMPropertyHelper.h"
#include "vtkSMProxy.h"
#include "vtkSMRenderViewProxy.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <iterator>
#include <string>

namespace
{
constexpr double Length = 0.22; // a share of the view's height

/// With letters of a map.
void showSmall(vtkSMProxy* legend)
{
  vtkSMPropertyHelper(legend, "ScalarBarLength").Set(Length);
  vtkSMPropertyHelper(legend, "ScalarBarThickness").Set(10);
  vtkSMPropertyHelper(legend, "TitleFontSize").Set(12);
  vtkSMPropertyHelper(legend, "LabelFontSize").Set(12);
  legend->UpdateVTKObjects();
}

std::string arrayOf(vtkSMProxy* legend) { return mappedArray(vtkSMPropertyHelper(legend, "LookupTable").GetAsProxy()); }

bool isOurs(const std::string& array)
{
  const char* ours[] = { "Rank", "PartId", "Residual", "Possible", "Obstruction", "PoseOutcome" };
  return std::find(std::begin(ours), std::end(ours), array) != std::end(ours);
}

enum Location // as VTK has them
{
  AnyLocation,
  LowerLeft,
  LowerRight,
  LowerCenter,
  UpperLeft,
  UpperRight
};

constexpr double Places[] = { 0.02, 0.26, 0.5, 0.74 }; // of legends at the right, upwards, as shares of the view's height

int locationOf(vtkSMProxy* legend) { return vtkSMPropertyHelper(legend, "WindowLocation").GetAsInt(); }

/// Where a legend stands at the right; negative: elsewhere.
double placeOf(vtkSMProxy* legend)
{
  const int location = locationOf(legend);
  if (location == AnyLocation && vtkSMPropertyHelper(legend, "Position").GetAsDouble(0) > 0.5)
  {
    return vtkSMPropertyHelper(legend, "Position").GetAsDouble(1);
  }
  return location == LowerRight ? Places[0] : location == UpperRight ? Places[3] : -1.0;
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
  const std::string array = arrayOf(legend);
  if (isOurs(array))
  {
    showSmall(legend);
  }
  if (array == "Possible" || array == "Residual") // above stands the answer
  {
    const double leftOfPicks[2] = { 0.42, 0.02 };
    vtkSMPropertyHelper(legend, "WindowLocation").Set(array == "Possible" ? LowerCenter : AnyLocation);
    vtkSMPropertyHelper(legend, "Position").Set(leftOfPicks, 2);
    legend->UpdateVTKObjects();
  }
  this->hideUnused(legend);
  this->place(legend);
}

void Legends::onModified(vtkObject* caller, unsigned long, void* data)
{
  if (data && std::strcmp(static_cast<const char*>(data), "Visibility") == 0)
  {
    auto* legend = vtkSMProxy::SafeDownCast(caller);
    this->hideUnused(legend);
    this->place(legend);
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

void Legends::place(vtkSMProxy* legend)
{
  const auto isVisible = [](vtkSMProxy* one) { return one && vtkSMPropertyHelper(one, "Visibility").GetAsInt() != 0; };
  const auto own = std::find_if(
    this->Known.begin(), this->Known.end(), [&](const auto& known) { return known.second == legend; });
  if (own == this->Known.end() || !isVisible(legend) || !isOurs(arrayOf(legend)))
  {
    return;
  }
  const auto isFree = [&](double place)
  {
    return std::none_of(this->Known.begin(), this->Known.end(),
      [&](const auto& known)
      {
        return known.first == own->first && known.second != legend && isVisible(known.second) &&
               std::abs(placeOf(known.second) - place) < Length;
      });
  };
  const auto* const place = std::find_if(std::begin(Places), std::end(Places), isFree);
  const int location = locationOf(legend);
  const double now = placeOf(legend); // negative: elsewhere, where it stays
  const bool isInOtherCorner = location == LowerLeft || location == UpperLeft || location == UpperRight; // by ParaView
  if (place != std::end(Places) && (isInOtherCorner || (now >= 0.0 && !isFree(now))))
  {
    const double position[2] = { 0.92, *place };
    vtkSMPropertyHelper(legend, "WindowLocation").Set(AnyLocation);
    vtkSMPropertyHelper(legend, "Position").Set(position, 2);
    legend->UpdateVTKObjects();
  }
}
