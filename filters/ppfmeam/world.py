# SPDX-License-Identifier: BSD-3-Clause
"""What was found in bins of many parts and sensors: files that a killed run leaves whole, and the table of it."""
import csv
import io
import os

import numpy

from . import dataset, scripting

BIN = ("part", "features", "sensor", "seed", "copies", "bin")  # a search; `bin`: the part that lies in it
KIND = ("part", "sensor", "features")  # that a line of the table is of
# `right`, `mm` and `degrees` are of the poses asked for.
ROW = (*BIN, "half_visible", "half_visible_found", "poses", "asked", "right", "mm", "degrees", *dataset.BIN_FIGURES, "ms",
       "failure")
POSE = (*BIN, "rank", "probability", "right", "found", "mm", "degrees")  # `found`: a copy that is half visible, for the
# first time; empty of a copy that is less visible
CLASS = 100  # poses whose probabilities are compared with a rate
DRAWS = 400  # of which poses are right, by what they claim
HEAD = ("| part | sensor | features | best five right | recall | R@99 | AR | AP2-20 | mm | degrees | claim - rate | without the part | ms | "
        "failed |\n" + "|---" * 14 + "|")


class Lines:
    """A CSV file that grows by whole lines: what an earlier run left of the last one is dropped."""

    def __init__(self, path, columns, keep=lambda row: True):
        self.path, self.rows = path, []
        if os.path.exists(path):
            whole = scripting.whole_lines(path)
            self.rows = [row for row in csv.DictReader(whole) if keep(row)]
            if whole and next(csv.reader(whole[:1])) != list(columns):
                raise scripting.Failure(f"{path} is not of this version: remove it, or choose another folder")
        with scripting.written(path, newline="") as file:
            self.write(file, columns, self.rows, head=True)
        self.columns = columns

    @staticmethod
    def write(file, columns, rows, head=False):
        writer = csv.DictWriter(file, columns, lineterminator="\n")
        if head:
            writer.writeheader()
        writer.writerows(rows)

    def add(self, rows):
        text = io.StringIO()
        self.write(text, self.columns, rows)
        with scripting.writing(self.path), open(self.path, "ab", buffering=0) as file:
            scripting.append(file, text.getvalue())
        self.rows += [{name: str(value) for name, value in row.items()} for row in rows]


def bin_of(row):
    return tuple(str(row[name]) for name in BIN)


class Record:
    """The bins that are done: DIR/world.csv, a row for each; DIR/poses.csv, the poses found in them; DIR/world.md."""

    def __init__(self, folder):
        scripting.make_folder(folder)
        self.folder = folder
        self.bins = Lines(os.path.join(folder, "world.csv"), ROW)
        done = set(map(bin_of, self.bins.rows))
        self.poses = Lines(os.path.join(folder, "poses.csv"), POSE, lambda row: bin_of(row) in done)
        self.done = done

    def add(self, row, poses):
        """A bin and its poses; the bin's row last, with it the bin is done."""
        self.poses.add(poses)
        self.bins.add([row])
        self.done.add(bin_of(row))

    def table(self, bins):
        """Of these bins the table in Markdown, which is also written."""
        rows = [row for row in self.bins.rows if bin_of(row) in bins]
        poses = [row for row in self.poses.rows if bin_of(row) in bins]
        lines = [HEAD]

        def add(names, words):
            """A line for each of the kinds that differ in `names`."""
            def kind_of(row):
                return tuple(row[name] for name in names)
            for kind in dict.fromkeys(map(kind_of, rows)):
                of_kind = ([row for row in each if kind_of(row) == kind] for each in (rows, poses))
                lines.append(line((*words, *kind), *of_kind))

        add(KIND, ())
        if len(lines) > 2:
            add(KIND[1:], ("all",))
            add(KIND[2:], ("all", "all"))
        gaps = []
        for features in dict.fromkeys(row["features"] for row in rows):
            gaps.append(f"Features {features}: " + largest_gap([row for row in poses if row["features"] == features]))
        text = "\n".join(lines) + "\n\n" + "\n".join(gaps) + "\n"
        with scripting.written(os.path.join(self.folder, "world.md")) as file:
            file.write(text)
        return text


def values(rows, name):
    """A column as numbers, without what is empty."""
    return numpy.array([float(row[name]) for row in rows if row[name] != ""])


def line(kind, rows, poses):
    """A line of the table: bins that hold the part, but for the probabilities, which are of all."""
    def percent(value):
        return "-" if value is None else f"{value:.1f} %"

    def share(part, whole):
        return percent(100 * part.sum() / whole.sum() if whole.sum() else None)

    def median(column, digits):
        return f"{numpy.median(column):.{digits}f}" if column.size else "-"

    there = [row for row in rows if row["bin"] == row["part"]]
    asked = {bin_of(row): int(row["asked"]) or int(row["poses"] or 0) for row in rows}
    right = [row for row in poses if row["right"] == "1" and int(row["rank"]) <= asked[bin_of(row)]]
    claims = values(poses, "probability")
    absent = values([row for row in poses if row["bin"] != row["part"]], "probability")
    cells = (*kind, share(values(there, "right"), values(there, "asked")),
             share(values(there, "half_visible_found"), values(there, "half_visible")),
             percent(recall_at_precision_99(poses, values(there, "half_visible").sum())),
             *(percent(dataset.mean_of(there, name)) for name in ("AR", "AP2-20")),
             median(values(right, "mm"), 3), median(values(right, "degrees"), 3),
             f"{100 * (claims.mean() - values(poses, 'right').mean()):+.1f} %" if claims.size else "-",
             f"{100 * absent.max():.0f} %" if absent.size else "-", median(values(there, "ms"), 0),
             sum(row["failure"] != "" for row in rows))
    return "| " + " | ".join(map(str, cells)) + " |"


def recall_at_precision_99(poses, instances):
    """In %, as vtkMEAMPoseEvaluation has it: found by the likeliest poses, as many as may be with 99 of 100 right; None
    without instances."""
    if not instances:
        return None
    ranked = sorted((row for row in poses if row["found"] != ""), key=lambda row: -float(row["probability"]))
    right = numpy.cumsum([row["found"] == "1" for row in ranked])
    return 100 * max([0, *right[100 * right >= 99 * numpy.arange(1, len(ranked) + 1)]]) / instances


def largest_gap(poses):
    """Of the poses in the order of their probabilities, a hundred at a time, those whose rate is farthest from them."""
    claims, right = values(poses, "probability"), values(poses, "right")
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
