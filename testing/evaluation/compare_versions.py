#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Compares the poses and the times of two versions of this program.

  compare_versions.py poses OUT.json [--bins DIR] [--threads N]     with the environment of each version in turn
  compare_versions.py compare OLD.json NEW.json

`poses` runs the 60 scenes of the Tohoku dataset (in $PPFMEAM_DATA) and two simulated bins of each of seven parts, 1280 x 1024
points, and writes all poses, the figures and the times. The bins are simulated once and kept in DIR, so that both versions see
the same. `compare` tells how many poses are the same to the last bit, how far the likely ones (more than 0.9) are from the
nearest of the other version, and the figures and median times of both. Between versions that are timed, run `poses` alternately:
the files of several runs, joined by commas, count together."""
import argparse
import json
import math
import os
import statistics
import sys
import time

from vtkmodules.vtkIOXML import vtkXMLPolyDataReader, vtkXMLPolyDataWriter, vtkXMLStructuredGridReader, vtkXMLStructuredGridWriter

from ppfmeam import evaluation, scripting

import scenes

DATA = os.environ.get("PPFMEAM_DATA", "")
PARTS = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", "examples", "parts")
BINS = {**{name: (os.path.join(PARTS, name + ".stl"), 1) for name in ("ridged_disc", "arc_lever", "flap", "hole_plate")},
        **{name: (os.path.join(DATA, "cad", name + extension), scale)
           for name, extension, scale in (("gear", ".ply", 1), ("assembly_regulator_collision", ".stl", 1000),
                                          ("small", ".ply", 1000))}}
SEEDS = (1, 2)
LIKELY = 0.9  # the probability from which on poses have to stay where they are
NEAR = (0.01, 0.01)  # mm, degrees


def tohoku():
    """Name, mesh, and the scenes of each part: surface, edge points, true poses."""
    folder = os.path.join(DATA, "tohoku")
    for part in scenes.TOHOKU:
        mesh = scenes.tohoku_mesh(folder, part)
        model = scripting.train(mesh)
        yield f"Part_{part}", mesh, [scenes.tohoku_scene(folder, part, number, model) for number in range(20)]


def simulated(folder):
    """The same of the bins, which are kept in a folder; they have no edge points."""
    os.makedirs(folder, exist_ok=True)
    for name, (path, scale) in BINS.items():
        mesh, found = scripting.read_mesh(path, scale=scale), []
        for seed in SEEDS:
            paths = [os.path.join(folder, f"{name}_{seed}{ending}") for ending in (".vts", ".vtp")]
            if not all(map(os.path.exists, paths)):
                outputs = scenes.outputs_of(scenes.bin_source(mesh, 20, seed, Width=1280, Height=1024), 0, 1)
                for writer, path, data in zip((vtkXMLStructuredGridWriter(), vtkXMLPolyDataWriter()), paths, outputs):
                    writer.SetInputDataObject(data)
                    writer.SetDataModeToBinary()
                    scripting.write_by(writer, path)
            scan, truth = (scripting.read_with(reader(), path)
                           for reader, path in zip((vtkXMLStructuredGridReader, vtkXMLPolyDataReader), paths))
            found.append((scan, None, truth))
        yield name, mesh, found


def tuples(data, name):
    array = data.GetPointData().GetArray(name)
    return [array.GetTuple(i) for i in range(array.GetNumberOfTuples())]


def stage_times(poses):
    """The ms of each stage that this version tells."""
    fields = poses.GetFieldData()
    names = [fields.GetArrayName(i) for i in range(fields.GetNumberOfArrays())]
    return {name[7:]: 1000 * scripting.field(poses, name) for name in names if name.startswith("Seconds")
            and name != "SecondsTraining"}


def run(name, mesh, places, threads):
    """All poses of a part's scenes, the figures over them, and the times in ms."""
    of_all = evaluation.Evaluation(scripting.train(mesh), threads=threads)
    of_all.estimation.SetInputDataObject(0, mesh)  # trained by the first scene, as a user's CAD is
    found = []
    for surface, edges, truth in places:
        if not found:
            of_all.find(surface, edges)
            of_all.estimation.Modified()
        start = time.perf_counter()
        poses = of_all.find(surface, edges)
        wall = 1000 * (time.perf_counter() - start)
        of_all.add(poses, truth)
        found.append({"transforms": tuples(poses, "Transform"), "probabilities": [p for p, in tuples(poses, "Probability")],
                      "scores": [s for s, in tuples(poses, "Score")], "wall": wall, "ms": stage_times(poses)})
    figures = of_all.figures()
    ms = statistics.median(r["wall"] for r in found)
    print(f"{name:30s} strict {figures['strict']:5.1f}  recall {figures['recall']:5.1f}  {ms:6.0f} ms",
          file=sys.stderr)
    return {"figures": {"StrictRate": figures["strict"], "Recall": figures["recall"]}, "scenes": found}


def error(a, b):
    """mm and degrees between two transforms."""
    trace = sum(a[4 * i + k] * b[4 * i + k] for i in range(3) for k in range(3))
    # From the sine of half the angle: a cosine near 1 tells nothing.
    squares = sum((a[4 * i + k] - b[4 * i + k]) ** 2 for i in range(3) for k in range(3))
    angle = 2 * math.degrees(math.asin(min(1.0, math.sqrt(squares / 8)))) if trace > 0 else 180.0
    return math.dist((a[3], a[7], a[11]), (b[3], b[7], b[11])), angle


def load(names):
    """The first run of some, with the median times of all."""
    runs = []
    for name in names.split(","):
        with open(name, encoding="utf-8") as file:
            runs.append(json.load(file))
    for part, result in runs[0].items():
        for i, scene in enumerate(result["scenes"]):
            of_all = [other[part]["scenes"][i] for other in runs]
            scene["wall"] = statistics.median(one["wall"] for one in of_all)
            scene["ms"] = {stage: statistics.median(one["ms"][stage] for one in of_all) for stage in scene["ms"]}
    return runs[0]


def compare(old, new):
    totals = [0] * 4
    print(f"{'part':30s} poses   same  likely   near  strict old  new  recall old  new   ms old   new ratio  stages old  new")
    for part, before in old.items():
        after, row = new[part], [0] * 4
        for one, other in zip(before["scenes"], after["scenes"]):
            row[0] += len(one["transforms"])
            known = set(map(tuple, other["transforms"]))
            row[1] += sum(tuple(t) in known for t in one["transforms"])
            for transform, probability in zip(one["transforms"], one["probabilities"]):
                if probability > LIKELY:
                    row[2] += 1
                    row[3] += any(mm <= NEAR[0] and degrees <= NEAR[1]
                                  for mm, degrees in (error(transform, t) for t in other["transforms"]))
        def median(result, of):
            return statistics.median(of(scene) for scene in result["scenes"])
        walls = [median(result, lambda scene: scene["wall"]) for result in (before, after)]
        stages = [median(result, lambda scene: sum(ms for stage, ms in scene["ms"].items() if stage not in ("Output", "Total")))
                  for result in (before, after)]
        print(f"{part:30s} {row[0]:5d}  {row[1]:5d}   {row[2]:5d}  {row[3]:5d}      {before['figures']['StrictRate']:6.1f}"
              f" {after['figures']['StrictRate']:5.1f}    {before['figures']['Recall']:6.1f} {after['figures']['Recall']:5.1f}"
              f"   {walls[0]:6.0f} {walls[1]:5.0f} {walls[1] / walls[0]:5.2f}      {stages[0]:6.0f} {stages[1]:5.0f}")
        totals = [total + value for total, value in zip(totals, row)]
    print(f"{totals[1]} of {totals[0]} poses are the same; {totals[3]} of {totals[2]} likely ones "
          f"({100 * totals[3] / max(totals[2], 1):.2f} %) are within {NEAR[0]} mm and {NEAR[1]} degrees")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    commands = parser.add_subparsers(dest="command", required=True)
    for name, files in (("poses", ("out",)), ("compare", ("old", "new"))):
        one = commands.add_parser(name)
        for file in files:
            one.add_argument(file)
        if name != "compare":
            one.add_argument("--bins", metavar="DIR", default="bins",
                             help="where the simulated bins are kept (default: %(default)s)")
            one.add_argument("--threads", type=int, default=2)
            one.add_argument("--parts", help="names, joined by commas (default: all)")
    options = parser.parse_args()
    if options.command == "compare":
        compare(load(options.old), load(options.new))
    else:
        found = {name: run(name, mesh, places, options.threads) for source in (tohoku(), simulated(options.bins))
                 for name, mesh, places in source
                 if not options.parts or name in options.parts.split(",")}
        with open(options.out, "w", encoding="utf-8") as file:
            json.dump(found, file)


main()
