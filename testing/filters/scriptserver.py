# SPDX-License-Identifier: BSD-3-Clause
"""Runs scripts of examples/ or testing/evaluation/, each in a process of its own that is forked off this one: what they import is loaded once. Of
each line of input, a JSON list of the script and its arguments, the output is a line: exit status, output, errors. Not a
test."""
import atexit
import json
import os
import runpy
import sys
import tempfile
import traceback

import ppfmeam.bop  # noqa: F401
import ppfmeam.cell  # noqa: F401
import ppfmeam.evaluation  # noqa: F401
import ppfmeam.picture  # noqa: F401
import ppfmeam.simulation  # noqa: F401



def status_of(path):
    """Runs the script; the exit status that the interpreter would end with."""
    try:
        runpy.run_path(path, run_name="__main__")
    except SystemExit as ended:
        if ended.code is None or isinstance(ended.code, int):
            return ended.code or 0
        print(ended.code, file=sys.stderr)
        return 1
    except BaseException:
        traceback.print_exc()
        return 1
    return 0


for line in sys.stdin:
    with tempfile.TemporaryFile("w+") as output, tempfile.TemporaryFile("w+") as errors:
        child = os.fork()
        if child == 0:
            os.dup2(os.open(os.devnull, os.O_RDONLY), 0)
            os.dup2(output.fileno(), 1)
            os.dup2(errors.fileno(), 2)
            sys.argv = json.loads(line)
            sys.path[0] = os.path.dirname(sys.argv[0])
            code = status_of(sys.argv[0])
            atexit._run_exitfuncs()
            sys.stdout.flush()
            sys.stderr.flush()
            os._exit(code)  # to take the interpreter down with all that is loaded would be most of the time
        status = os.waitstatus_to_exitcode(os.waitpid(child, 0)[1])
        texts = []
        for file in (output, errors):
            file.seek(0)
            texts.append(file.read())
    print(json.dumps([status, *texts]), flush=True)
