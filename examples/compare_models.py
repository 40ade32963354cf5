#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Trains a part in many ways and compares what each model finds, as tables in Markdown.

The scenes are those of the Tohoku University 6D Pose Estimation Dataset (--tohoku DIR, in the folders Part_P) and
simulated bins of the sample part, whose edges come from their images. Every model differs from the first one in what
its name says. Columns:
  strict     right poses / poses asked for, in %: each true instance counts once, a missing pose is wrong
  recall     of the instances that are at least half visible, in %, by all poses that come out
  mm, deg    median errors of the right poses
  pairs, MB  entries of the table and its size
  training   seconds from the clean mesh to the model; ms: median time of a scene from its edge points to the poses
"""
import argparse
import sys
import time

from ppfmeam import evaluation, filters, scripting


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
HEAD = ("| model | strict | recall | mm | deg | pairs | MB | training, s | ms a scene |\n"
        "|---|---|---|---|---|---|---|---|---|")
ROW = ("| {name} | {strict:.1f} % | {recall:.1f} % | {mm:.3f} | {deg:.3f} | {pairs:.0f} | {megabytes:.1f} | {training:.1f} "
       "| {ms:.0f} |")


class Scenes:
    """A part's mesh, and of each scene the surface, the edge points and the true poses with their visibility."""

    def __init__(self, name, mesh):
        self.name, self.mesh, self.scenes = name, mesh, []


def tohoku(folder, part, count):
    scenes = Scenes(f"Part {part} of the Tohoku dataset", evaluation.tohoku_mesh(folder, part))
    model = scripting.train(scenes.mesh)  # the same for all: how much of an instance is visible is no choice of a model
    scenes.scenes = [evaluation.tohoku_scene(folder, part, scene, model) for scene in range(count)]
    return scenes


def simulated(count, copies):
    scenes = Scenes("the sample part in simulated bins", None)
    for seed in range(1, count + 1):
        source = filters.vtkMEAMBinSceneSource()
        source.SetSeed(seed)
        source.SetCopies(copies)
        edges = filters.vtkMEAMSceneEdgeExtraction()
        edges.SetInputConnection(source.GetOutputPort())
        scripting.update(edges)
        surface, truth, scenes.mesh = (source.GetOutputDataObject(port) for port in range(3))
        scenes.scenes.append((surface, edges.GetOutputDataObject(0), truth))
    return scenes


def measure(scenes, choice, options):
    """A row of the table."""
    name, choose = CHOICES[choice]
    training = scripting.Training(scenes.mesh, options.preset)
    choose(training)
    start = time.time()
    model = training.model()
    seconds = time.time() - start
    run = evaluation.Evaluation(model, options.preset, options.poses, options.threads)
    for surface, edges, truth in scenes.scenes:
        run.add(run.find(surface, edges), truth)
    return ROW.format(name=name, training=seconds, pairs=scripting.field(model, "NumberOfPairs"),
                      megabytes=scripting.field(model, "TableBytes") / 1e6, **run.figures())


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--tohoku", metavar="DIR", help="where the Tohoku dataset is; without, only simulated bins")
    parser.add_argument("--parts", type=evaluation.numbers, default=[1, 2, 3], help="of the dataset (default: 1,2,3)")
    parser.add_argument("--scenes", type=scripting.count, default=10, help="of each part (default: %(default)s)")
    parser.add_argument("--simulated", type=scripting.count, default=6, metavar="N",
                        help="simulated bins; 0: none (default: %(default)s)")
    parser.add_argument("--copies", type=scripting.count, default=20, help="in a simulated bin (default: %(default)s)")
    parser.add_argument("--only", type=lambda text: text.split(","), default=list(CHOICES), metavar="NAMES",
                        help=f"models to compare, such as preset,whole (default: all: {', '.join(CHOICES)})")
    scripting.add_method_options(parser)
    parser.add_argument("--poses", type=scripting.count, default=5, help="poses wanted of a scene; 0: all (default: %(default)s)")
    parser.add_argument("--threads", type=scripting.count, default=0, help="threads to work with; 0: all cores (default)")
    parser.add_argument("--out", metavar="FILE", help="write the tables as Markdown")
    options = parser.parse_args()
    unknown = [name for name in options.only if name not in CHOICES]
    if unknown:
        parser.error(f"unknown models: {', '.join(unknown)}")
    scripting.require_folder_of(options.out)

    lines = []

    def tell(text):
        print(text, flush=True)
        lines.append(text)

    sets = [lambda part=part: tohoku(options.tohoku, part, options.scenes) for part in options.parts] \
        if options.tohoku and options.scenes else []
    if options.simulated:
        sets.append(lambda: simulated(options.simulated, options.copies))
    failed = 0
    for load in sets:
        scenes = load()
        tell(f"### {scenes.name[0].upper()}{scenes.name[1:]}; scenes: {len(scenes.scenes)}\n\n{HEAD}")
        for choice in options.only:
            try:
                tell(measure(scenes, choice, options))
            except scripting.Failure as failure:
                print(f"{scenes.name}, {choice}: {failure}", file=sys.stderr)
                failed += 1
        tell("")
    if options.out:
        with scripting.written(options.out) as file:
            file.write("\n".join(lines))
    if failed:
        raise scripting.Failure(f"{failed} models could not be compared")


scripting.run(main)
