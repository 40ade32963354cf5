# SPDX-License-Identifier: BSD-3-Clause
"""Runs scripts of examples/ or testing/evaluation/, each in a process of its own that is forked off this one: what they import is loaded once. Of
each line of input, a JSON list of the script and its arguments, the output is a line: exit status, output, errors. Not a
test."""
import json
import os
import sys
import tempfile

import ppfmeam.bop  # noqa: F401
import ppfmeam.cell  # noqa: F401
import ppfmeam.evaluation  # noqa: F401
import ppfmeam.picture  # noqa: F401
import ppfmeam.simulation  # noqa: F401
import forked

for line in sys.stdin:
    with tempfile.TemporaryFile("w+") as output, tempfile.TemporaryFile("w+") as errors:
        child = os.fork()
        if child == 0:
            os.dup2(os.open(os.devnull, os.O_RDONLY), 0)
            os.dup2(output.fileno(), 1)
            os.dup2(errors.fileno(), 2)
            forked.run(*json.loads(line))
        status = os.waitstatus_to_exitcode(os.waitpid(child, 0)[1])
        texts = []
        for file in (output, errors):
            file.seek(0)
            texts.append(file.read())
    print(json.dumps([status, *texts]), flush=True)
