// SPDX-License-Identifier: BSD-3-Clause
#include "scene/Units.h"

#include "base/Bounds.h"
#include "base/Error.h"

#include <cstdio>

namespace meam
{
namespace
{
std::string number(double value)
{
  char text[32];
  std::snprintf(text, sizeof(text), "%.4g", value);
  return text;
}
}

std::string unitsWarning(const Points& scene, double partDiameter, const UnitCheckSettings& settings)
{
  const double parts = bounds(scene).diagonal().norm() / partDiameter;
  if (parts >= settings.leastUsual && parts <= settings.mostUsual)
  {
    return {};
  }
  const bool isTen = parts < 1.0 ? 10.0 * parts >= settings.leastLikely : parts / 10.0 <= settings.mostLikely;
  const int factor = isTen ? 10 : 1000;
  return "The scene spans " + number(parts * partDiameter) + " and the part's diameter is " + number(partDiameter) +
         ": if their units differ, the likely factor is " + std::to_string(factor) + ". Scale the " +
         (parts < 1.0 ? "scene" : "part") + " by it.";
}

void requireSameUnits(const Points& scene, double partDiameter, const UnitCheckSettings& settings)
{
  double extent = bounds(scene).diagonal().norm();
  if (extent > settings.mostPossible * partDiameter)
  {
    extent = innerBounds(scene, settings.strayShare).diagonal().norm(); // stray points are no other unit
  }
  if (extent < settings.leastPossible * partDiameter)
  {
    throw Error(
      "The scene spans " + number(extent) + " but the part's diameter is " + number(partDiameter) +
      ": their units differ (a scene in metres and a part in millimetres differ by 1000). Scale the scene to the "
      "part's unit.");
  }
  if (extent > settings.mostPossible * partDiameter)
  {
    throw Error(
      "The scene spans " + number(extent) + " but the part's diameter is only " + number(partDiameter) +
      ": their units differ (a part in metres and a scene in millimetres differ by 1000). Scale the part to the "
      "scene's unit.");
  }
}
}
