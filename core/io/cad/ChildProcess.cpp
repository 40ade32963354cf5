// SPDX-License-Identifier: BSD-3-Clause
#include "io/cad/ChildProcess.h"

#include <fcntl.h>
#include <poll.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>

namespace meam
{
namespace
{
constexpr int PollingTime = 50;          // ms, between two looks at the wish to stop: none is felt
constexpr rlim_t LongestWork = 600;      // s of computing, a hundred times what large parts take: endless loops end
constexpr std::size_t PipeBytes = 65536; // what Linux keeps of a pipe

constexpr char Result = 'R', Failure = 'F'; // the first byte of what the child sends

/// A process and the end of a pipe that it writes to; killed when it still runs at the end.
struct Child
{
  ~Child()
  {
    close(this->pipe);
    kill(this->id, SIGKILL);
    waitpid(this->id, nullptr, 0);
  }

  pid_t id;
  int pipe;
};

/// What the parent is not to suffer from: signals that it handles, words on its terminal, an orphan, a core file, and
/// that it is the one to go when memory runs out.
void isolateChild()
{
  for (const int signal : { SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT, SIGTERM })
  {
    std::signal(signal, SIG_DFL);
  }
  std::signal(SIGINT, SIG_IGN); // it is the parent who is asked, and stops this
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  const rlimit noCore{ 0, 0 }, time{ LongestWork, LongestWork };
  setrlimit(RLIMIT_CORE, &noCore);
  setrlimit(RLIMIT_CPU, &time);
  const int nowhere = open("/dev/null", O_RDWR);
  dup2(nowhere, STDOUT_FILENO);
  dup2(nowhere, STDERR_FILENO);
  const int score = open("/proc/self/oom_score_adj", O_WRONLY);
  [[maybe_unused]] const ssize_t written = write(score, "1000", 4);
}

void sendAll(int pipe, const std::string& bytes)
{
  for (std::size_t sent = 0; sent < bytes.size();)
  {
    const ssize_t count = write(pipe, bytes.data() + sent, bytes.size() - sent);
    if (count < 0 && errno != EINTR)
    {
      return;
    }
    sent += static_cast<std::size_t>(std::max<ssize_t>(count, 0));
  }
}

std::string answerOf(const std::function<std::string()>& work)
{
  try
  {
    return Result + work();
  }
  catch (const Error& error)
  {
    return Failure + std::string(error.what());
  }
  catch (...)
  {
    return {};
  }
}

/// All that comes through the pipe until its other end closes.
std::string receive(int pipe, const Progress& progress)
{
  std::string bytes;
  std::array<char, PipeBytes> buffer;
  for (;;)
  {
    report(progress, 0.0); // how far the library is, it does not say
    pollfd waited{ pipe, POLLIN, 0 };
    if (poll(&waited, 1, PollingTime) <= 0)
    {
      continue;
    }
    const ssize_t count = read(pipe, buffer.data(), buffer.size());
    if (count == 0)
    {
      return bytes;
    }
    bytes.append(buffer.data(), static_cast<std::size_t>(std::max<ssize_t>(count, 0)));
  }
}
}

std::optional<std::string> runInChildProcess(const std::function<std::string()>& work, const Progress& progress)
{
  std::array<int, 2> ends;
  if (pipe2(ends.data(), O_CLOEXEC) != 0)
  {
    throw Error("No pipe to another process can be made: too many files are open.");
  }
  const pid_t id = fork();
  if (id == 0)
  {
    isolateChild();
    close(ends[0]);
    sendAll(ends[1], answerOf(work));
    _exit(0);
  }
  close(ends[1]);
  if (id < 0)
  {
    close(ends[0]);
    throw Error("No other process can be started: too many are running, or there is too little memory.");
  }
  const Child child{ id, ends[0] };
  std::string answer = receive(child.pipe, progress);
  if (answer.empty())
  {
    return {};
  }
  const bool isFailure = answer[0] == Failure;
  answer.erase(0, 1);
  if (isFailure)
  {
    throw Error(answer);
  }
  return answer;
}
}
