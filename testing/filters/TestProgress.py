# SPDX-License-Identifier: BSD-3-Clause
"""In a terminal a command tells which step works, how far it is and how long it takes, in a line that goes; elsewhere nothing."""
import contextlib
import io
import os
import signal
import time

from ppfmeam import filters, progress, scripting
from meamtest import check


class Terminal(io.StringIO):
    def isatty(self):
        return True


class Filter:
    """Of a class of this name, at this share of its work."""

    def __init__(self, name, done):
        self.GetClassName, self.GetProgress = (lambda: name), (lambda: done)


def told(file, *heard):
    """What is written when filters are heard of, each so many seconds after the one before."""
    now, clock = [100.0], time.monotonic
    progress.time.monotonic = lambda: now[0]
    try:
        with contextlib.redirect_stderr(file):
            steps = progress.Steps()
            for after, name, done in heard:
                now[0] += after
                steps.show(Filter(name, done))
            steps.end()
    finally:
        progress.time.monotonic = clock
    return file.getvalue().replace("\r\x1b[K", "|")


check(progress.words_of("vtkMEAMMeshPreparation") == "mesh preparation" and progress.words_of("vtkSTLReader") == "STL reader", "words")
check(told(Terminal(), (0.5, "vtkMEAMHashing", 0.1), (0.4, "vtkMEAMHashing", 0.9)) == "", "what is short says nothing")
text = told(Terminal(), (0.0, "vtkMEAMHashing", 0.0), (4.0, "vtkMEAMHashing", 0.25), (0.1, "vtkMEAMHashing", 0.3),
            (1.0, "vtkSTLReader", 0.0))
check(text == "|hashing: 25 %, 12 s left|STL reader: 0 %|", text)
check(told(io.StringIO(), (0.0, "vtkMEAMHashing", 0.0), (4.0, "vtkMEAMHashing", 0.5)) == "", "no terminal")

# A real step, of scripts that Ctrl-C ends.
mesh = filters.vtkMEAMMeshReader()
mesh.SetFileName(os.path.join(os.path.dirname(__file__), "..", "..", "examples", "data", "ribbed_flange.stl"))
terminal = Terminal()
progress.PATIENCE = progress.PAUSE = 0.0
signal.signal(signal.SIGINT, scripting.interruption.ask)
with contextlib.redirect_stderr(terminal):
    scripting.update(mesh)
    shown = terminal.getvalue()
    scripting.interruption.shows = False
    mesh.Modified()
    scripting.update(mesh)
check("mesh reader: " in shown and shown.endswith("\r\x1b[K") and terminal.getvalue() == shown, repr(shown))
