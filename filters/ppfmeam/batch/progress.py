# SPDX-License-Identifier: BSD-3-Clause
"""The line that tells how far a run is."""
import sys
import time

from ..progress import duration

PAUSE = 10.0  # seconds between two lines where they stay, as in a file
TERMINAL_PAUSE = 0.2


class Progress:
    """One line on stderr, written over itself in a terminal. `before`: scans that an earlier run has done."""

    def __init__(self, total, before):
        self.total, self.before, self.start = total, before, time.monotonic()
        self.last, self.shown, self.terminal = self.start, False, sys.stderr.isatty()

    def show(self, done, failed):
        """How many of this run are done, and how many of them failed."""
        now = time.monotonic()
        if not done or now - self.last < (TERMINAL_PAUSE if self.terminal else PAUSE):
            return
        took = now - self.start
        text = f"{self.before + done} of {self.total} scans, {failed} failed, {done / took:.2f} a second, " \
               f"{duration((self.total - self.before - done) * took / done)} left"
        text = f"\r\x1b[K{text}" if self.terminal else text + "\n"
        print(text, end="", file=sys.stderr, flush=True)
        self.last, self.shown = now, True

    def end(self):
        if self.terminal and self.shown:
            print(file=sys.stderr)
