#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""How the time grows with the pixels of a scan, with the poses asked for and with the threads: the same bins seen by sensors of more
and more pixels. first: the first five poses that are right, %; ms: median, without training."""
import statistics

from ppfmeam import evaluation, scripting

import results
from scenes import bin_source, outputs_of

WIDTHS = (640, 960, 1280, 1920, 2560)
HEIGHT = 0.8  # of the width
KINDS = [(asked, threads) for asked in (5, 0) for threads in (1, 2)]  # 0: all poses


def measure(cad, cad_scale=1.0, copies=20, bins=3, seed=1, repeat=2):
    mesh, rows = scripting.read_mesh(cad, scale=cad_scale), []
    model = scripting.train(mesh)
    for width in WIDTHS:
        height = round(HEIGHT * width)
        seen = [outputs_of(bin_source(mesh, copies, number, Width=width, Height=height), 0, 1) for number in range(seed, seed + bins)]
        for asked, threads in KINDS:
            run = evaluation.Evaluation(model, poses_asked_for=5, threads=threads)
            run.estimation.SetMaximumNumberOfPoses(asked)
            for scan, truth in repeat * seen:
                run.add(run.find(scan), truth)
            rows.append({"width": width, "height": height, "megapixels": width * height / 1e6, "asked": asked or "all",
                         "threads": threads, "first": run.figures()["strict"],
                         "ms": statistics.median(times["Total"] - times["Training"] for times in run.times)})
    return rows


if __name__ == "__main__":
    results.command(measure, cad="CAD file of the part", cad_scale="factor to mm", seed="of the first bin", bins="bins",
                    repeat="times that each is searched")
