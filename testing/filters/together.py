# SPDX-License-Identifier: BSD-3-Clause
"""Runs the scripts of the arguments one after the other, each in a process of its own that is forked off this one: ParaView
starts and loads its plugin once. Says which of them fail. Not a test."""
import os
import sys

import ppfmeam.filters  # noqa: F401
import forked
from meamtest import SKIPPED

failed = []
for path in sys.argv[1:]:
    child = os.fork()
    if child == 0:
        forked.run(path)
    status = os.waitstatus_to_exitcode(os.waitpid(child, 0)[1])
    if status not in (0, SKIPPED):
        failed.append(f"{os.path.basename(path)}: {status}")
if failed:
    sys.exit("failed: " + ", ".join(failed))
