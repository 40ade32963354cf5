# SPDX-License-Identifier: BSD-3-Clause
"""Runs scripts of examples/ or testing/evaluation/, each in a process of its own that is forked off this one: what they import is loaded once. Of
each line of input, a JSON list of the script and its arguments, the output is a line: exit status, output, errors. Not a
test."""
import gc
import json
import os
import pkgutil  # noqa: F401  for runpy
import sys
import tempfile

from ppfmeam import picture, simulation  # noqa: F401
from ppfmeam.commands import batch, evaluate, pick, train, why  # noqa: F401
import forked

gc.freeze()  # a child that looks for garbage would copy all that it shares with this process
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
