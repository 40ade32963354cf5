#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Trains a part in many ways and compares what each model finds, in scenes of the Tohoku dataset with their own edge points and
in simulated bins of the sample part, whose edges come from their images. Every model differs from the first one in what its name
says. pairs, MB: entries of the table and its size; training: seconds from the clean mesh to the model; the others: see
tohoku.py."""
import time

from ppfmeam import evaluation, scripting

import results
import scenes as sources


def viewpoints(number, cone=180.0):
    def choose(training):
        training.views.SetNumberOfViewpoints(number)
        training.views.SetConeAngle(cone)
    return choose


def both_of_mesh(training):
    training.views.SetMethodToMeshVisibility()
    training.boundary.SetMethodToMeshEdges()


def whole_of_mesh(training):
    training.views.SetNumberOfViewpoints(0)
    training.boundary.SetMethodToMeshEdges()


CHOICES = {
    "preset": ("as the preset has it: hidden point removal, point boundary, 6 views", lambda training: None),
    "mesh-visibility": ("mesh visibility", lambda training: training.views.SetMethodToMeshVisibility()),
    "mesh-edges": ("mesh edges", lambda training: training.boundary.SetMethodToMeshEdges()),
    "mesh-both": ("mesh visibility and mesh edges", both_of_mesh),
    "views-2": ("2 views", viewpoints(2)),
    "views-14": ("14 views", viewpoints(14)),
    "views-26": ("26 views", viewpoints(26)),
    "cone": ("9 views of the upper side", viewpoints(9, 90.0)),
    "merged": ("points of views merged", lambda training: training.hashing.SetViewMergingToPoints()),
    "voxel-codes": ("voxel codes", lambda training: training.hashing.SetViewMergingToVoxelCodes()),
    "separate": ("a table for each view", lambda training: training.hashing.SetViewMergingToNone()),
    "whole": ("without MEAM", viewpoints(0)),
    "whole-mesh": ("without MEAM, mesh edges", whole_of_mesh),
}


def of_dataset(folder, part, count):
    """The mesh, and of each scene the surface, the edge points and the true poses with their visibility."""
    mesh = sources.tohoku_mesh(folder, part)
    model = scripting.train(mesh)  # the same for all: how much of an instance is visible is no choice of a model
    return mesh, [sources.tohoku_scene(folder, part, scene, model) for scene in range(count)]


def in_bins(count, copies):
    found = []
    for seed in range(1, count + 1):
        scan, truth, mesh = sources.outputs_of(sources.bin_source(None, copies, seed), 0, 1, 2)
        found.append((scan, evaluation.scene_edges(scan), truth))
    return mesh, found


def measure(tohoku=None, parts: evaluation.numbers = [1, 2, 3], scenes=10, bins=6, copies=20, only=tuple(CHOICES),
            preset="recommended", poses=5,
            threads=0):
    sets = {f"Part {part}": lambda part=part: of_dataset(tohoku, part, scenes) for part in parts} if tohoku and scenes else {}
    if bins:
        sets["bins"] = lambda: in_bins(bins, copies)
    rows = []
    for name, load in sets.items():
        mesh, places = load()
        for choice in only:
            with results.told(f"{name}, {choice}"):
                training = scripting.Training(mesh, preset)
                CHOICES[choice][1](training)
                start = time.time()
                model = training.model()
                seconds = time.time() - start
                run = evaluation.Evaluation(model, preset, poses, threads)
                for surface, edges, truth in places:
                    run.add(run.find(surface, edges), truth)
                figures = run.figures()
                rows.append({"scenes": name, "model": CHOICES[choice][0],
                             **{name: figures[name] for name in ("strict", "recall", "mm", "deg")},
                             "pairs": int(scripting.field(model, "NumberOfPairs")),
                             "MB": scripting.field(model, "TableBytes") / 1e6,
                             "training, s": seconds, "ms": figures["ms"]})
    return rows


if __name__ == "__main__":
    results.command(measure, tohoku="where the Tohoku dataset is; without, only simulated bins", scenes="of each part",
                    bins="simulated ones",
                    only="models to compare", preset="recommended or paper")
