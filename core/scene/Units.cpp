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
// A part in a tenth of the scan's unit spans few of its points: of what is ten times as large an edge looks like one.
constexpr double ManyParts = 20.0; // diameters that the scene spans,
constexpr double FewPoints = 40.0; // and points that the part does: fewer hardly tell it
// And the other way round, when nothing sure was found.
constexpr double FewParts = 4.0;
constexpr double ManyPoints = 500.0; // of a part that fills the picture, of a camera of a megapixel
constexpr double OtherThings = 0.02; // of the points, at each end of each axis: they are left out when there is more

// No camera is so near to a robot's base or gripper, in metres it is; and none so far, in mm it is.
constexpr double NearestCamera = 3.0;           // mm
constexpr double FarthestCamera = 50.0 * Metre; // mm

// With the property to change.
std::string sceneScaled(const std::string& how) { return "scene " + how + " (Scale of its reader)"; }
std::string partScaled(const std::string& how) { return "part " + how + " (CADScale)"; }

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
  std::vector<std::pair<double, LengthUnit>> likely;
  for (const LengthUnit& unit : UnitsBesideMM)
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
    likely.emplace_back(0.0, UnitsBesideMM[0]);
  }
  std::string text = "the likely factor is ";
  for (const auto& [distance, unit] : likely)
  {
    text += (text.back() == ')' ? ", or " : "") + number(unit.length) + " (" + unit.name + ")";
  }
  return text;
}
}

std::string cameraUnitDoubt(double distance)
{
  const bool isNear = distance < NearestCamera;
  char text[32];
  std::snprintf(text, sizeof(text), isNear ? "%.3f" : "%.0f", distance);
  return distance > 0.0 && (isNear || distance > FarthestCamera)
           ? "the camera " + std::string(text) + " mm away: its lengths are likely in " + (isNear ? "metres" : "mm") +
               ", where they are taken as " + (isNear ? "mm" : "metres")
           : std::string();
}

std::string unitsWarning(const Points& scene, double partDiameter, double pointDistance, bool isSure)
{
  const double parts = bounds(scene).diagonal().norm() / partDiameter;
  if (parts >= LeastUsual && parts <= MostUsual)
  {
    const double points = pointDistance > 0.0 ? partDiameter / pointDistance : 0.0;
    const bool isLarge = parts > ManyParts && points < FewPoints;
    const bool isSmall = !isSure && parts < FewParts && points > ManyPoints;
    return pointDistance > 0.0 && (isLarge || isSmall)
             ? "The scan spans " + number(parts) + " diameters of the part, and the part " + number(points) +
                 " of its points: if their units differ, " + likelyFactors(parts, isSmall) + ". Scale the " +
                 sceneScaled(isSmall ? "up by it" : "down by it") + ", or the " + partScaled(isSmall ? "down" : "up") +
                 "."
             : std::string();
  }
  return "The scene spans " + number(parts * partDiameter) + " and the part's diameter is " + number(partDiameter) +
         ": if their units differ, " + likelyFactors(parts, parts < 1.0) + ". Scale the " +
         (parts < 1.0 ? sceneScaled("by it") : partScaled("by it")) + ".";
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
                (isSmall ? sceneScaled("to the part's unit") : partScaled("to the scene's unit")) + ".");
  }
}
}
