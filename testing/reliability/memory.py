#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""A day in little: finds a part in thousands of scenes in one process, the same handful again and again, read from
their files each time, and looks at the resident memory. It has to stay within a MB of what it is after the first
hundred. Fails otherwise.

. build/release/env.sh && testing/reliability/memory.py --scenes 10000

Every tenth scene goes through ppfmeam.detect, which builds everything anew, the others through `ppfmeam batch`."""
import argparse
import multiprocessing
import os
import sys
import tempfile
import time
import warnings

sys.path.append(os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "filters"))

from batchtest import dataset  # noqa: E402
import ppfmeam  # noqa: E402
from ppfmeam import scripting  # noqa: E402
from ppfmeam.batch import run, scans  # noqa: E402
from ppfmeam.commands import batch  # noqa: E402

HANDFUL, WIDTH, HEIGHT = 5, 120, 90
BLOCK = 100  # scenes between two looks
MOST_GROWTH = 1.0  # MB


def resident():
    """MB of this process that are in memory."""
    with open("/proc/self/statm", encoding="ascii") as file:
        return int(file.read().split()[1]) * os.sysconf("SC_PAGESIZE") / 1e6


def make(bins, path):
    """The scenes and the trained model."""
    scripting.write_model(dataset(bins, HANDFUL, WIDTH, HEIGHT, copies=1)[0], path)


class Plan:
    """What batch.run.Search asks of a run."""

    def __init__(self, model):
        self.objects, self.models = [1], [model]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--scenes", type=scripting.count, default=10000, help="how many (default: %(default)s)")
    parser.add_argument("--threads", type=scripting.count, default=1, help="to work with; 0: all cores (default: 1)")
    given = parser.parse_args()
    with tempfile.TemporaryDirectory() as folder:
        bins, path = os.path.join(folder, "bins"), os.path.join(folder, "part.meam")
        maker = multiprocessing.Process(target=make, args=(bins, path))  # so that this process has not trained
        maker.start()
        maker.join()
        options = batch.options_of_user([bins, "--model", path, "--out", os.path.join(folder, "poses.csv"), "--threads", str(given.threads)])
        search, model = run.Search(options, Plan(path)), ppfmeam.load(path)
        rows = scans.source(options).list()
        found, sizes, start = {}, [], time.monotonic()
        for count in range(1, given.scenes + 1):
            row = rows[count % HANDFUL]
            line = search.line(row)
            if line["failure"]:
                raise scripting.Failure(f"scene {count}: {line['failure']}")
            if found.setdefault(row[0], line["rows"]) != line["rows"]:
                raise scripting.Failure(f"scene {count}: other poses than the first time")
            if count % 10 == 0:
                image = search.source.read(*row)
                warnings.simplefilter("ignore")  # that nothing sure was found, in scans as coarse as these
                ppfmeam.detect(model, image.scene, threads=given.threads)
            if count % BLOCK == 0:
                sizes.append(resident())
                print(f"{count} scenes, {sizes[-1]:.2f} MB, {time.monotonic() - start:.0f} s", flush=True)
    growth = max(sizes) - sizes[0]
    print(f"{given.scenes} scenes: {sizes[0]:.2f} MB after the first {BLOCK}, at most {max(sizes):.2f}, "
          f"{sizes[-1]:.2f} at the end: {growth:+.2f} MB")
    return int(growth > MOST_GROWTH)


scripting.run(main)
