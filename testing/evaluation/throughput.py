#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Measures `ppfmeam batch` for docs/batch.md: throughput by processes and threads, on a quiet machine. DATASET: bins of `ppfmeam
simulate`; MODEL: of `ppfmeam train`."""
import os
import subprocess
import sys
import tempfile
import time

from ppfmeam import scripting
from ppfmeam.batch import table

import results

BATCH = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", "examples", "batch.py")
ALONE = (sys.executable, BATCH)
RUNS = {  # what is started, and the threads of each process
    "1 process, 1 thread": (ALONE, 1),
    "1 process, 2 threads": (ALONE, 2),
    "2 processes, python3": (("mpirun", "--allow-run-as-root", "-n", "2", *ALONE), 1),
    "2 processes, pvbatch": (("mpirun", "--allow-run-as-root", "-n", "2", "pvbatch", "--symmetric", BATCH), 1),
}


def measure(dataset, model, repeat=3):
    """Of each kind of run a row; the tables have to be the same."""
    first, rows = None, []
    with tempfile.TemporaryDirectory() as folder:
        for number in range(repeat):
            for name, (start, threads) in RUNS.items():
                out, begin = os.path.join(folder, f"{number}_{threads}_{len(start)}.csv"), time.monotonic()
                subprocess.run((*start, dataset, "--model", model, "--threads", str(threads), "--out", out), check=True,
                               stdout=subprocess.DEVNULL)
                seconds, of_scans = time.monotonic() - begin, results.read(table.path_of_scans(out))
                read, find = (results.values(of_scans, which) for which in ("read_s", "find_s"))
                rows.append({"run": name,
                             "scans a second": (2 if start[0] == "mpirun" else 1) * len(find) / float(find.sum() + read.sum()),
                             "read, s": results.median(of_scans, "read_s"), "find, s": results.median(of_scans, "find_s"),
                             "whole run, s": seconds})
                with open(out, "rb") as file:
                    content = file.read()
                first = first or content
                if content != first:
                    raise scripting.Failure(f"{name}: another table")
    return rows


if __name__ == "__main__":
    results.command(measure, repeat="runs of each kind, in turn")
