// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/Error.h"

#include <chrono>
#include <optional>

namespace meam
{
/// A time at which work ends with what is done until then; none by default.
class Deadline
{
public:
  Deadline() = default;
  /// In so many seconds from now on, also in none or less.
  explicit Deadline(double seconds)
    : At(Clock::now() + std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(seconds)))
  {
  }

  bool isSet() const { return this->At.has_value(); }
  bool hasStruck() const { return this->At && Clock::now() >= *this->At; }

  /// When this share of the time that is left is over.
  Deadline after(double share) const
  {
    return this->At ? Deadline(share * std::chrono::duration<double>(*this->At - Clock::now()).count()) : Deadline();
  }

  /// A callback that asks to stop as `progress` does, and when the time has come.
  Progress within(const Progress& progress) const
  {
    return this->At ? [=, *this](double share) { return (!progress || progress(share)) && !this->hasStruck(); }
                    : progress;
  }

private:
  using Clock = std::chrono::steady_clock;
  std::optional<Clock::time_point> At;
};

/// Works up to a deadline: false when it struck meanwhile. Throws Aborted when something else asked to stop.
template <typename Work>
bool isDoneBy(const Deadline& deadline, Work&& work)
{
  try
  {
    work();
    return true;
  }
  catch (const Aborted&)
  {
    if (!deadline.hasStruck())
    {
      throw;
    }
    return false;
  }
}
}
