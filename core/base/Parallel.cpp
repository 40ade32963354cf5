// SPDX-License-Identifier: BSD-3-Clause
#include "base/Parallel.h"

#include <omp.h>

#include <algorithm>
#include <atomic>
#include <exception>

namespace meam
{
namespace
{
constexpr int RangesPerThread = 16;        // enough to balance the load and to report progress
constexpr int MostThreadsPerProcessor = 8; // more help nobody, and the system refuses very many
}

int numberOfThreads(int requested)
{
  const int processors = omp_get_num_procs();
  return requested > 0 ? std::min(requested, MostThreadsPerProcessor * processors) : processors;
}

void parallelFor(int count, int threads, const Progress& progress, const std::function<void(int, int, int)>& work)
{
  const int used = std::max(1, std::min(numberOfThreads(threads), count));
  const int size = std::max(1, count / (used * RangesPerThread));
  std::atomic<int> next{ 0 };
  std::atomic<bool> stop{ false };
  std::exception_ptr failure;
#pragma omp parallel num_threads(used)
  {
    const int thread = omp_get_thread_num();
    while (!stop)
    {
      const int begin = next.fetch_add(size);
      if (begin >= count)
      {
        break;
      }
      try
      {
        if (thread == 0)
        {
          report(progress, static_cast<double>(begin) / count);
        }
        work(begin, std::min(begin + size, count), thread);
      }
      catch (...)
      {
#pragma omp critical(meamParallelFor)
        failure = std::current_exception();
        stop = true;
      }
    }
  }
  if (failure)
  {
    std::rethrow_exception(failure);
  }
}

void inParallel(int threads, const std::vector<std::function<void()>>& works)
{
  parallelFor(static_cast<int>(works.size()), threads, {},
    [&](int begin, int end, int)
    {
      for (; begin < end; ++begin)
      {
        works[begin]();
      }
    });
}
}
