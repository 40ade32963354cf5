// SPDX-License-Identifier: BSD-3-Clause
#include "pick/PickSettings.h"

#include "base/Range.h"

namespace meam
{
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
