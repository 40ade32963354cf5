# SPDX-License-Identifier: BSD-3-Clause
"""What a run has done so far, in a folder beside its result: a file of each process, with two lines of JSON for each scan,
before it is searched and when it is done. A run that was killed is taken up from there; the folder goes when the result is written."""
import fcntl
import json
import os
import shutil
import time

from .. import scripting

RUN = "run.json"
PATIENCE, PAUSE = 10.0, 0.1  # seconds to wait for another run, and between two looks


class Journal:
    """OUT.run: what was asked for (`run`), and lines. The first process opens it before the others add to it."""

    def __init__(self, folder):
        self.folder, self.file, self.lock = folder, None, None

    def path(self, name):
        return os.path.join(self.folder, name)

    def open(self, run):
        """Makes the folder, or takes up what a run with the same `run` has left there. Keeps other runs out until
        this process ends."""
        with scripting.writing(self.folder):
            self.keep_others_out()
        if not os.path.exists(self.path(RUN)):
            with scripting.written(self.path(RUN)) as file:
                json.dump(run, file, indent=1)
        if scripting.read_json(self.path(RUN)) != run:
            raise scripting.Failure(f"{self.folder} is of a run that was stopped and had other parts, scans or "
                                    "options: go on with these, remove it, or choose another --out")

    def keep_others_out(self):
        """Makes the folder and locks it. Processes whose mpirun was killed may still finish their run and take it
        away."""
        last = time.monotonic() + PATIENCE
        while True:
            os.makedirs(self.folder, exist_ok=True)
            try:
                self.lock = open(self.path("lock"), "w")
                fcntl.flock(self.lock, fcntl.LOCK_EX | fcntl.LOCK_NB)
                if os.path.samestat(os.fstat(self.lock.fileno()), os.stat(self.path("lock"))):
                    return
            except BlockingIOError:
                if time.monotonic() > last:
                    raise scripting.Failure(f"{self.folder} is in use: another run writes the same result") from None
            except FileNotFoundError:
                pass
            time.sleep(PAUSE)

    def lines(self):
        """By the scan's name what is known of it, and the names of the scans that were started and not done. What a
        killed process left of its last line is not known."""
        found, started = {}, set()
        for name in sorted(os.listdir(self.folder)):
            if name.endswith(".jsonl"):
                for line in map(json.loads, scripting.whole_lines(self.path(name))):
                    if "started" in line:
                        started.add(line["started"])
                    else:
                        found[line["scan"]] = line
        return found, started.difference(found)

    def start(self, scan):
        """A scan, by its name, that is searched next."""
        self.add({"started": scan})

    def add(self, line):
        """A scan that is done."""
        with scripting.writing(self.folder):
            if not self.file:
                self.file = self.new_file()
            scripting.append(self.file, json.dumps(line) + "\n")

    def new_file(self):
        number = len(os.listdir(self.folder))
        while True:
            try:
                return open(self.path(f"{number:06d}.jsonl"), "xb", buffering=0)
            except FileExistsError:
                number += 1

    def remove_unused(self):
        """Removes the folder when there is nothing in it that a next run would not have at once."""
        if self.lock and not [name for name in os.listdir(self.folder) if name.endswith((".jsonl", ".meam"))]:
            self.remove()

    def remove(self):
        shutil.rmtree(self.folder, ignore_errors=True)
