// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <chrono>

namespace meam
{
/// Seconds since the last call.
class Stopwatch
{
public:
  double lap()
  {
    const auto now = std::chrono::steady_clock::now();
    const double seconds = std::chrono::duration<double>(now - this->Last).count();
    this->Last = now;
    return seconds;
  }

private:
  std::chrono::steady_clock::time_point Last = std::chrono::steady_clock::now();
};
}
