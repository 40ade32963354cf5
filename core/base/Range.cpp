// SPDX-License-Identifier: BSD-3-Clause
#include "base/Range.h"

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

void requirePositive(const std::string& name, double value, double high, const std::string& unit)
{
  if (std::isfinite(value) && value > 0.0 && value <= high)
  {
    return;
  }
  std::ostringstream text;
  text << "The " << name << " has to be above 0";
  if (high < Unbounded)
  {
    text << " and at most " << high;
  }
  text << unit << ", not " << value << ".";
  throw Error(text.str());
}
}
