# SPDX-License-Identifier: BSD-3-Clause
"""ablation.py: with nothing switched off the poses are those of the filter for all, each switch names what
it changes, and a run that was stopped goes on."""
import csv
import os
import subprocess
import sys
import tempfile

import numpy

from ppfmeam import filters, scripting

HERE = os.path.dirname(os.path.abspath(__file__))
SWITCHES = ("none", "screening", "alignment", "edges", "near")


def check(right, words):
    if not right:
        sys.exit(words)


def ablation(*words):
    done = subprocess.run([sys.executable, os.path.join(HERE, "ablation.py"), "--out", "out", "--scenes", "scenes", *words],
                          stdout=subprocess.PIPE, text=True, check=True)
    with open("out/rows.csv", encoding="utf-8", newline="") as file:
        return list(csv.DictReader(file)), done.stdout


with tempfile.TemporaryDirectory() as folder:
    os.chdir(folder)
    rows, table = ablation("--world", "sensors", "--most", "1", "--switch", *SWITCHES[:-1])
    check([row["switch"] for row in rows] == list(SWITCHES[:-1]), f"{rows}")
    half = int(rows[0]["copies"])
    check(half > 5 and int(rows[0]["found"]) > 0.8 * half and float(rows[0]["seconds"]) > 0.05, f"{rows[0]}")
    poses = {row["switch"]: row["poses"] for row in rows}
    check(len(set(poses.values())) == len(poses), f"two switches find the same: {poses}")
    again, table = ablation("--world", "sensors", "--most", "1", "--switch", *SWITCHES)
    check(again[:-1] == rows and again[-1]["switch"] == SWITCHES[-1], "a second run measures what the first one did")
    check(table.count("\n| `") == len(SWITCHES), table)

    # The same scan by the filter.
    source = filters.vtkMEAMBinSceneSource()
    source.SetSeed(801)
    scripting.update(source)
    scan, mesh = (source.GetOutputDataObject(port) for port in (0, 2))
    estimation = filters.vtkMEAMPoseEstimation()
    estimation.SetInputDataObject(0, scripting.train(mesh))
    estimation.SetInputDataObject(1, scan)
    estimation.SetMaximumNumberOfPoses(0)
    found = scripting.update(estimation).GetOutput()
    known = [float(pose[:-2]) for pose in rows[0]["poses"].split()]
    check(numpy.allclose(scripting.column(found, "Probability"), known, rtol=0, atol=1e-6), "the filter finds other poses")
