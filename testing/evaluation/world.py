#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Parts and sensors: simulated bins of the sample parts, each seen by each kind of sensor, and for each as many bins of the next
part, in which the part is not; by each choice of features.

DIR/world.csv gets a row for each search and DIR/poses.csv one for each pose as they come, from which a run goes on that was
stopped. Rates in %: strict (best five right), recall of copies at least half visible, R@99 with the poses found where the part is
not, AR and AP2-20 of the BOP benchmark over copies at least a tenth visible; median errors of the right ones of the best; by how
much the mean probability of all poses is above the share of the right ones; the highest probability where the part is not."""
import sys

import numpy

from ppfmeam import dataset, scripting, simulation

import results
import search
from results import median, values
from scenes import PARTS

KIND = ("part", "sensor", "features")  # that a line of the table is of
CLASS = 100  # poses whose probabilities are compared with a rate
DRAWS = 400  # of which poses are right, by what they claim


def right_of(poses):
    """Whether each pose is right, duplicates too."""
    return numpy.array([row["outcome"] in search.OUTCOMES[:2] for row in poses], float)


def figures(kind, rows, poses):
    """A line of the table: bins that hold the part, but for the probabilities, which are of all."""
    def share(part, whole):
        return float(100 * values(there, part).sum() / values(there, whole).sum()) if values(there, whole).sum() else None

    there = [row for row in rows if row["bin"] == row["part"]]
    asked = {search.key_of(row): int(row["asked"]) or int(row["poses"] or 0) for row in rows}
    right = [row for row in poses if row["outcome"] in search.OUTCOMES[:2] and int(row["rank"]) <= asked[search.key_of(row)]]
    claims, absent = values(poses, "probability"), values([row for row in poses if row["bin"] != row["part"]], "probability")
    return {**dict(zip(KIND, kind)), "strict": share("right", "asked"), "recall": share("half_visible_found", "half_visible"),
            "R@99": recall_at_precision_99(poses, values(there, "half_visible").sum()),
            **{name: dataset.mean_of(there, name) for name in ("AR", "AP2-20")}, "mm": median(right, "mm"),
            "degrees": median(right, "degrees"),
            "claim - rate": float(100 * (claims.mean() - right_of(poses).mean())) if claims.size else None,
            "without the part": float(100 * absent.max()) if absent.size else None, "ms": median(there, "ms"),
            "failed": sum(row["failure"] != "" for row in rows)}


def table(rows, poses):
    """A line for each part, sensor and choice of features, and for all of them."""
    lines = []
    for fixed in range(len(KIND)):  # the first ones are all
        kinds = dict.fromkeys(tuple(row[name] for name in KIND[fixed:]) for row in rows)
        if fixed == 0 or len(lines) > 1:
            lines += [figures(("all",) * fixed + kind,
                              *([row for row in each if tuple(row[name] for name in KIND[fixed:]) == kind]
                                                         for each in (rows, poses))) for kind in kinds]
    return lines


def recall_at_precision_99(poses, instances):
    """In %, as vtkMEAMPoseEvaluation has it: found by the likeliest poses, as many as may be with 99 of 100 right; None without
    instances."""
    if not instances:
        return None
    ranked = sorted((row for row in poses if row["found"] != ""), key=lambda row: -float(row["probability"]))
    right = numpy.cumsum([row["found"] == "1" for row in ranked])
    return float(100 * max([0, *right[100 * right >= 99 * numpy.arange(1, len(ranked) + 1)]]) / instances)


def largest_gap(claims, right):
    """Of the poses in the order of their probabilities, a hundred at a time, those whose rate is farthest from them."""
    if not claims.size:
        return "No poses."
    order = numpy.argsort(claims, kind="stable")
    classes = [order[start:start + CLASS] for start in range(0, max(len(order) - CLASS, 0) + 1, CLASS)]

    def gaps(outcomes):
        return [abs(claims[these].mean() - outcomes[these].mean()) for these in classes]

    worst = classes[int(numpy.argmax(gaps(right)))]
    random = numpy.random.default_rng(1)
    by_chance = numpy.quantile([max(gaps(random.random(len(claims)) < claims)) for _ in range(DRAWS)], 0.95)
    return (f"{len(order)} poses. Of classes of {CLASS} the one with the largest gap claims {100 * claims[worst].mean():.1f} %, "
            f"and {100 * right[worst].mean():.1f} % of it are right. Claims that hold exactly would have a largest gap of "
            f"{100 * by_chance:.1f} % or more once in 20 times.")


def measure(dir, parts=PARTS, sensors=simulation.SENSORS, features=tuple(scripting.FEATURES), method="recommended", bins=5, seed=1,
            copies=20,
            poses=5, scenes=None, threads=0):
    # Those in a bin one after the other: it is simulated for the next part, too.
    wanted = [{"source": "image", "part": part, "method": method, "features": choice, "views": "6", "sensor": sensor, "bin": lies,
               "copies": str(copies), "seed": str(number), "asked": poses}
              for sensor in sensors for number in range(seed, seed + bins) for part in parts
              for lies in (part, PARTS[(PARTS.index(part) + 1) % len(PARTS)]) for choice in features]
    places = search.Scenes(scenes)
    rows, found = search.Searches(dir, "world").measure(wanted, places, threads)
    for choice in features:
        these = [row for row in found if row["features"] == choice]
        print(f"Features {choice}:", largest_gap(values(these, "probability"), right_of(these)), file=sys.stderr)
    return table(rows, found)


if __name__ == "__main__":
    results.command(measure, dir="folder to write", parts="that are looked for",
                    bins="of each part and sensor, and as many without the part",
                    seed="of the first bin, the next has the next one",
                    scenes="folder that keeps the simulated bins (.vts and .vtp)")
