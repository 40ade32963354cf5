// SPDX-License-Identifier: BSD-3-Clause
#include "io/cad/ChildProcess.h"

#include "TestFiles.h"

#include <unistd.h>

#include <csignal>

TEST(ChildProcess, resultsAndErrorsComeBack)
{
  const std::string much(1 << 20, 'x'); // more than a pipe holds
  EXPECT_EQ(meam::runInChildProcess([&] { return much; }, {}), much);
  EXPECT_EQ(meam::runInChildProcess([] { return ""; }, {}), "");
  const auto fails = [] { return meam::runInChildProcess([]() -> std::string { throw meam::Error("why"); }, {}); };
  EXPECT_EQ(files::errorOf(fails), "why");
}

TEST(ChildProcess, whatEndsWithoutAResultHarmsNobody)
{
  const auto crashes = []() -> std::string
  {
    std::raise(SIGSEGV);
    return "never";
  };
  EXPECT_EQ(meam::runInChildProcess(crashes, {}), std::nullopt);
  EXPECT_EQ(meam::runInChildProcess([]() -> std::string { throw 1; }, {}), std::nullopt);
}

TEST(ChildProcess, itsWordsAreNotHeard)
{
  testing::internal::CaptureStdout();
  meam::runInChildProcess(
    [] { return std::string(1, static_cast<char>('0' + std::puts("heard") + std::fflush(stdout))); }, {});
  EXPECT_EQ(testing::internal::GetCapturedStdout(), "");
}

TEST(ChildProcess, aWishToStopEndsIt)
{
  int asked = 0;
  const auto stop = [&](double) { return ++asked < 3; };
  const auto sleeps = []() -> std::string
  {
    sleep(600);
    return "late";
  };
  EXPECT_THROW(meam::runInChildProcess(sleeps, stop), meam::Aborted);
  EXPECT_EQ(asked, 3);
}
