# SPDX-License-Identifier: BSD-3-Clause
"""The command `ppfmeam`: `ppfmeam detect ...` and the like, also `python3 -m ppfmeam detect ...`."""
import argparse
import importlib
import sys

from .commands import SUMMARIES
from .version import VERSION


def main():
    """Runs the sub-command that sys.argv names, as a script of its own with the name `ppfmeam NAME`."""
    width = max(map(len, SUMMARIES))
    parser = argparse.ArgumentParser(
        prog="ppfmeam", formatter_class=argparse.RawDescriptionHelpFormatter, usage="%(prog)s [-h] [--version] COMMAND ...",
        description="Finds the copies of industrial parts in a bin: ranked 6D poses from a CAD file and a scan.",
        epilog="commands:\n" + "\n".join(f"  {name:{width}}  {summary}" for name, summary in SUMMARIES.items())
        + "\n\nppfmeam COMMAND --help tells the options of each.")
    parser.add_argument("--version", action="version", version=f"ppfmeam {VERSION}")
    parser.add_argument("command", choices=SUMMARIES, metavar="COMMAND", help=argparse.SUPPRESS)
    if len(sys.argv) == 1:
        parser.print_help(sys.stderr)
        sys.exit(2)
    command = parser.parse_args(sys.argv[1:2]).command
    sys.stdout.reconfigure(errors="backslashreplace")  # names of files may be no UTF-8
    sys.argv = [f"ppfmeam {command}", *sys.argv[2:]]

    from . import scripting  # loads VTK, which --help does without
    scripting.run(importlib.import_module(f".commands.{command.replace('-', '_')}", __package__).main)


if __name__ == "__main__":
    main()
