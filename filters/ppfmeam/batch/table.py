# SPDX-License-Identifier: BSD-3-Clause
"""What a run writes: the poses in the order of the scans, and beside them what depends on the machine."""
import csv
import os

from .. import scripting

POSES = ("scan", "obj_id", "rank", "score", "place_probability", "probability", "R", "t", "calibration", "failure")
SCANS = ("scan", "poses", "read_s", "find_s", "process", "warning", "failure", "advice")


def rows_of(poses, objects, calibrations):
    """Of poses, best first, what stands in the table after the scan's name. `objects`: the numbers of the parts;
    `calibrations`: of their models."""
    array = poses.GetPointData().GetArray
    part, scores, places, probabilities, transforms = map(
        array, ("PartId", "Score", "PlaceProbability", "Probability", "Transform"))
    rows = []
    for i in range(poses.GetNumberOfPoints()):
        T = transforms.GetTuple(i)
        R, t = (*T[0:3], *T[4:7], *T[8:11]), (T[3], T[7], T[11])
        of = part.GetValue(i) if part else 0
        rows.append((objects[of], i + 1, repr(scores.GetValue(i)), repr(places.GetValue(i)), repr(probabilities.GetValue(i)),
                     *(" ".join(map(repr, numbers)) for numbers in (R, t, calibrations[of])), ""))
    return rows


def content_of(names, lines):
    """All scans with their poses, for JSON."""
    def pose(row):
        told = dict(zip(POSES[1:], row))
        return {**{name: float(told[name]) for name in POSES[3:6]}, **{name: list(map(float, told[name].split())) for name in ("R", "t")},
                "obj_id": told["obj_id"], "rank": told["rank"]}

    return {"scans": [{"scan": name, "read_s": float(lines[name]["read_s"]), "find_s": float(lines[name]["find_s"]),
                       **{column: lines[name][column] for column in ("failure", "warning", "advice")},
                       "poses": [pose(row) for row in lines[name]["rows"]]} for name in names]}


def path_of_scans(path):
    """Where the second table goes: poses.csv has poses.scans.csv beside it."""
    name, extension = os.path.splitext(path)
    return f"{name}.scans{extension}"


def write(path, names, lines):
    """Both tables, of these scans in this order. A scan that failed, or where nothing was found, has one row."""
    def poses():
        for name in names:
            line = lines[name]
            yield from ([name, *row] for row in line["rows"] or [[*[""] * (len(POSES) - 2), line["failure"]]])

    def scans():
        for name in names:
            line = lines[name]
            yield [name, len(line["rows"]), *(line[column] for column in SCANS[2:])]

    for to, columns, rows in ((path_of_scans(path), SCANS, scans()), (path, POSES, poses())):
        with scripting.written(to, newline="") as file:
            writer = csv.writer(file, lineterminator="\n")
            writer.writerow(columns)
            writer.writerows(rows)
