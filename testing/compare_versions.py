#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Compares the poses and the times of two versions of this program.

  compare_versions.py poses OUT.json [--bins DIR] [--threads N]     with the environment of each version in turn
  compare_versions.py compare OLD.json NEW.json
  compare_versions.py chain [--bins DIR] [--threads N]              the single filters against the one filter for all

`poses` runs the 60 scenes of the Tohoku dataset (in $PPFMEAM_DATA) and two simulated bins of each of seven parts,
1280 x 1024 points, and writes all poses, the figures and the times. The bins are simulated once and kept in DIR, so that
both versions see the same. `compare` tells how many poses are the same to the last bit, how far the likely ones (more than
0.9) are from the nearest of the other version, and the figures and median times of both. Between versions that are
timed, run `poses` alternately: the files of several runs, joined by commas, count together. `chain` tells whether the chain
of single filters returns the same poses as vtkMEAMPoseEstimation, and in how many times its time.
"""
import argparse
import json
import math
import os
import statistics
import sys
import time

from vtkmodules.vtkIOGeometry import vtkOBJReader, vtkSTLReader
from vtkmodules.vtkIOPLY import vtkPLYReader
from vtkmodules.vtkIOXML import (vtkXMLPolyDataReader, vtkXMLPolyDataWriter, vtkXMLStructuredGridReader,
                                 vtkXMLStructuredGridWriter)

from ppfmeam import evaluation, filters, scripting

DATA = os.environ.get("PPFMEAM_DATA", "")
PARTS = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "examples", "parts")
OFFSETS = {3: (-20.9645, -17.4974, -9.3144)}  # mm: that part's STL is in another frame than its true poses
BINS = {"ridged_disc": (PARTS, ".stl", 1), "arc_lever": (PARTS, ".stl", 1), "flap": (PARTS, ".stl", 1),
        "hole_plate": (PARTS, ".stl", 1), "gear": (os.path.join(DATA, "cad"), ".ply", 1),
        "assembly_regulator_collision": (os.path.join(DATA, "cad"), ".stl", 1000),
        "small": (os.path.join(DATA, "cad"), ".ply", 1000)}
SEEDS = (1, 2)
READERS = {".stl": vtkSTLReader, ".ply": vtkPLYReader, ".obj": vtkOBJReader}
LIKELY = 0.9  # the probability from which on poses have to stay where they are
NEAR = (0.01, 0.01)  # mm, degrees


def read(reader, path):
    reader.SetFileName(path)
    reader.Update()
    return reader.GetOutput()


def mesh_of(path, scale=1, offset=(0, 0, 0)):
    preparation = filters.vtkMEAMMeshPreparation()
    preparation.SetInputDataObject(read(READERS[os.path.splitext(path)[1].lower()](), path))
    preparation.SetScale(scale)
    preparation.SetOffset(offset)
    preparation.Update()
    return preparation.GetOutput()


def tohoku():
    """Name, mesh, and the scenes of each part: surface, edge points, true poses."""
    for part in (1, 2, 3):
        folder = os.path.join(DATA, "tohoku", f"Part_{part}")
        mesh = mesh_of(os.path.join(folder, f"Part_{part}.STL"), offset=OFFSETS.get(part, (0, 0, 0)))
        scenes = [(read(filters.vtkMEAMPCDReader(), os.path.join(folder, "Scenes", f"Scene{i}.pcd")),
                   read(filters.vtkMEAMPCDReader(), os.path.join(folder, "Scenes", f"Scene_boundary{i}.pcd")),
                   read(filters.vtkMEAMPoseReader(), os.path.join(folder, "Results", f"trans{i}.txt"))) for i in range(20)]
        model = scripting.train(mesh)
        yield f"Part_{part}", mesh, [(surface, edges, evaluation.with_visibility(truth, model, edges, surface))
                                     for surface, edges, truth in scenes]


def simulated(folder):
    """The same of the bins, which are kept in a folder; they have no edge points."""
    os.makedirs(folder, exist_ok=True)
    for name, (place, extension, scale) in BINS.items():
        mesh = mesh_of(os.path.join(place, name + extension), scale)
        scenes = []
        for seed in SEEDS:
            paths = [os.path.join(folder, f"{name}_{seed}{ending}") for ending in (".vts", ".vtp")]
            if not all(map(os.path.exists, paths)):
                source = filters.vtkMEAMBinSceneSource()
                source.SetInputDataObject(mesh)
                source.SetSeed(seed)
                source.SetWidth(1280)
                source.SetHeight(1024)
                source.Update()
                for port, (writer, path) in enumerate(zip((vtkXMLStructuredGridWriter(), vtkXMLPolyDataWriter()), paths)):
                    writer.SetInputDataObject(source.GetOutputDataObject(port))
                    writer.SetFileName(path)
                    writer.SetDataModeToBinary()
                    writer.Write()
            scenes.append((read(vtkXMLStructuredGridReader(), paths[0]), None, read(vtkXMLPolyDataReader(), paths[1])))
        yield name, mesh, scenes


def tuples(data, name):
    array = data.GetPointData().GetArray(name)
    return [array.GetTuple(i) for i in range(array.GetNumberOfTuples())]


def number(data, name):
    return data.GetFieldData().GetArray(name).GetValue(0)


def stage_times(poses):
    """The ms of each stage that this version tells."""
    fields = poses.GetFieldData()
    names = [fields.GetArrayName(i) for i in range(fields.GetNumberOfArrays())]
    return {name[7:]: 1000 * number(poses, name) for name in names if name.startswith("Seconds") and name != "SecondsTraining"}


def run(name, mesh, scenes, threads):
    """All poses of a part's scenes, the figures over them, and the times in ms."""
    estimation, judge = filters.vtkMEAMPoseEstimation(), filters.vtkMEAMPoseEvaluation()
    estimation.SetInputDataObject(mesh)
    estimation.SetMaximumNumberOfPoses(0)
    estimation.SetNumberOfThreads(threads)
    judge.SetPosesAskedFor(5)
    samples, symmetries = filters.vtkMEAMSurfaceSampling(), filters.vtkMEAMSymmetryDetection()
    samples.SetInputDataObject(mesh)
    symmetries.SetInputConnection(samples.GetOutputPort())
    judge.SetInputConnection(2, symmetries.GetOutputPort())
    results = []
    for surface, edges, truth in scenes:
        estimation.SetInputDataObject(1, surface)
        estimation.SetInputDataObject(2, edges)
        if not results:
            estimation.Update()  # training
            estimation.Modified()
        start = time.perf_counter()
        estimation.Update()
        wall = 1000 * (time.perf_counter() - start)
        poses = estimation.GetOutput().NewInstance()
        poses.ShallowCopy(estimation.GetOutput())
        judge.SetDiameter(number(poses, "Diameter"))
        judge.AddInputDataObject(0, poses)
        judge.AddInputDataObject(1, truth)
        results.append({"transforms": tuples(poses, "Transform"), "probabilities": [p for p, in tuples(poses, "Probability")],
                        "scores": [s for s, in tuples(poses, "Score")], "wall": wall,
                        "ms": stage_times(poses)})
    judge.Update()
    figures = {figure: number(judge.GetOutput(), figure) for figure in ("StrictRate", "Recall")}
    print(f"{name:30s} strict {figures['StrictRate']:5.1f}  recall {figures['Recall']:5.1f}  "
          f"{statistics.median(r['wall'] for r in results):6.0f} ms", file=sys.stderr)
    return {"figures": figures, "scenes": results}


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
    same = near = likely = 0
    print(f"{'part':30s} poses   same  likely   near  strict old  new  recall old  new   ms old   new ratio  stages old  new")
    for part, before in old.items():
        after, row = new[part], [0, 0, 0, 0]
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
        stages = [median(result, lambda scene: sum(ms for stage, ms in scene["ms"].items() if stage not in ("Output", "Total"))) for result in (before, after)]
        print(f"{part:30s} {row[0]:5d}  {row[1]:5d}   {row[2]:5d}  {row[3]:5d}      {before['figures']['StrictRate']:6.1f}"
              f" {after['figures']['StrictRate']:5.1f}    {before['figures']['Recall']:6.1f} {after['figures']['Recall']:5.1f}"
              f"   {walls[0]:6.0f} {walls[1]:5.0f} {walls[1] / walls[0]:5.2f}      {stages[0]:6.0f} {stages[1]:5.0f}")
        same, likely, near = same + row[1], likely + row[2], near + row[3]
    count = sum(len(scene["transforms"]) for part in old.values() for scene in part["scenes"])
    print(f"{same} of {count} poses are the same; {near} of {likely} likely ones ({100 * near / max(likely, 1):.2f} %) are within "
          f"{NEAR[0]} mm and {NEAR[1]} degrees")


def chain(sources, threads):
    """The scan of each bin through the single filters, and through the one filter, alternately."""
    from ppfmeam import chains
    for name, mesh, scenes in sources:
        model = scripting.train(mesh)
        scan = scenes[0][0]
        box = filters.vtkMEAMPoseEstimation()
        edges = filters.vtkMEAMSceneEdgeExtraction()
        edges.SetInputDataObject(scan)
        edges.SetNumberOfThreads(threads)
        steps = chains.Detection(model, edges, scan, threads=threads)
        box.SetInputDataObject(0, model)
        box.SetInputDataObject(1, scan)
        box.SetMaximumNumberOfPoses(0)
        box.SetNumberOfThreads(threads)
        times = {box: [], steps.selection: []}
        for _ in range(5):
            for last in times:
                scan.GetPoints().GetData().Modified()  # a new scan: nothing of it is known
                scan.Modified()
                start = time.perf_counter()
                last.Update()
                times[last].append(1000 * (time.perf_counter() - start))
        same = tuples(box.GetOutput(), "Transform") == tuples(steps.selection.GetOutput(), "Transform")
        one, other = (statistics.median(of) for of in times.values())
        print(f"{name:30s} one filter {one:6.0f} ms, chain {other:6.0f} ms, {other / one:5.2f}; "
              f"{'the same poses' if same else 'OTHER POSES'}", flush=True)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    commands = parser.add_subparsers(dest="command", required=True)
    one = commands.add_parser("poses")
    one.add_argument("out")
    one.add_argument("--bins", metavar="DIR", default="bins", help="where the simulated bins are kept (default: %(default)s)")
    one.add_argument("--threads", type=int, default=2)
    one.add_argument("--parts", help="names, joined by commas (default: all)")
    one = commands.add_parser("compare")
    one.add_argument("old")
    one.add_argument("new")
    one = commands.add_parser("chain")
    one.add_argument("--bins", metavar="DIR", default="bins")
    one.add_argument("--threads", type=int, default=2)
    options = parser.parse_args()
    if options.command == "compare":
        compare(load(options.old), load(options.new))
        return
    if options.command == "chain":
        chain(simulated(options.bins), options.threads)
        return
    results = {}
    for source in (tohoku(), simulated(options.bins)):
        for name, mesh, scenes in source:
            if not options.parts or name in options.parts.split(","):
                results[name] = run(name, mesh, scenes, options.threads)
    with open(options.out, "w", encoding="utf-8") as file:
        json.dump(results, file)


main()
