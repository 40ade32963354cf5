# SPDX-License-Identifier: BSD-3-Clause
"""A script in a process that was forked off one which has loaded VTK already. Not a test."""
import atexit
import os
import runpy
import sys
import traceback


def run(path, *arguments):
    """Runs the script and ends this process with the status that the interpreter would give."""
    sys.argv = [path, *arguments]
    sys.path[0] = os.path.dirname(path)
    try:
        runpy.run_path(path, run_name="__main__")
        code = 0
    except SystemExit as ended:
        code = ended.code or 0
        if not isinstance(code, int):
            print(code, file=sys.stderr)
            code = 1
    except BaseException:
        traceback.print_exc()
        code = 1
    atexit._run_exitfuncs()
    sys.stdout.flush()
    sys.stderr.flush()
    os._exit(code)  # to take the interpreter down with all that is loaded would be most of the time
