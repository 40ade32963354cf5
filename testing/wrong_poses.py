#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Where the five best poses of the original pair feature (preset OriginalPPF) and of the preset Paper go: on scenes of the Tohoku
dataset, in simulated bins, and in the same bins when the bin itself is taken out of the scan; of the pair feature also when its
candidates are judged by what the scene shows of the part (VisibleEvidence) in place of their votes.

  testing/wrong_poses.py DATASET BINS [SCENES]     with build/release/env.sh sourced; BINS keeps the simulated bins
"""
import sys

import numpy
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkCommonDataModel import vtkPolyData, vtkStructuredGrid

from ppfmeam import chains, evaluation, filters, paper, scripting, simulation

POSES = 5
HALF_TURN = 150  # degrees
METHODS = ("original PPF", "original PPF, judged by evidence", "PPF-MEAM as in the paper")
WHERE = ("right", "half a turn", "another turn", "on the bin", "elsewhere", "missing")


class Judged(evaluation.Evaluation):
    """The steps of the preset OriginalPPF, but for what judges the candidates."""

    def __init__(self, model):
        super().__init__(model, "ppf", POSES)
        self.chain = chains.Detection(model, preset="ppf")
        for step in (self.chain.candidates, self.chain.verification):
            step.SetMethodToVisibleEvidence()

    def find(self, surface, edges=None):
        if edges is None:
            extraction = filters.vtkMEAMSceneEdgeExtraction()
            extraction.SetInputDataObject(surface)
            edges = scripting.update(extraction).GetOutput()
        self.chain.set_scene(edges, surface)
        poses = vtkPolyData()
        poses.ShallowCopy(scripting.update(self.chain.selection).GetOutput())
        return poses


def without_bin(scan):
    """The scan with nothing but the parts."""
    result = vtkStructuredGrid()
    result.DeepCopy(scan)
    vtk_to_numpy(result.GetPoints().GetData())[vtk_to_numpy(scan.GetPointData().GetArray("Instance")) < 0] = numpy.nan
    return result


def is_on_bin(vertices, transform, scan):
    """Whether the bin is what the sensor sees at most of the part's vertices at a pose."""
    size = [0, 0, 0]
    scan.GetDimensions(size)
    fx, _, cx, _, fy, cy, _, _, _ = scan.GetFieldData().GetArray("CameraMatrix").GetTuple(0)
    x, y, z = (vertices @ transform[:3, :3].T + transform[:3, 3]).T
    column, row = (numpy.rint(value).astype(int) for value in (fx * x / z + cx, fy * y / z + cy))
    inside = (column >= 0) & (row >= 0) & (column < size[0]) & (row < size[1])
    seen = vtk_to_numpy(scan.GetPointData().GetArray("Instance"))[row[inside] * size[0] + column[inside]]
    return bool(inside.any()) and (seen < 0).mean() > 0.5


def count(run, poses, truth, mesh, scan):
    """Of the best poses of a scene how many go where; `scan`: with the bin, or None."""
    run.add(poses, truth)
    outcomes, turns = (run.judged(name)[-poses.GetNumberOfPoints():][:POSES] if poses.GetNumberOfPoints() else []
                       for name in ("Outcome", "RotationError"))
    vertices = vtk_to_numpy(mesh.GetPoints().GetData()).astype(float)
    where = dict.fromkeys(WHERE, 0)
    for k, (outcome, turn) in enumerate(zip(outcomes, turns)):
        transform = numpy.array(poses.GetPointData().GetArray("Transform").GetTuple(k)).reshape(4, 4)
        where["right" if outcome == 0 else
              ("half a turn" if turn > HALF_TURN else "another turn") if outcome == 2 else
              "on the bin" if scan and is_on_bin(vertices, transform, scan) else "elsewhere"] += 1
    where["missing"] = POSES - len(outcomes)
    return where


def main():
    data, bins, *scenes = sys.argv[1:]
    scenes = int(scenes[0]) if scenes else 5
    print("| scenes | method | " + " | ".join(WHERE) + " |\n|" + "---|" * (2 + len(WHERE)))
    simulated = simulation.Bins(paper.COPIES, bins)

    def scene_of(part, number):
        if part.startswith("tohoku"):
            return *evaluation.tohoku_clouds(data, int(part[-1]), number), evaluation.tohoku_truth(data, int(part[-1]), number)
        scan, truth = simulated.scene(part, simulation.SENSORS[0], number + 1)
        return scan, None, truth

    for name, parts, without in (("Tohoku dataset", [f"tohoku_{part}" for part in (1, 2, 3)], False), ("bins", paper.PARTS, False),
                                 ("bins, the bin taken out", paper.PARTS, True)):
        totals = [dict.fromkeys(WHERE, 0) for _ in METHODS]
        for part in parts:
            mesh = evaluation.tohoku_mesh(data, int(part[-1])) if part.startswith("tohoku") else simulation.part_mesh(part)
            model, of_paper = (scripting.Training(mesh, method).model() for method in ("ppf", "paper"))
            runs = evaluation.Evaluation(model, "ppf", POSES), Judged(model), evaluation.Evaluation(of_paper, "paper", POSES)
            for total, run in zip(totals, runs):
                for number in range(scenes):
                    surface, edges, truth = scene_of(part, number)
                    measured = without_bin(surface) if without else surface
                    poses = run.find(measured, edges)
                    for where, times in count(run, poses, truth, mesh, surface if edges is None else None).items():
                        total[where] += times
        for words, total in zip(METHODS, totals):
            asked = POSES * scenes * len(parts)
            print(f"| {name} | {words} | " + " | ".join(f"{100 * times / asked:.0f} %" for times in total.values()) + " |", flush=True)


scripting.run(main)
