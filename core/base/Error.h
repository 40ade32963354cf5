// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <functional>
#include <stdexcept>
#include <string>

namespace meam
{
/// Every failure a user can act on: the message says what is wrong and what to do. Exported, as the next, so that it is
/// caught outside of the library that throws it.
class __attribute__((visibility("default"))) Error : public std::runtime_error
{
public:
  using std::runtime_error::runtime_error;
};

/// Thrown when the progress callback asked to stop. Nothing is returned then.
class __attribute__((visibility("default"))) Aborted : public std::exception
{
public:
  const char* what() const noexcept override { return "stopped on request"; }
};

/// Called on the calling thread with the share of the work done, in [0, 1]; returns false to stop.
using Progress = std::function<bool(double)>;

/// Reports the share done and throws Aborted when the caller wants to stop. A null callback is fine.
inline void report(const Progress& progress, double share)
{
  if (progress && !progress(share))
  {
    throw Aborted();
  }
}

/// The same at every 65536th step of a loop whose steps take less time than a report.
inline void reportStep(const Progress& progress, std::size_t step, double share)
{
  if (step % 65536 == 0)
  {
    report(progress, share);
  }
}

/// The callback for one part, [from, to], of a longer piece of work.
inline Progress subProgress(const Progress& progress, double from, double to)
{
  if (!progress)
  {
    return {};
  }
  return [=](double share) { return progress(from + (to - from) * share); };
}

/// Adds a sentence to what a user is told, with a blank between them; either may be empty.
inline void appendSentence(std::string& told, const std::string& sentence)
{
  told += (told.empty() || sentence.empty() ? "" : " ") + sentence;
}
}
