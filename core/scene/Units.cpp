// SPDX-License-Identifier: BSD-3-Clause
#include "scene/Units.h"

#include "base/Bounds.h"
#include "base/Error.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>
#include <utility>
#include <vector>

namespace meam
{
namespace
{
// A scene's extent, the diagonal of its bounds, in diameters of the part.
constexpr double LeastUsual = 0.7;      // less is possible, but unlikely: a scene spans a part or more,
constexpr double MostUsual = 200.0;     // and mostly some tens of them
constexpr double LeastLikely = 1.5;     // a factor is likely when it takes the extent to one from here
constexpr double MostLikely = 100.0;    // to here,
constexpr double UsualExtent = 3.5;     // and the more so the nearer to this: 11 of 21 real scans span 3 to 4
constexpr double LeastPossible = 0.2;   // less is an error,
constexpr double MostPossible = 1000.0; // and so is more
// When nothing sure was found. A part in a tenth of the scan's unit spans few of its points, one in ten times as many.
constexpr double ManyParts = 20.0;   // diameters that the scene spans,
constexpr double FewPoints = 30.0;   // and points that the part does: fewer hardly tell it
constexpr double FewParts = 4.0;     // and the other way round
constexpr double ManyPoints = 500.0; // of a part that fills the picture, of a camera of a megapixel
constexpr double OtherThings = 0.02; // of the points, at each end of each axis: they are left out when there is more

struct NamedUnit
{
  double length; // mm
  const char* name;
};
constexpr NamedUnit UnitsInUse[] = { { Metre, "metres" }, { 25.4, "inches" }, { 10.0, "centimetres" } }; // beside mm

std::string number(double value)
{
  char text[32];
  std::snprintf(text, sizeof(text), "%.4g", value);
  return text;
}

/// The factors that may lie between the units of a scene that spans so many diameters of the part and of the part, by
/// name, the likeliest first.
std::string likelyFactors(double parts, bool isSmall)
{
  std::vector<std::pair<double, NamedUnit>> likely;
  for (const NamedUnit& unit : UnitsInUse)
  {
    const double scaled = isSmall ? parts * unit.length : parts / unit.length;
    if (scaled >= LeastLikely && scaled <= MostLikely)
    {
      likely.emplace_back(std::abs(std::log(scaled / UsualExtent)), unit);
    }
  }
  std::sort(likely.begin(), likely.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
  if (likely.empty())
  {
    likely.emplace_back(0.0, UnitsInUse[0]);
  }
  std::string text = "the likely factor is ";
  for (const auto& [distance, unit] : likely)
  {
    text += (text.back() == ')' ? ", or " : "") + number(unit.length) + " (" + unit.name + ")";
  }
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
                 " of its points: if their units differ, " + likelyFactors(parts, isSmall) + ". Scale the " +
                 (isSmall ? "scene up by it, or the part down." : "scene down by it, or the part up.")
             : std::string();
  }
  return "The scene spans " + number(parts * partDiameter) + " and the part's diameter is " + number(partDiameter) +
         ": if their units differ, " + likelyFactors(parts, parts < 1.0) + ". Scale the " +
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
  const double parts = extent / partDiameter;
  if (parts < LeastPossible || parts > MostPossible)
  {
    const bool isSmall = parts < 1.0;
    throw Error("The scene spans " + number(extent) + " but the part's diameter is " + (isSmall ? "" : "only ") +
                number(partDiameter) + ": their units differ, and " + likelyFactors(parts, isSmall) + ". Scale the " +
                (isSmall ? "scene to the part's unit." : "part to the scene's unit."));
  }
}
}
