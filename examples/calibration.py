#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Tells how often poses of each probability are right, as tables in Markdown, with the scene's surface and by edges alone.

The scenes are those of the Tohoku University 6D Pose Estimation Dataset, DIR/Part_P, or of datasets in the form of the BOP
benchmark such as simulate.py writes (--bop), with edges of their images; all poses that come out of them count.
Under each table is the logistic regression that fits best: probability = 1 / (1 + exp(-constant - a * Evidence - b *
log(Certainty))), with its mean logarithmic loss and that of the probabilities as they came; constant 0, a 1 and b 0 are those.
"""
import argparse

import numpy
from vtkmodules.util.numpy_support import vtk_to_numpy

from ppfmeam import dataset, evaluation, scripting

LIMITS = (0, 0.05, 0.2, 0.4, 0.6, 0.8, 0.9, 0.95, 0.99, 1)
ARRAYS = ("Probability", "Evidence", "Certainty")


def judged(folder, part, scenes, noises, with_surface, threads):
    """Of all poses found in the scenes a row each: whether it is right, and ARRAYS."""
    model = scripting.train(evaluation.tohoku_mesh(folder, part))

    def choose(chain):
        if not with_surface:
            chain.without_surface += chain.on_poses

    run = evaluation.Chain(model, choose, 0, threads)
    rows = []
    for noise in noises:
        deviation = noise(scripting.field(model, "Diameter"))
        for scene in scenes:
            surface, edges, truth = evaluation.tohoku_scene(folder, part, scene, model, deviation)
            poses = run.find(surface, edges)
            run.add(poses, truth)
            rows.append(numpy.stack([vtk_to_numpy(poses.GetPointData().GetArray(name)) for name in ARRAYS], axis=1))
    return numpy.column_stack((run.right(), numpy.concatenate(rows)))


def judged_images(folder, threads):
    """The same of a BOP dataset, all of its objects."""
    data = dataset.Dataset(folder, "test")
    rows = []
    for number in data.objects():
        run = evaluation.Evaluation(data.train(number, "recommended"), threads=threads)
        found = []
        for scene in map(data.scene, data.scenes()):
            for image in map(scene.image, scene.steps):
                poses = run.find(image.scan, None, image.beside, data.beside())
                run.add(poses, image.truth_of(number))
                found.append(numpy.stack([vtk_to_numpy(poses.GetPointData().GetArray(name)) for name in ARRAYS], axis=1))
        rows.append(numpy.column_stack((run.right(), numpy.concatenate(found))))
    return numpy.concatenate(rows)


def loss(right, probabilities):
    p = numpy.clip(probabilities, 1e-9, 1 - 1e-9)
    return -numpy.mean(right * numpy.log(p) + (1 - right) * numpy.log(1 - p))


def fitted(right, inputs):
    """Weights of the logistic regression of largest likelihood, by Newton's method, and its probabilities."""
    weights = numpy.zeros(inputs.shape[1])
    for _ in range(50):
        p = 1 / (1 + numpy.exp(-inputs @ weights))
        curvature = (inputs.T * (p * (1 - p))) @ inputs + 1e-3 * numpy.eye(len(weights))
        weights += numpy.linalg.solve(curvature, inputs.T @ (right - p) - 1e-3 * weights)
    return weights, 1 / (1 + numpy.exp(-inputs @ weights))


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folder", metavar="DIR", nargs="?", help="where the Tohoku dataset is")
    parser.add_argument("--bop", type=lambda text: text.split(","), metavar="DIR,...",
                        help="datasets in the form of the BOP benchmark in its place")
    parser.add_argument("--parts", type=evaluation.numbers, default=[1, 2, 3], help="such as 1,3 (default: 1,2,3)")
    parser.add_argument("--scenes", type=evaluation.numbers, default=list(range(20)), help="such as 0-4,7 (default: 0-19)")
    parser.add_argument("--noise", type=lambda text: [evaluation.noise(one) for one in text.split(",")], default="0,0.5",
                        help="normal noise of the points, mm or %% of the diameter, one after the other (default: %(default)s)")
    parser.add_argument("--threads", type=scripting.count, default=0, help="threads to work with; 0: all cores (default)")
    options = parser.parse_args()
    if bool(options.folder) == bool(options.bop):
        parser.error("either DIR or --bop is needed")
    if options.bop:
        sets = {"images": lambda: [judged_images(folder, options.threads) for folder in options.bop]}
    else:
        sets = {name: lambda with_surface=with_surface: [
            judged(options.folder, part, options.scenes, options.noise, with_surface, options.threads)
            for part in options.parts] for name, with_surface in (("edges and surface", True), ("edges alone", False))}
    for name, judge in sets.items():
        poses = numpy.concatenate(judge())
        right, probability, evidence, certainty = poses.T
        print(f"### {name}; poses: {len(poses)}\n\n| probability | poses | right | mean probability |\n|---|---|---|---|")
        for low, high in zip(LIMITS, LIMITS[1:]):
            these = (probability >= low) & ((probability < high) | (high == 1))
            if these.any():
                print(f"| {low} to {high} | {these.sum()} | {100 * right[these].mean():.1f} % |"
                      f" {100 * probability[these].mean():.1f} % |")
        weights, better = fitted(right, numpy.column_stack(
            (numpy.ones(len(poses)), evidence, numpy.log(numpy.maximum(certainty, 1e-6)))))
        print("\nconstant {:.2f}, Evidence {:.2f}, log(Certainty) {:.2f};".format(*weights),
              f"loss {loss(right, better):.4f}, as they came {loss(right, probability):.4f}\n", flush=True)


scripting.run(main)
