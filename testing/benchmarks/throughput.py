#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Measures `ppfmeam batch` for docs/batch.md: throughput by processes and threads, and what a run costs beside the
search: sizes and times of the model, the scans, the journal and the table. On a quiet machine.

. build/release/env.sh && testing/benchmarks/throughput.py DATASET MODEL [--repeat N]

DATASET: bins of `ppfmeam simulate`; MODEL: of `ppfmeam train`."""
import argparse
import csv
import json
import os
import pickle
import statistics
import subprocess
import sys
import tempfile
import time

from ppfmeam import scripting
from ppfmeam.batch import run, scans, table

BATCH = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", "examples", "batch.py")
ALONE = (sys.executable, BATCH)
RUNS = {  # what is started, and the threads of each process
    "1 process, 1 thread": (ALONE, 1),
    "1 process, 2 threads": (ALONE, 2),
    "2 processes, python3": (("mpirun", "--allow-run-as-root", "-n", "2", *ALONE), 1),
    "2 processes, pvbatch": (("mpirun", "--allow-run-as-root", "-n", "2", "pvbatch", "--symmetric", BATCH), 1),
}


class Plan:
    """What batch.run.Search asks of a run."""

    def __init__(self, model):
        self.objects, self.models = [1], [model]


def column(path, name):
    with open(path, encoding="utf-8", newline="") as file:
        return [float(row[name]) for row in csv.DictReader(file)]


def throughput(options, folder):
    """Of each kind of run a line; the tables have to be the same."""
    print("| | scans a second | s a scan: read | find | whole run, s |\n|---|---|---|---|---|")
    first = None
    for _ in range(options.repeat):
        for name, (start, threads) in RUNS.items():
            out = os.path.join(folder, f"{len(os.listdir(folder))}.csv")
            begin = time.monotonic()
            arguments = (options.scans, "--model", options.model, "--threads", str(threads), "--out", out)
            subprocess.run((*start, *arguments), check=True, stdout=subprocess.DEVNULL)
            seconds = time.monotonic() - begin
            of_scans = table.path_of_scans(out)
            read, find = (column(of_scans, which) for which in ("read_s", "find_s"))
            processes = 2 if start[0] == "mpirun" else 1
            rate = processes * len(find) / (sum(find) + sum(read))
            medians = f"{statistics.median(read):.3f} | {statistics.median(find):.3f}"
            print(f"| {name} | {rate:.2f} | {medians} | {seconds:.1f} |", flush=True)
            with open(out, "rb") as file:
                content = file.read()
            first = first or content
            if content != first:
                raise scripting.Failure(f"{name}: another table")


def timed(work):
    start = time.monotonic()
    return work(), time.monotonic() - start


def size_of_scan(options, name):
    """Bytes of all files that are read for an image of a BOP dataset."""
    scene, image = name.split("/")
    folder = os.path.join(options.scans, options.split, scene)
    return sum(os.path.getsize(os.path.join(folder, kind, image + ".png")) for kind in ("depth", "gray", "rgb")
               if os.path.exists(os.path.join(folder, kind, image + ".png")))


def costs(options, folder):
    """What is beside the search."""
    options.threads = 1
    source = scans.source(options)
    rows, listing = timed(source.list)
    search, loading = timed(lambda: run.Search(options, Plan(options.model), [options.model]))
    lines = [search.line(row) for row in rows]
    texts = [json.dumps(line) + "\n" for line in lines]
    journal = os.path.join(folder, "lines")
    with open(journal, "w", encoding="utf-8") as file:
        file.writelines(texts)
    by_name = {line["scan"]: line for line in lines}
    _, writing = timed(lambda: table.write(os.path.join(folder, "t.csv"), list(by_name), by_name))
    _, parsing = timed(lambda: [json.loads(text) for text in texts])
    count = len(rows)
    finding = [float(line["find_s"]) for line in lines]
    print(f"model: {os.path.getsize(options.model) / 1e6:.1f} MB, read in {loading:.2f} s, and taken over by the first "
          f"scan, which takes {finding[0] - statistics.median(finding[1:]):.2f} s longer")
    print(f"scan: {statistics.mean(size_of_scan(options, row[0]) for row in rows) / 1e6:.2f} MB, read in "
          f"{statistics.median(float(line['read_s']) for line in lines):.3f} s")
    print(f"list: {1e6 * listing / count:.0f} us and {len(pickle.dumps(rows)) / count:.0f} bytes a scan")
    print(f"journal: {os.path.getsize(journal) / count:.0f} bytes a scan, read again in {1e6 * parsing / count:.0f} us")
    written = sum(os.path.getsize(os.path.join(folder, name)) for name in ("t.csv", "t.scans.csv"))
    print(f"tables: {written / count:.0f} bytes and {1e6 * writing / count:.0f} us a scan")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("scans", metavar="DATASET")
    parser.add_argument("model", metavar="MODEL")
    parser.add_argument("--repeat", type=int, default=3, help="runs of each kind, in turn (default: %(default)s)")
    parser.set_defaults(split="test", preset="recommended", features="both", poses=5, probability=0, references=0)
    options = parser.parse_args()
    with tempfile.TemporaryDirectory() as folder:
        throughput(options, folder)
        costs(options, folder)


scripting.run(main)
