#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""What the paper's text leaves open, searched one choice at a time on scenes 0 to 9 of the Tohoku dataset. The first value of
each choice is what the text says of another experiment, or the first to think of; a value that is better than the one before is
kept, and the next choice is looked at with it. Of P_ref the values are the paper's own. What is kept is reported on scenes
10 to 19, which had no part in it, beside the preset.

  testing/paper_reading.py DATASET       with build/release/env.sh sourced
"""
import sys

from vtkmodules.vtkCommonDataModel import vtkPolyData

from ppfmeam import chains, evaluation, scripting

PARTS = (1, 2, 3)
POSES = 5
PRESET = {"P_ref": 0.2, "tolerance of the verification, mm": 1.5, "poses kept of each model": 20}  # what `Paper` takes


def tangents(name):
    def choose(chain, training, value):
        getattr((training or chain).tangents, "Set" + name)(value)
    return choose


def detection_only(step, name):
    def choose(chain, training, value):
        if chain:
            getattr(getattr(chain, step), "Set" + name)(value)
    return choose


def both_verifications(name):
    def choose(chain, training, value):
        for step in (chain.candidates, chain.verification) if chain else ():
            getattr(step, "Set" + name)(value)
    return choose


CHOICES = (  # what it is called, how it is set, the values that are tried, and whether training has a part in it
    ("pixel of the projection, mm", tangents("PixelSize"), (0.5, 0.3, 1.0), True),
    ("P_ref", detection_only("detection", "ReferenceShare"), (0.05, 0.1, 0.2), False),
    ("sign of the tangents", detection_only("detection", "SignedTangents"), (True, False), False),
    ("tolerance of the verification, mm", both_verifications("Tolerance"), (1.0, 0.5, 1.5, 2.0, 3.0), False),
    ("poses kept of each model", both_verifications("PosesPerView"), (5, 10, 20, 40), False),
    ("poses nearer than this are one, mm (0: 10 % of d_max)", detection_only("alternatives", "ClusterDistance"), (0, 2, 20), False),
    ("reach of ICP, mm (0: 4 % of d_max)", detection_only("refinement", "MaximumDistance"), (0, 1, 5), False),
    ("steps of ICP", detection_only("refinement", "NumberOfIterations"), (10, 30, 50), False),
)


class Reading:
    """Runs the preset with choices on scenes, trained once for each set of choices that training has a part in."""

    def __init__(self, folder):
        self.folder, self.models, self.data = folder, {}, {}

    def model(self, part, chosen):
        key = (part, *(chosen[name] for name, _, _, trains in CHOICES if trains))
        if key not in self.models:
            training = scripting.Training(evaluation.tohoku_mesh(self.folder, part), "paper")
            for name, choose, _, trains in CHOICES:
                if trains:
                    choose(None, training, chosen[name])
            self.models[key] = training.model()
        return self.models[key]

    def scene(self, part, number):
        if (part, number) not in self.data:
            self.data[part, number] = (*evaluation.tohoku_clouds(self.folder, part, number),
                                       evaluation.tohoku_truth(self.folder, part, number))
        return self.data[part, number]

    def rates(self, chosen, scenes):
        """Percent of the best five that are right, of each part."""
        rates = []
        for part in PARTS:
            model = self.model(part, chosen)
            chain = chains.Detection(model, preset="paper")
            for name, choose, _, _ in CHOICES:
                choose(chain, None, chosen[name])
            run = evaluation.Evaluation(model, "paper", POSES)
            for number in scenes:
                surface, edges, truth = self.scene(part, number)
                chain.set_scene(edges, surface)
                poses = vtkPolyData()
                poses.ShallowCopy(scripting.update(chain.selection).GetOutput())
                run.add(poses, truth)
            rates.append(scripting.field(scripting.update(run.judge).GetOutput(), "StrictRate"))
        return rates


def row(name, value, rates):
    print(f"| {name} | {value} | " + " | ".join(f"{rate:.0f} %" for rate in rates) + f" | {sum(rates) / len(rates):.1f} % |", flush=True)


def main():
    if len(sys.argv) != 2:
        raise scripting.Failure(__doc__)
    reading = Reading(sys.argv[1])
    chosen = {name: values[0] for name, _, values, _ in CHOICES}
    print("| choice | value | Part 1 | Part 2 | Part 3 | average |\n|---|---|---|---|---|---|")
    best = reading.rates(chosen, range(10))
    row("first values", "", best)
    for name, _, values, _ in CHOICES:
        for value in values[1:]:
            rates = reading.rates({**chosen, name: value}, range(10))
            row(name, value, rates)
            if sum(rates) > sum(best):
                best, chosen = rates, {**chosen, name: value}
    kept = ", ".join(f"{name} {chosen[name]}" for name, _, values, _ in CHOICES if chosen[name] != values[0]) or "nothing"
    preset = ", ".join(f"{name} {value}" for name, value in PRESET.items())
    print(f"\nKept: {kept}. On scenes 10 to 19, the first values, what was kept and the preset `Paper` ({preset}):\n\n| | | Part 1 | Part 2 | Part 3 | average |\n|---|---|---|---|---|---|")
    first = {name: values[0] for name, _, values, _ in CHOICES}
    for name, values in (("first values", first), ("kept", chosen), ("preset", {**first, **PRESET})):
        row(name, "", reading.rates(values, range(10, 20)))


scripting.run(main)
