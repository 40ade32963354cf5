# SPDX-License-Identifier: BSD-3-Clause
"""Work that may end the process that does it, as a crash in a library does."""
import ctypes
import json
import os
import signal

PR_SET_PDEATHSIG = 1  # of linux/prctl.h


class Ended(Exception):
    """Says how the process has ended."""


def words(status):
    """In words, of os.waitstatus_to_exitcode()."""
    try:
        return signal.Signals(-status).name if status < 0 else f"status {status}"
    except ValueError:  # most real-time signals have no name
        return f"signal {-status}"


def apart(work):
    """What work() returns, which JSON can hold, done by a copy of this process: one that has not worked with threads yet,
    since they are not copied."""
    source, sink = os.pipe()
    parent, prctl = os.getpid(), ctypes.CDLL(None).prctl
    child = os.fork()
    if child == 0:
        status = 1
        try:
            prctl(PR_SET_PDEATHSIG, signal.SIGKILL)  # else work() that never ends would hold the parent's locks
            if os.getppid() != parent:
                os._exit(status)
            os.close(source)
            with open(sink, "w", encoding="utf-8") as file:
                json.dump(work(), file)
            status = 0
        finally:
            os._exit(status)  # what this process is to do at its end is left to the other one
    os.close(sink)
    with open(source, encoding="utf-8") as file:
        text = file.read()
    status = os.waitstatus_to_exitcode(os.waitpid(child, 0)[1])
    if status != 0:
        raise Ended(words(status))
    return json.loads(text)
