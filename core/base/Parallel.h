// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/Error.h"

#include <vector>

namespace meam
{
/// The number of threads to use for a setting of `requested`; 0 or less: one for each processor.
int numberOfThreads(int requested);

/// Calls work(begin, end, thread) for consecutive ranges of [0, count) on `threads` threads and reports
/// progress from the calling thread. Exceptions thrown by the work and a wish to stop end the loop and
/// come out on the calling thread.
void parallelFor(int count, int threads, const Progress& progress, const std::function<void(int, int, int)>& work);

/// The same of each by itself: work(i).
template <typename Work>
void parallelForEach(int count, int threads, const Progress& progress, const Work& work)
{
  parallelFor(count, threads, progress,
    [&](int begin, int end, int)
    {
      for (int i = begin; i < end; ++i)
      {
        work(i);
      }
    });
}

/// Calls works that do not depend on each other on `threads` threads; exceptions as above.
void inParallel(int threads, const std::vector<std::function<void()>>& works);
}
