#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""How many pixels a part needs: one copy of it alone in a simulated bin, by the pitch of the pixels on it and by sensor.

  testing/resolution.py CAD SCALE BINS PITCH...     with build/release/env.sh sourced; SCALE to mm, pitches in mm
"""
import sys

from ppfmeam import evaluation, filters, scripting, simulation

SENSORS = ("structured-light", "time-of-flight")
BIN = 6  # diameters of the part, the bin's side
VIEW = 1.1  # sides of the bin, what the sensor sees across: the bin's rim is nearer than its floor


def scene(mesh, sensor, side, pixels, seed):
    source = filters.vtkMEAMBinSceneSource()
    source.SetInputDataObject(mesh)
    source.SetCopies(1)
    source.SetSeed(seed)
    source.SetBinSize(side)
    source.SetWidth(pixels)
    source.SetHeight(pixels)
    simulation.set_sensor(source, sensor)
    scripting.update(source)
    return source.GetOutput(), source.GetOutputDataObject(1)


def main():
    cad, scale, bins, *pitches = sys.argv[1:]
    bins = int(bins)
    mesh = scripting.read_mesh(cad, scale=float(scale))
    model = scripting.train(mesh)
    diameter = scripting.field(model, "Diameter")
    print("| pitch | pixels along the part | " + " | ".join(SENSORS) + " |\n|" + "---|" * (2 + len(SENSORS)))
    for pitch in map(float, pitches):
        cells = []
        for sensor in SENSORS:
            run = evaluation.Evaluation(model, poses_asked_for=1, mesh=mesh)
            for seed in range(1, bins + 1):
                scan, truth = scene(mesh, sensor, BIN * diameter, round(VIEW * BIN * diameter / pitch), seed)
                run.add(run.find(scan), truth)
            figures = run.figures()
            cells.append(f"{figures['top1']:.0f} % ({figures['recall']:.0f} %)")
        print(f"| {pitch:g} mm | {diameter / pitch:.0f} | " + " | ".join(cells) + " |", flush=True)


scripting.run(main)
