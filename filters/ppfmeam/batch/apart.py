# SPDX-License-Identifier: BSD-3-Clause
"""Work that may end the process that does it, as a crash in a library does."""
import ctypes
import json
import os
import signal
import time

from .. import scripting

PR_SET_PDEATHSIG = 1  # of linux/prctl.h
PATIENCE, PAUSE = 5.0, 0.005  # seconds that a copy may take to end, and between two looks


class Ended(Exception):
    """Says how the process has ended."""


def words(status):
    """In words, of os.waitstatus_to_exitcode()."""
    try:
        return signal.Signals(-status).name if status < 0 else f"status {status}"
    except ValueError:  # most real-time signals have no name
        return f"signal {-status}"


class Copy:
    """A copy of this process that calls work(...) as often as it is called itself; JSON can hold what goes in and comes
    out. This process has not worked with threads yet, since they are not copied."""

    def __init__(self, work):
        asked, ask = os.pipe()
        answer, answered = os.pipe()
        parent, prctl = os.getpid(), ctypes.CDLL(None).prctl
        self.process = os.fork()
        if self.process == 0:
            status = 1
            try:
                prctl(PR_SET_PDEATHSIG, signal.SIGKILL)  # else work that never ends would hold the parent's locks
                os.setpgid(0, 0)  # Ctrl-C is for the parent, which ends this one
                if os.getppid() != parent:
                    os._exit(status)
                os.close(ask)
                os.close(answer)
                self.serve(work, asked, answered)
                status = 0
            finally:
                os._exit(status)  # what this process is to do at its end is left to the other one
        os.close(asked)
        os.close(answered)
        self.requests, self.answers = open(ask, "wb", buffering=0), open(answer, encoding="utf-8")

    @staticmethod
    def serve(work, asked, answered):
        """Until nothing is asked any more."""
        with open(asked, encoding="utf-8") as requests, open(answered, "w", encoding="utf-8") as answers:
            for request in requests:
                value, failure = None, None
                try:
                    value = work(*json.loads(request))
                except scripting.Failure as error:
                    failure = str(error)
                print(json.dumps((value, failure)), file=answers, flush=True)

    def __call__(self, *arguments):
        """What work(...) returns, or its Failure; Ended if it ends the copy."""
        try:
            scripting.write_all(self.requests, json.dumps(arguments).encode() + b"\n")
            line = self.answers.readline()
        except BrokenPipeError:
            line = ""
        if not line.endswith("\n"):
            process, self.process = self.process, None
            self.close()
            raise Ended(words(os.waitstatus_to_exitcode(os.waitpid(process, 0)[1])))
        value, failure = json.loads(line)
        if failure is not None:
            raise scripting.Failure(failure)
        return value

    def close(self):
        """Stops what it does, as Ctrl-C would, and ends it."""
        self.requests.close()
        self.answers.close()
        if not self.process:
            return
        os.kill(self.process, signal.SIGINT)
        last = time.monotonic() + PATIENCE
        while os.waitpid(self.process, os.WNOHANG)[0] == 0:
            if time.monotonic() > last:
                os.kill(self.process, signal.SIGKILL)
            time.sleep(PAUSE)
        self.process = None

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.close()


def apart(work):
    """What work() returns, which JSON can hold, done by a copy of this process."""
    with Copy(work) as copy:
        return copy()
