// SPDX-License-Identifier: BSD-3-Clause
#include "base/Parallel.h"

#include <omp.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <condition_variable>
#include <cstdint>
#include <exception>
#include <memory>
#include <mutex>
#include <system_error>
#include <thread>

namespace meam
{
namespace
{
constexpr int RangesPerThread = 16;        // enough to balance the load and to report progress
constexpr int MostThreadsPerProcessor = 8; // more help nobody, and the system refuses very many

/// The threads that help one caller. They sleep between its loops: those of GCC's OpenMP would keep their processors
/// busy meanwhile, and beside another busy program two threads would take longer than one.
class Helpers
{
public:
  Helpers() = default;
  Helpers(const Helpers&) = delete;
  void operator=(const Helpers&) = delete;

  ~Helpers()
  {
    {
      const std::lock_guard<std::mutex> lock(this->Mutex);
      this->IsOver = true;
    }
    this->Wake.notify_all();
    for (std::thread& thread : this->Threads)
    {
      thread.join();
    }
  }

  /// Whether they are those of this process, and not of the one that it was forked from.
  bool areHere() const { return this->Process == getpid(); }

  /// Calls work(thread) on the calling thread, which is 0, and on `count` others, as far as they come before it is
  /// done.
  void help(int count, const std::function<void(int)>& work)
  {
    {
      const std::lock_guard<std::mutex> lock(this->Mutex);
      try
      {
        while (static_cast<int>(this->Threads.size()) < count)
        {
          const int thread = static_cast<int>(this->Threads.size()) + 1;
          this->Threads.emplace_back([this, thread, turn = this->Turn] { this->serve(thread, turn); });
        }
      }
      catch (const std::system_error&) // there are no more threads to be had: those that are there do all
      {
      }
      this->Work = &work;
      this->Wanted = count;
      ++this->Turn;
    }
    this->Wake.notify_all();
    work(0);
    std::unique_lock<std::mutex> lock(this->Mutex);
    this->Wanted = 0; // whoever has not come yet is not needed
    this->Done.wait(lock, [this] { return this->Working == 0; });
  }

private:
  void serve(int thread, std::uint64_t turn)
  {
    std::unique_lock<std::mutex> lock(this->Mutex);
    while (true)
    {
      this->Wake.wait(lock, [&] { return this->IsOver || this->Turn != turn; });
      if (this->IsOver)
      {
        return;
      }
      turn = this->Turn;
      if (thread <= this->Wanted)
      {
        ++this->Working;
        lock.unlock();
        (*this->Work)(thread);
        lock.lock();
        --this->Working;
        this->Done.notify_one();
      }
    }
  }

  const pid_t Process = getpid();
  std::mutex Mutex;
  std::condition_variable Wake, Done;
  std::vector<std::thread> Threads;
  const std::function<void(int)>* Work = nullptr;
  int Wanted = 0;
  int Working = 0;
  std::uint64_t Turn = 0; ///< how many loops there were
  bool IsOver = false;
};

thread_local bool IsInLoop = false; // a loop within a loop is the calling thread's alone

void onThreads(int count, const std::function<void(int)>& work)
{
  if (count == 1 || IsInLoop)
  {
    work(0);
    return;
  }
  thread_local std::unique_ptr<Helpers> helpers;
  if (helpers && !helpers->areHere())
  {
    static_cast<void>(helpers.release()); // threads that a fork left behind cannot be joined
  }
  if (!helpers)
  {
    helpers = std::make_unique<Helpers>();
  }
  helpers->help(count - 1,
    [&work](int thread)
    {
      IsInLoop = true;
      work(thread);
      IsInLoop = false;
    });
}
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
  std::mutex ofFailure;
  std::exception_ptr failure;
  onThreads(used,
    [&](int thread)
    {
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
          const std::lock_guard<std::mutex> lock(ofFailure);
          failure = std::current_exception();
          stop = true;
        }
      }
    });
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
