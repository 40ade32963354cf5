# SPDX-License-Identifier: BSD-3-Clause
"""What the stages have to do in simulated bins, and in a real scan, against the last release: counts, which no machine and no load
changes. testing/benchmarks/history.csv has the counts of each release; TestWork.py VERSION adds those of a new one."""
import csv
import os
import sys

from ppfmeam import filters, scripting
from meamtest import check, connect, field

sys.path.append(os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "evaluation"))
import scenes

HISTORY = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "benchmarks", "history.csv")
COUNTS = ("References", "Screened", "Verified", "Refined", "Selected")
MORE = 1.15  # than in the last release: other compilers roll the dice of a simulated bin a little differently


def searches():
    """Name, part and scan of each."""
    for part, seed in (("ridged_disc", 71), ("flap", 72), ("knob", 73)):
        mesh = scenes.part_mesh(part)
        scan, = scenes.outputs_of(scenes.bin_source(mesh, 12, seed, Width=640, Height=512), 0)
        yield part, mesh, scan
    pipes = os.path.join(os.environ.get("PPFMEAM_DATA", ""), "pipes")
    if os.path.isdir(pipes):
        yield "pipes", scripting.read_mesh(os.path.join(pipes, "elbow.stl")), scripting.read_scan(os.path.join(pipes, "90_real_2.pcd"))


def counts_of(model, scan, most):
    estimation = connect(filters.vtkMEAMPoseEstimation(), model, scan, MaximumNumberOfPoses=most)
    found = scripting.update(estimation).GetOutput()
    return [int(field(found, "Work" + name)[0][0]) for name in COUNTS]


rows = {}
for name, mesh, scan in searches():
    model = scripting.train(mesh)
    for most in (5, 0):
        rows[name, str(most)] = counts_of(model, scan, most)
        print(f"{name:12s} {'all' if most == 0 else most}: " + ", ".join(f"{c} {n.lower()}" for n, c in zip(COUNTS, rows[name, str(most)])))

with open(HISTORY, newline="", encoding="utf-8") as file:
    known = {(row["scene"], row["asked"]): [int(row[name.lower()]) for name in COUNTS] for row in csv.DictReader(file)}  # the last of each
if len(sys.argv) > 1:
    with open(HISTORY, "a", newline="", encoding="utf-8") as file:
        csv.writer(file, lineterminator="\n").writerows([sys.argv[1], *key, *counts] for key, counts in rows.items())
for key, counts in rows.items():
    for name, count, before in zip(COUNTS, counts, known.get(key, counts)):
        check(count <= MORE * before, f"{key}: {count} {name.lower()}, {before} in the last release (testing/benchmarks/history.csv)")
check(len(sys.argv) > 1 or all(key in known for key in rows), "each search has a row in testing/benchmarks/history.csv")
