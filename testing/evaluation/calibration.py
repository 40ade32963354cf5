#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Tells how often poses of each probability are right, of all poses that come out. The scenes are those of the Tohoku dataset
(--tohoku), with the scene's surface and by edges alone, or of datasets in the form of the BOP benchmark such as `ppfmeam
simulate` writes (--bop), with edges of their images. The row `all` has the mean logarithmic loss of the probabilities, and that
of the logistic regression that fits these poses best: probability = 1 / (1 + exp(-constant - a * place - b * log(Certainty)));
`place` the log odds of PlaceProbability, the column Evidence: constant 0, a 1 and b 0 are the places as they are."""
import numpy

from ppfmeam import dataset, evaluation, scripting

import chains
import results
import scenes as sources

LIMITS = (0, 0.05, 0.2, 0.4, 0.6, 0.8, 0.9, 0.95, 0.99, 1)
ARRAYS = ("Probability", "PlaceProbability", "Certainty")


def noises(text):
    """Of numbers with commas between them a function of the diameter each."""
    return [sources.noise(one) for one in text.split(",")]


def judged(run, scenes):
    """Of all poses found in the scenes a row each: whether it is right, and ARRAYS."""
    rows = []
    for inputs, truth in scenes:
        poses = run.find(*inputs)
        run.add(poses, truth)
        rows.append(numpy.stack([scripting.column(poses, name) for name in ARRAYS], axis=1))
    return numpy.column_stack((run.right(), numpy.concatenate(rows)))


def of_dataset(folder, part, scenes, noise, with_surface, threads):
    model = scripting.train(sources.tohoku_mesh(folder, part))

    def choose(chain):
        if not with_surface:
            chain.without_surface += chain.on_poses

    deviations = [deviation(scripting.field(model, "Diameter")) for deviation in noise]
    return judged(chains.Evaluation(model, choose, poses_asked_for=0, threads=threads), (
        (scene[:2], scene[2]) for deviation in deviations for scene in (
            sources.tohoku_scene(folder, part, number, model, deviation) for number in scenes)))


def of_images(folder, threads):
    """The same of a BOP dataset, all of its objects."""
    data = dataset.Dataset(folder, "test")
    return numpy.concatenate([judged(evaluation.Evaluation(data.train(number, "recommended"), threads=threads), (
        ((image.scan, None, image.beside, data.beside()), image.truth_of(number))
        for scene in map(data.scene, data.scenes()) for image in map(scene.image, scene.steps))) for number in data.objects()])


def loss(right, probabilities):
    p = numpy.clip(probabilities, 1e-9, 1 - 1e-9)
    return float(-numpy.mean(right * numpy.log(p) + (1 - right) * numpy.log(1 - p)))


def fitted(right, inputs):
    """Weights of the logistic regression of largest likelihood, by Newton's method, and its probabilities."""
    weights = numpy.zeros(inputs.shape[1])
    for _ in range(50):
        p = 1 / (1 + numpy.exp(-inputs @ weights))
        curvature = (inputs.T * (p * (1 - p))) @ inputs + 1e-3 * numpy.eye(len(weights))
        weights += numpy.linalg.solve(curvature, inputs.T @ (right - p) - 1e-3 * weights)
    return weights, 1 / (1 + numpy.exp(-inputs @ weights))


def rows_of(name, poses):
    right, probability, place, certainty = poses.T
    place = numpy.clip(place, 1e-12, 1 - 1e-12)
    evidence = numpy.log(place / (1 - place))
    rows = []
    for low, high in zip(LIMITS, LIMITS[1:]):
        these = (probability >= low) & ((probability < high) | (high == 1))
        if these.any():
            rows.append({"scenes": name, "probability": f"{low} to {high}", "poses": int(these.sum()),
                         "right": float(100 * right[these].mean()),
                         "mean probability": float(100 * probability[these].mean()), "loss": None, "loss of the best fit": None,
                         "constant": None,
                         "Evidence": None, "log(Certainty)": None})
    weights, better = fitted(right, numpy.column_stack((numpy.ones(len(poses)), evidence,
                                                        numpy.log(numpy.maximum(certainty, 1e-6)))))
    return [*rows, {"scenes": name, "probability": "all", "poses": len(poses), "right": float(100 * right.mean()),
                    "mean probability": float(100 * probability.mean()), "loss": loss(right, probability),
                    "loss of the best fit": loss(right, better),
                    **dict(zip(("constant", "Evidence", "log(Certainty)"), map(float, weights)))}]


def measure(tohoku=None, bop: lambda text: text.split(",") = [], parts: evaluation.numbers = [1, 2, 3],
            scenes: evaluation.numbers = list(range(20)), noise: noises = "0,0.5", threads=0):
    if bool(tohoku) == bool(bop):
        raise scripting.Failure("either --tohoku or --bop is needed")
    if bop:
        return rows_of("images", numpy.concatenate([of_images(folder, threads) for folder in bop]))
    noise = noises(noise) if isinstance(noise, str) else noise
    return [row for name, with_surface in (("edges and surface", True), ("edges alone", False))
            for row in rows_of(name, numpy.concatenate(
        [of_dataset(tohoku, part, scenes, noise, with_surface, threads) for part in parts]))]


if __name__ == "__main__":
    results.command(measure, tohoku="where the dataset is", bop="folders of datasets", parts="such as 1,3",
                    scenes="such as 0-4,7", noise=sources.NOISE_HELP)
