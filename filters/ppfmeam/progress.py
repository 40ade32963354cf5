# SPDX-License-Identifier: BSD-3-Clause
"""How far the step of a command is that takes long, in a line of the terminal that goes when it is done."""
import re
import sys
import time

PATIENCE, PAUSE = 1.0, 0.2  # seconds before the line comes, and between two
LEAST_DONE = 0.02  # share of a step that tells how long the rest takes


def duration(seconds):
    """Such as 4 s, 12 min, 3.5 h."""
    if seconds < 100:
        return f"{seconds:.0f} s"
    return f"{seconds / 60:.0f} min" if seconds < 6000 else f"{seconds / 3600:.1f} h"


def words_of(name):
    """Of a filter's class: vtkMEAMMeshCleaning is mesh cleaning."""
    words = re.findall(r"[A-Z]+(?![a-z])|[A-Z][a-z]+", re.sub("^vtk(MEAM)?", "", name))
    return " ".join(word if word.isupper() else word.lower() for word in words)


class Steps:
    """Hears of the progress of VTK's filters."""

    def __init__(self):
        self.start = self.last = time.monotonic()
        self.name = None  # of the filter that works
        self.is_shown, self.is_terminal = False, sys.stderr.isatty()

    def show(self, filter):
        now, name = time.monotonic(), words_of(filter.GetClassName())
        if name != self.name:
            self.name, self.start = name, now
        if not self.is_terminal or now - self.last < (PAUSE if self.is_shown else PATIENCE):
            return
        done, took = filter.GetProgress(), now - self.start
        left = f", {duration(took * (1 - done) / done)} left" if LEAST_DONE < done < 1 and took > PATIENCE else ""
        print(f"\r\x1b[K{name}: {100 * done:.0f} %{left}", end="", file=sys.stderr, flush=True)
        self.last, self.is_shown = now, True

    def end(self):
        """When the filters are done: takes the line away."""
        if self.is_shown:
            print("\r\x1b[K", end="", file=sys.stderr, flush=True)
            self.is_shown = False
