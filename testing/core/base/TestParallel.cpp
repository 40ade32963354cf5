// SPDX-License-Identifier: BSD-3-Clause
#include "base/Parallel.h"

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <atomic>
#include <thread>

namespace
{
/// How often each of so many was worked on, by so many threads.
std::vector<int> visits(int count, int threads)
{
  std::vector<int> visited(count, 0);
  meam::parallelFor(count, threads, {},
    [&](int begin, int end, int thread)
    {
      EXPECT_LT(thread, threads);
      for (int i = begin; i < end; ++i)
      {
        ++visited[i];
      }
    });
  return visited;
}
}

TEST(Parallel, EachIsWorkedOnOnce)
{
  for (const int threads : { 1, 2, 8, 3 })
  {
    for (const int count : { 0, 1, 2, 1000 })
    {
      EXPECT_EQ(visits(count, threads), std::vector<int>(count, 1)) << threads << " threads";
    }
  }
}

TEST(Parallel, ProgressAndErrorsComeOutOnTheCallingThread)
{
  const std::thread::id caller = std::this_thread::get_id();
  double last = -1.0;
  const auto progress = [&](double done)
  {
    EXPECT_EQ(std::this_thread::get_id(), caller);
    EXPECT_GT(done, last);
    last = done;
    return true;
  };
  meam::parallelFor(100, 2, progress, [](int, int, int) {});
  EXPECT_THROW(meam::parallelFor(100, 2, {}, [](int, int, int) -> void { throw meam::Error("wrong"); }), meam::Error);
  EXPECT_EQ(visits(10, 2), std::vector<int>(10, 1)) << "after an error";
}

TEST(Parallel, ALoopWithinALoopIsTheCallingThreads)
{
  std::atomic<int> visited{ 0 };
  meam::parallelFor(4, 2, {},
    [&](int begin, int end, int)
    {
      const std::thread::id outer = std::this_thread::get_id();
      meam::parallelFor(10 * (end - begin), 2, {},
        [&](int from, int to, int)
        {
          EXPECT_EQ(std::this_thread::get_id(), outer);
          visited += to - from;
        });
    });
  EXPECT_EQ(visited, 40);
}

TEST(Parallel, CallersDoNotWaitForEachOther)
{
  std::vector<std::thread> callers;
  std::atomic<int> right{ 0 };
  for (int i = 0; i < 4; ++i)
  {
    callers.emplace_back(
      [&]
      {
        for (int k = 0; k < 200; ++k)
        {
          right += visits(50, 2) == std::vector<int>(50, 1);
        }
      });
  }
  for (std::thread& caller : callers)
  {
    caller.join();
  }
  EXPECT_EQ(right, 800);
}

TEST(Parallel, AForkedProcessHasThreadsOfItsOwn)
{
  EXPECT_EQ(visits(100, 2), std::vector<int>(100, 1));
  const pid_t child = fork();
  if (child == 0)
  {
    alarm(20); // it would wait for ever
    _exit(visits(100, 2) == std::vector<int>(100, 1) ? 0 : 1);
  }
  int status = -1;
  waitpid(child, &status, 0);
  EXPECT_TRUE(WIFEXITED(status) && WEXITSTATUS(status) == 0) << status;
}
