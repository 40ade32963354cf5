#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""How many pixels a part needs: one copy of it alone in a simulated bin, by the pitch of the pixels on it and by sensor. first:
the first pose is right, recall: one of all is, %."""
from ppfmeam import evaluation, scripting

import results
from scenes import bin_source, outputs_of

SENSORS = ("structured-light", "time-of-flight")
BIN = 6  # diameters of the part, the bin's side
VIEW = 1.1  # sides of the bin, what the sensor sees across: the bin's rim is nearer than its floor


def pitches_of(text):
    return [float(one) for one in text.split(",")]


def measure(cad, cad_scale=1.0, bins=10, pitches: pitches_of = [5, 2.5, 1.25, 0.6]):
    mesh, rows = scripting.read_mesh(cad, scale=cad_scale), []
    model = scripting.train(mesh)
    diameter = scripting.field(model, "Diameter")
    for pitch in pitches:
        pixels = round(VIEW * BIN * diameter / pitch)
        for sensor in SENSORS:
            run = evaluation.Evaluation(model, poses_asked_for=1, mesh=mesh)
            for seed in range(1, bins + 1):
                scan, truth = outputs_of(bin_source(mesh, 1, seed, sensor, BinSize=BIN * diameter, Width=pixels, Height=pixels),
                                         0, 1)
                run.add(run.find(scan), truth)
            figures = run.figures()
            rows.append({"pitch, mm": pitch, "pixels along the part": round(diameter / pitch), "sensor": sensor, "bins": bins,
                         "first": figures["top1"],
                         "recall": figures["recall"]})
    return rows


if __name__ == "__main__":
    results.command(measure, cad="CAD file of the part", cad_scale="factor to mm", pitches="of the pixels, mm")
