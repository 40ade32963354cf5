#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Where the five best poses of the original pair feature (preset OriginalPPF) and of the preset Paper go, in %: on scenes of the
Tohoku dataset, in simulated bins, and in the same bins when the bin itself is taken out of the scan; of the pair feature also
when its candidates are judged by what the scene shows of the part (VisibleEvidence) in place of their votes. half a turn: right
place, turned by more than 150 degrees; on the bin: most of the part's vertices are where the sensor sees the bin."""
from vtkmodules.util.numpy_support import vtk_to_numpy

from ppfmeam import evaluation, scripting, simulation

import chains
import paper
import results
import scenes as sources

HALF_TURN = 150  # degrees
METHODS = ("original PPF", "original PPF, judged by evidence", "PPF-MEAM as in the paper")
WHERE = ("right", "half a turn", "another turn", "on the bin", "elsewhere", "missing")
KINDS = ("Tohoku dataset", "bins", "bins, the bin taken out")


def by_evidence(chain):
    for step in (chain.candidates, chain.verification):
        step.SetMethodToVisibleEvidence()


def is_on_bin(vertices, transform, scan):
    """Whether the bin is what the sensor sees at most of the part's vertices at a pose."""
    column, row, inside = sources.pixels_of(vertices @ transform[:3, :3].T + transform[:3, 3], scan)
    seen = vtk_to_numpy(scan.GetPointData().GetArray("Instance"))[row[inside] * scan.GetDimensions()[0] + column[inside]]
    return bool(inside.any()) and (seen < 0).mean() > 0.5


def places_of(run, poses, truth, mesh, scan):
    """Where the best poses of a scene go; `scan`: with the bin, or None."""
    run.add(poses, truth)
    count = poses.GetNumberOfPoints()
    outcomes, turns = (run.judged(name)[-count:][:paper.POSES] if count else [] for name in ("Outcome", "RotationError"))
    vertices = vtk_to_numpy(mesh.GetPoints().GetData()).astype(float)
    for outcome, turn, transform in zip(outcomes, turns, scripting.column(poses, "Transform", 4, 4)):
        yield ("right" if outcome == 0 else ("half a turn" if turn > HALF_TURN else "another turn") if outcome == 2 else
               "on the bin" if scan and is_on_bin(vertices, transform, scan) else "elsewhere")
    yield from ["missing"] * (paper.POSES - len(outcomes))


def measure(tohoku, bins, scenes=5):
    simulated, rows = sources.Bins(bins), []
    for kind in KINDS:
        of_dataset = kind == KINDS[0]
        totals = [dict.fromkeys(WHERE, 0) for _ in METHODS]
        parts = sources.TOHOKU if of_dataset else paper.PARTS
        for part in parts:
            mesh = sources.tohoku_mesh(tohoku, part) if of_dataset else sources.part_mesh(part)
            model, of_paper = (scripting.Training(mesh, method).model() for method in ("ppf", "paper"))
            runs = (evaluation.Evaluation(model, "ppf"), chains.Evaluation(model, by_evidence, "ppf"),
                    evaluation.Evaluation(of_paper, "paper"))
            for total, run in zip(totals, runs):
                for number in range(scenes):
                    if of_dataset:
                        surface, edges = sources.tohoku_clouds(tohoku, part, number)
                        truth, scan = sources.tohoku_truth(tohoku, part, number), None
                    else:
                        scan, truth = simulated.scene(part, simulation.SENSORS[0], paper.COPIES, number + 1)
                        surface = sources.without_bin(scan) if kind == KINDS[2] else scan
                        edges = evaluation.scene_edges(surface) if run is runs[1] else None
                    for where in places_of(run, run.find(surface, edges), truth, mesh, scan):
                        total[where] += 1
        rows += [{"scenes": kind, "method": words,
                  **{where: 100 * times / (paper.POSES * scenes * len(parts)) for where, times in total.items()}}
                 for words, total in zip(METHODS, totals)]
    return rows


if __name__ == "__main__":
    results.command(measure, tohoku="where the Tohoku dataset is", bins="folder that keeps the simulated bins",
                    scenes="of each part")
