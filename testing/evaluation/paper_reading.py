#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""What the paper's text leaves open, searched one choice at a time on scenes 0 to 9 of the Tohoku dataset. The first value of
each choice is what the text says of another experiment, or the first to think of; a value that is better than the one before is
kept, and the next choice is looked at with it. Of P_ref the values are the paper's own. What is kept is reported on scenes 10 to
19, which had no part in it, beside the preset. strict of each part, %."""
from ppfmeam import scripting

import chains
import results
import scenes as sources

PRESET = {"P_ref": 0.2, "tolerance of the verification, mm": 1.5, "poses kept of each model": 20}  # what `Paper` takes
CHOICES = {  # the steps that have a property, its name, and the values that are tried
    "pixel of the projection, mm": (("tangents",), "PixelSize", (0.5, 0.3, 1.0)),  # training has a part in this one
    "P_ref": (("detection",), "ReferenceShare", (0.05, 0.1, 0.2)),
    "sign of the tangents": (("detection",), "SignedTangents", (True, False)),
    "tolerance of the verification, mm": (("candidates", "verification"), "Tolerance", (1.0, 0.5, 1.5, 2.0, 3.0)),
    "poses kept of each model": (("candidates", "verification"), "PosesPerView", (5, 10, 20, 40)),
    "poses nearer than this are one, mm (0: 10 % of d_max)": (("alternatives",), "ClusterDistance", (0, 2, 20)),
    "reach of ICP, mm (0: 4 % of d_max)": (("refinement",), "MaximumDistance", (0, 1, 5)),
    "steps of ICP": (("refinement",), "NumberOfIterations", (10, 30, 50)),
}


class Reading:
    """Runs the preset with choices on scenes, trained once for each pixel size."""

    def __init__(self, folder):
        self.folder, self.models, self.data = folder, {}, {}

    def model(self, part, pixel):
        if (part, pixel) not in self.models:
            training = scripting.Training(sources.tohoku_mesh(self.folder, part), "paper")
            training.tangents.SetPixelSize(pixel)
            self.models[part, pixel] = training.model()
        return self.models[part, pixel]

    def scene(self, part, number):
        if (part, number) not in self.data:
            self.data[part, number] = (*sources.tohoku_clouds(self.folder, part, number),
                                       sources.tohoku_truth(self.folder, part, number))
        return self.data[part, number]

    def rates(self, chosen, scenes):
        """Percent of the best five that are right, of each part."""
        def choose(chain):
            for name, (steps, prop, _) in CHOICES.items():
                for step in steps:
                    getattr(getattr(chain, step), "Set" + prop)(chosen[name])

        rates = []
        for part in sources.TOHOKU:
            run = chains.Evaluation(self.model(part, chosen["pixel of the projection, mm"]), choose, "paper")
            for number in scenes:
                surface, edges, truth = self.scene(part, number)
                run.add(run.find(surface, edges), truth)
            rates.append(run.figures()["strict"])
        return rates


def measure(tohoku):
    reading, rows = Reading(tohoku), []

    def tell(scenes, name, value, rates):
        rows.append({"scenes": scenes, "choice": name, "value": value,
                     **{f"Part {part}": rate for part, rate in zip(sources.TOHOKU, rates)},
                     "average": sum(rates) / len(rates)})

    first = {name: values[0] for name, (_, _, values) in CHOICES.items()}
    chosen, best = first, reading.rates(first, range(10))
    tell("0-9", "first values", "", best)
    for name, (_, _, values) in CHOICES.items():
        for value in values[1:]:
            rates = reading.rates({**chosen, name: value}, range(10))
            tell("0-9", name, value, rates)
            if sum(rates) > sum(best):
                best, chosen = rates, {**chosen, name: value}
    kept = {name: value for name, value in chosen.items() if value != first[name]}
    for name, values in (("first values", {}), ("kept", kept), ("preset", PRESET)):
        tell("10-19", name, ", ".join(f"{choice} {value}" for choice, value in values.items()),
             reading.rates({**first, **values}, range(10, 20)))
    return rows


if __name__ == "__main__":
    results.command(measure, tohoku="where the Tohoku dataset is")
