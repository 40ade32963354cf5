// SPDX-License-Identifier: BSD-3-Clause
#include "pick/PickSettings.h"

#include "base/Error.h"

#include <cmath>
#include <sstream>

namespace meam
{
void requireWithin(const std::string& name, double value, double low, double high, const std::string& unit)
{
  if (std::isfinite(value) && value >= low && value <= high)
  {
    return;
  }
  std::ostringstream text;
  text << "The " << name << " has to be " << low;
  if (high == Unbounded)
  {
    text << unit << " or more";
  }
  else
  {
    text << " to " << high << unit;
  }
  text << ", not " << value << ".";
  throw Error(text.str());
}

void requireSettings(const PlanSettings& s)
{
  requireWithin("safety margin", s.safetyMargin, 0.0, Unbounded, " mm");
  requireWithin("way in", s.wayIn, 0.0, Unbounded, " mm");
  requireWithin("minimum probability", s.minimumProbability, 0.0, 1.0);
  requireWithin("maximum tilt", s.maximumTilt, 0.0, 180.0, " degrees");
  requireWithin("maximum covered share", s.maximumCovered, 0.0, 100.0, " %");
  requireWithin("turn step", s.turnStep, 1.0, 360.0, " degrees");
  requireWithin("tolerance", s.tolerance, 0.0, Unbounded, " mm");
}
}
