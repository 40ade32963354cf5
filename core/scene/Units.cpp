// SPDX-License-Identifier: BSD-3-Clause
#include "scene/Units.h"

#include "base/Bounds.h"
#include "base/Error.h"

#include <cstdio>

namespace meam
{
namespace
{
// A scene's extent, the diagonal of its bounds, in diameters of the part.
constexpr double LeastUsual = 0.7;      // less is possible, but unlikely: a scene spans a part or more,
constexpr double MostUsual = 200.0;     // and mostly some tens of them
constexpr double LeastLikely = 1.5;     // the likely factor is 10 when it takes the extent to one from here
constexpr double MostLikely = 100.0;    // to here, else 1000
constexpr double LeastPossible = 0.2;   // less is an error,
constexpr double MostPossible = 1000.0; // and so is more
// When nothing sure was found. A part in a tenth of the scan's unit spans few of its points, one in ten times as many.
constexpr double ManyParts = 20.0;   // diameters that the scene spans,
constexpr double FewPoints = 30.0;   // and points that the part does: fewer hardly tell it
constexpr double FewParts = 4.0;     // and the other way round
constexpr double ManyPoints = 500.0; // of a part that fills the picture, of a camera of a megapixel
constexpr double OtherThings = 0.02; // of the points, at each end of each axis: they are left out when there is more

std::string number(double value)
{
  char text[32];
  std::snprintf(text, sizeof(text), "%.4g", value);
  return text;
}
}

std::string unitsWarning(const Points& scene, double partDiameter, double pointDistance)
{
  const double parts = bounds(scene).diagonal().norm() / partDiameter;
  if (parts >= LeastUsual && parts <= MostUsual)
  {
    const double points = pointDistance > 0.0 ? partDiameter / pointDistance : 0.0;
    const bool isLarge = parts > ManyParts && points < FewPoints, isSmall = parts < FewParts && points > ManyPoints;
    return pointDistance > 0.0 && (isLarge || isSmall)
             ? "The scan spans " + number(parts) + " diameters of the part, and the part " + number(points) +
                 " of its points: if their units differ, the likely factor is 10. Scale the " +
                 (isSmall ? "scene by 10, or the part by 0.1." : "scene by 0.1, or the part by 10.")
             : std::string();
  }
  const bool isTen = parts < 1.0 ? 10.0 * parts >= LeastLikely : parts / 10.0 <= MostLikely;
  const int factor = isTen ? 10 : 1000;
  return "The scene spans " + number(parts * partDiameter) + " and the part's diameter is " + number(partDiameter) +
         ": if their units differ, the likely factor is " + std::to_string(factor) + ". Scale the " +
         (parts < 1.0 ? "scene" : "part") + " by it.";
}

bool spansTooLittle(const Points& points, double partDiameter)
{
  return points.empty() || bounds(points).diagonal().norm() < LeastPossible * partDiameter;
}

void requireSameUnits(const Points& scene, double partDiameter)
{
  double extent = bounds(scene).diagonal().norm();
  if (extent > MostPossible * partDiameter)
  {
    extent = innerBounds(scene, OtherThings).diagonal().norm(); // stray points are no other unit
  }
  if (extent < LeastPossible * partDiameter)
  {
    throw Error(
      "The scene spans " + number(extent) + " but the part's diameter is " + number(partDiameter) +
      ": their units differ (a scene in metres and a part in millimetres differ by 1000). Scale the scene to the "
      "part's unit.");
  }
  if (extent > MostPossible * partDiameter)
  {
    throw Error(
      "The scene spans " + number(extent) + " but the part's diameter is only " + number(partDiameter) +
      ": their units differ (a part in metres and a scene in millimetres differ by 1000). Scale the part to the "
      "scene's unit.");
  }
}
}
