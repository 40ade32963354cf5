#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Switches the decisions of the method off, one at a time, and prints what is left of it as tables in Markdown.

The scenes are those of the Tohoku University 6D Pose Estimation Dataset, DIR/Part_P. Every row differs from the first
one in what its name says. Columns:
  strict   right poses / poses asked for, in %: each true instance counts once, a missing pose is wrong
  recall   of the instances that are at least half visible, in %, by all poses that come out
  mm, deg  median errors of the right poses
  ms       median time of a scene from its edge points to the poses; - where the online phase is another one: the step
           filters do that, and each of them reads the model anew. meamBenchmarks --benchmark_filter=Decision measures it.
"""
import argparse
import sys

from vtkmodules.vtkCommonDataModel import vtkPolyData

from ppfmeam import evaluation, scripting


def length(training, share):
    """A share of the part's diameter, in mm."""
    return share * scripting.field(scripting.update(training.surface).GetOutput(), "Diameter")


def no_near_symmetries(training):
    samples = vtkPolyData()
    samples.ShallowCopy(training.symmetric_samples())
    for name in ("NearSymmetries", "NearSymmetryOverlap", "NearSymmetryDeviation"):
        samples.GetFieldData().RemoveArray(name)
    training.hashing.SetInputDataObject(1, samples)


def edge_coverage(chain):
    chain.candidates.SetMethodToEdgeCoverage()
    chain.verification.SetMethodToEdgeCoverage()
    chain.alternatives.SetMethodToClusters()
    chain.selection.SetMethodToClusters()


def no_refinement(chain):
    chain.verification.SetInputConnection(chain.alternatives.GetOutputPort())


def edges_refine(chain):
    chain.without_surface.append(chain.refinement)


def no_surface(chain):
    chain.without_surface += chain.on_poses


def evidence(**values):
    """Sets these properties of all steps that have them."""
    def choose(chain):
        for step in chain.on_poses:
            for name, value in values.items():
                if hasattr(step, "Set" + name):
                    getattr(step, "Set" + name)(value)
    return choose


# Name: what is told, what is changed in training and what in the online phase.
DECISIONS = {
    "none": ("nothing", None, None),
    "tiles": ("tangents by Algorithms 1 and 2", lambda training: training.tangents.SetMethodToTiles(),
              lambda chain: chain.tangents.SetMethodToTiles()),
    "gamma-100": ("hidden points by a sphere of 100 (gamma), not of 1000",
                  lambda training: training.views.SetRadiusFactor(1e2), None),
    "gamma-10000": ("hidden points by a sphere of 10000", lambda training: training.views.SetRadiusFactor(1e4), None),
    "mesh-visibility": ("hidden points by the mesh", lambda training: training.views.SetMethodToMeshVisibility(), None),
    "paper-key": ("the paper's key, three acute angles", lambda training: training.hashing.SetFeatureToPaper(), None),
    "signs": ("signs of tangents not looked at", None, lambda chain: chain.detection.SignedTangentsOff()),
    "one-turn": ("peaks of one turn, not of three", None, lambda chain: chain.detection.SmoothPeaksOff()),
    "angle-3.6": ("steps of 3.6 degrees", lambda training: training.hashing.SetAngleStep(3.6), None),
    "angle-12": ("steps of 12 degrees", lambda training: training.hashing.SetAngleStep(12), None),
    "distance-5": ("steps of 5 % of d_max", lambda training: training.hashing.SetDistanceStep(0.05), None),
    "distance-10": ("steps of 10 % of d_max", lambda training: training.hashing.SetDistanceStep(0.1), None),
    "common-views": ("pairs of common views only", lambda training: training.hashing.SetCoVisibilityDirections(0), None),
    "voxel-codes": ("views merged by voxel codes", lambda training: training.hashing.SetViewMergingToVoxelCodes(), None),
    "separate": ("views not merged", lambda training: training.hashing.SetViewMergingToNone(), None),
    "more-votes": ("one point of cubes of 3 % votes, not of 4 %",
                   lambda training: training.hashing.SetLeafSize(length(training, 0.03)), None),
    "sparse-edges": ("only points that vote judge, too",
                     lambda training: training.tangents.SetLeafSize(length(training, 0.04)), None),
    "near": ("no near-symmetries", no_near_symmetries, None),
    "own-visibility": ("competing turns each judged on all they predict", None, evidence(SameVisibility=False)),
    "no-free-space": ("what the sensor saw past does not count", None, evidence(FreeSpace=False)),
    "p-ref-5": ("P_ref 5 %", None, lambda chain: chain.detection.SetReferenceShare(0.05)),
    "p-ref-2": ("P_ref 2 %", None, lambda chain: chain.detection.SetReferenceShare(0.02)),
    "p-ref-1": ("P_ref 1 %", None, lambda chain: chain.detection.SetReferenceShare(0.01)),
    "peaks": ("two peaks of each reference", None, lambda chain: chain.detection.SetPeaksPerReference(2)),
    "candidates-15": ("15 candidates refined", None, lambda chain: chain.alternatives.SetMaximumNumberOfPoses(15)),
    "candidates-25": ("25 candidates refined", None, lambda chain: chain.alternatives.SetMaximumNumberOfPoses(25)),
    "alternatives": ("one candidate of an instance", None, lambda chain: chain.alternatives.SetPosesPerInstance(1)),
    "coverage": ("verification by edge coverage", None, edge_coverage),
    "no-refinement": ("no refinement", None, no_refinement),
    "point-to-point": ("point-to-point refinement", None, lambda chain: chain.refinement.SetParametersToPaper()),
    "edges-refine": ("refinement by edges alone", None, edges_refine),
    "edges": ("edges alone, no surface", None, no_surface),
}
HEAD = "| changed | strict | recall | mm | deg | ms |\n|---|---|---|---|---|---|"
ROW = "| {name} | {strict:.1f} % | {recall:.1f} % | {mm:.3f} | {deg:.3f} | {time} |"


def measure(mesh, scenes, decision, plain, options):
    """A row of the table; `plain` is the model with nothing changed."""
    name, train, choose = DECISIONS[decision]
    model = plain
    if train:
        training = scripting.Training(mesh)
        train(training)
        model = training.model()
    run = evaluation.Chain(model, choose, options.poses, options.threads) if choose else evaluation.Evaluation(
        model, poses_asked_for=options.poses, threads=options.threads)
    for surface, edges, truth in scenes:
        run.add(run.find(surface, edges), truth)
    figures = run.figures()
    return ROW.format(name=name, time="-" if choose else f"{figures['ms']:.0f}", **figures)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folder", metavar="DIR", help="where the dataset is")
    parser.add_argument("--parts", type=evaluation.numbers, default=[1, 2, 3], help="such as 1,3 (default: 1,2,3)")
    parser.add_argument("--scenes", type=evaluation.numbers, default=list(range(10)), help="such as 0-4,7 (default: 0-9)")
    parser.add_argument("--only", type=lambda text: text.split(","), default=list(DECISIONS), metavar="NAMES",
                        help=f"rows, such as none,near (default: all: {', '.join(DECISIONS)})")
    parser.add_argument("--poses", type=scripting.count, default=5, help="poses wanted of a scene; 0: all (default: %(default)s)")
    parser.add_argument("--noise", type=evaluation.noise, default="0", help=evaluation.NOISE_HELP)
    parser.add_argument("--threads", type=scripting.count, default=0, help="threads to work with; 0: all cores (default)")
    options = parser.parse_args()
    unknown = [name for name in options.only if name not in DECISIONS]
    if unknown:
        parser.error(f"unknown rows: {', '.join(unknown)}")

    failed = 0
    for part in options.parts:
        mesh = evaluation.tohoku_mesh(options.folder, part)
        plain = scripting.train(mesh)
        deviation = options.noise(scripting.field(plain, "Diameter"))
        scenes = [evaluation.tohoku_scene(options.folder, part, scene, plain, deviation) for scene in options.scenes]
        print(f"### Part {part}; scenes: {len(scenes)}\n\n{HEAD}", flush=True)
        for decision in options.only:
            try:
                print(measure(mesh, scenes, decision, plain, options), flush=True)
            except scripting.Failure as failure:
                print(f"part {part}, {decision}: {failure}", file=sys.stderr)
                failed += 1
        print()
    if failed:
        raise scripting.Failure(f"{failed} rows could not be measured")


scripting.run(main)
