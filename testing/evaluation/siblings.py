#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Looks for parts in bins that hold a sibling of theirs instead: scaled along one axis, or mirrored; and in bins of the part.

  . build/release/env.sh; testing/evaluation/siblings.py --out OUT [--seed N] [--part NAME...] [--sensor NAME...]

Needs the target meamAblation. OUT/poses.csv gets a row for each pose as the bins come, OUT/siblings.md the figures: of bins of
siblings those in which a pose has a place above 0.5, and of bins of the part the right and wrong poses above 0.5. The bins of
seed 901 are those that LookalikeDecision was fitted on; all others had no part in it."""
import argparse
import csv
import os
import sys

import numpy

import ablation
from ablation import SENSOR_PARTS, SENSORS, meam

STRETCHES = [(axis, factor) for factor in (0.8, 0.9, 1.12, 1.25) for axis in (0, 1, 2)]
COLUMNS = ("part", "sibling", "sensor", "seed", "rank", "place", "probability", "continuing", "past", "misfit", "outcome")
COPIES = 20


def sibling(path, axis, factor):
    """The part scaled along one of the CAD file's axes; mirrored by a negative factor."""
    vertices, triangles = meam.sample_part() if path == "ribbed_flange" else meam.read_mesh(path)
    scaled = vertices.copy()
    scaled[:, axis] *= factor
    return meam.Part(scaled, triangles[:, ::-1].copy() if factor < 0 else triangles)


def kinds(k):
    """Four siblings of the part of this number, so that all parts together have each."""
    return [STRETCHES[(k + 5 * i) % len(STRETCHES)] for i in range(4)] + [(0, -1.0)]


def bin_of(folder, name, what, sensor, seed, part):
    """A bin of a sibling as arrays, simulated once."""
    return ablation.stored(os.path.join(folder, f"{name}_{what.replace(' ', '_')}_{sensor}_{seed}.npz"), lambda: dict(zip(
        ("points", "image", "truth", "visible"), meam.simulate(part(), SENSORS.index(sensor), COPIES, seed))))


def cases(parts, sensors, seed):
    for k, name in enumerate(SENSOR_PARTS):
        if name not in parts:
            continue
        path = name if name == "ribbed_flange" else os.path.join(ablation.ROOT, "examples", "parts", name + ".stl")
        part = ablation.part_of(path)
        for sensor in sensors:
            yield name, "none", sensor, seed, part, part
            for axis, factor in kinds(k):
                other = sibling(path, axis, factor)
                if factor > 0 or part.has_mirror_image:
                    what = "mirrored" if factor < 0 else f"{'xyz'[axis]} {factor:g}"
                    yield name, what, sensor, seed, part, other


def rows_of(part, scene, truth, visible):
    search = meam.Search(part, scene)
    found = search.find("none")
    told = meam.judge(part, found["T"], truth, visible, 5.0, ablation.NO_TURNS)
    numbers = zip(*(found[name] for name in COLUMNS[5:-1]))
    for rank, (row, instance, duplicate) in enumerate(zip(numbers, told["instance"], told["duplicate"]), 1):
        yield (rank, *(f"{number:.6g}" for number in row), "right" if instance >= 0 and not duplicate else "wrong")


def report(path, out):
    with open(path, encoding="utf-8") as file:
        rows = list(csv.DictReader(file))
    lines = ["| sensor | bins of siblings | with a place above 0.5 | bins of the part | right above 0.5 | wrong above 0.5 |",
             "|---|---|---|---|---|---|"]
    for sensor in sorted({row["sensor"] for row in rows}):
        of = [row for row in rows if row["sensor"] == sensor]
        absent, present = ([row for row in of if (row["sibling"] == "none") == is_there] for is_there in (False, True))
        def bins(these):
            return {(row["part"], row["sibling"], row["seed"]) for row in these}
        likely = [row for row in absent if row["place"] and float(row["place"]) > 0.5]
        above = [row["outcome"] for row in present if row["place"] and float(row["place"]) > 0.5]
        lines.append(f"| {sensor} | {len(bins(absent))} | {len(bins(likely))} | {len(bins(present))} | "
                     f"{above.count('right')} | {above.count('wrong')} |")
    with open(out, "w", encoding="utf-8") as file:
        file.write("\n".join(lines) + "\n")
    print("\n".join(lines))


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--out", required=True, help="folder")
    parser.add_argument("--seed", type=int, default=902)
    parser.add_argument("--part", nargs="+", default=list(SENSOR_PARTS), choices=SENSOR_PARTS)
    parser.add_argument("--sensor", nargs="+", default=list(SENSORS[:2]), choices=SENSORS)
    options = parser.parse_args()
    os.makedirs(options.out, exist_ok=True)
    path = os.path.join(options.out, "poses.csv")
    done = set()
    if os.path.exists(path):
        with open(path, encoding="utf-8") as file:
            done = {(row["part"], row["sibling"], row["sensor"], row["seed"]) for row in csv.DictReader(file)}
    with open(path, "a", newline="", encoding="utf-8") as file:
        writer = csv.writer(file)
        if not done:
            writer.writerow(COLUMNS)
        for name, what, sensor, seed, part, other in cases(options.part, options.sensor, options.seed):
            key = name, what, sensor, str(seed)
            if key in done:
                continue
            scene = bin_of(os.path.join(options.out, "bins"), name, what, sensor, seed, lambda other=other: other)
            there = what == "none"
            rows = list(rows_of(part, meam.Scan(scene["points"], scene["image"], ablation.NO_EDGES),
                                scene["truth"] if there else ablation.NO_TURNS, scene["visible"] if there else numpy.zeros(0)))
            writer.writerows([*key, *row] for row in rows or [[""] * (len(COLUMNS) - 4)])
            file.flush()
            print(*key, "highest place", max((float(row[1]) for row in rows), default="-"), file=sys.stderr)
    report(path, os.path.join(options.out, "siblings.md"))


if __name__ == "__main__":
    main()
