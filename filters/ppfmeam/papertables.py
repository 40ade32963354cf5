# SPDX-License-Identifier: BSD-3-Clause
"""The tables of the paper (Liu et al., Sensors 2018, Section 6): its figures, which searches they need, and ours written
beside them."""
import csv
import io
import math
import os

import numpy

from . import charts, dataset, scripting

PARTS = ("ridged_disc", "arc_lever", "flap", "hole_plate")  # in place of A, B, C and D
LETTERS = "ABCD"
METHODS = {"recommended": "PPF-MEAM, recommended", "paper": "PPF-MEAM as in the paper", "without-meam": "B2B-TL without MEAM",
           "ppf": "original PPF", "b2b": "B2B"}
FOUND = "found "  # begins the name of a method of another program, which has left its poses
VIEWS = (1, 2, 6, 14, 26)
COPIES = 20  # in a bin
RUN = ("source", "part", "method", "views", "seed", "copies")  # a search in a scene
OUTCOMES = ("right", "duplicate", "wrong turn", "wrong place")  # of a pose, by vtkMEAMPoseEvaluation's numbers
ROW = (*RUN, "poses", *OUTCOMES, "asked", *dataset.BIN_FIGURES, "ms", "failure")
POSE = (*RUN, "rank", "probability", "outcome", "mm", "degrees")


class Figure:
    """What a table of the paper says: by the methods of its rows the values of its columns, and its times where it has
    both; `note`: what has to be known of it."""

    def __init__(self, title, source, columns, methods, paper, value, times=None, note=""):
        self.title, self.source, self.columns, self.methods = title, source, columns, methods
        self.paper, self.value, self.times, self.note = paper, value, times, note


def rate(rows):
    """Percent of the poses that come out, as the paper counts."""
    poses = sum(int(row["poses"] or 0) for row in rows)
    return 100 * sum(int(row["right"] or 0) for row in rows) / poses if poses else math.nan


def strict(rows):
    """Percent of the poses asked for: a missing one is wrong."""
    asked = sum(int(row["asked"]) for row in rows)
    return 100 * sum(int(row["right"] or 0) for row in rows) / asked if asked else math.nan


def milliseconds(rows):
    times = [float(row["ms"]) for row in rows if row["ms"]]
    return float(numpy.median(times)) if times else math.nan


def by_part(parts, views=6):
    return [(letter, {"part": part, "views": str(views)}) for letter, part in parts]


OURS = by_part(zip(LETTERS, PARTS))
TOHOKU = by_part((f"Part {part}", f"tohoku_{part}") for part in (1, 2, 3))
COMPARED = ("paper", "recommended", "ppf")
ALL = ("paper", "recommended", "without-meam", "ppf", "b2b")
OF_VIEWS = [(str(count), {"part": PARTS[0], "views": str(count)}) for count in VIEWS]
OF_PART_A = [("A", {"part": PARTS[0], "views": "6"})]
TABLES = {  # the paper's figures by method, column by column; its own method stands for ours in both presets
    1: Figure("Table 1. Recognition rate, synthetic scenes with perfect edges", "perfect", OURS, COMPARED,
              {"paper": (100, 99.3, 100, 100), "ppf": (49, 66, 71.3, 90)}, rate),
    2: Figure("Table 2. Speed, synthetic scenes with perfect edges (ms a scene)", "perfect", OURS, COMPARED,
              {"paper": (1276, 401, 987, 892), "ppf": (3033, 1470, 1754, 4430)}, milliseconds),
    3: Figure("Table 3. Recognition rate, edges of the image (the paper's real scans were never published: a simulated "
              "structured-light sensor)", "image", OURS, COMPARED, {"paper": (97, 97, 98.3, 97), "ppf": (8, 72, 58.3, 89)}, rate),
    4: Figure("Table 4. Speed, edges of the image (ms a scene)", "image", OURS, COMPARED,
              {"paper": (1322, 1353, 1271, 1360), "ppf": (2752, 3673, 1765, 1438)}, milliseconds),
    5: Figure("Table 5. Recognition rate by the number N of appearance models, part A, edges of the image", "image", OF_VIEWS,
              ("paper",), {"paper": (69, 93, 97, 95, None)}, rate, {"paper": (942, 1140, 1322, None, None)},
              "The paper has no N = 26; its time for N = 14 is not legible for certain, 3360 or 3560 ms."),
    6: Figure("Table 6. Recognition rate with MEAM, without it, and of the original PPF, part A, edges of the image", "image",
              OF_PART_A, ("paper", "without-meam", "ppf", "b2b", "recommended"),
              {"paper": (97,), "without-meam": (91,), "ppf": (8,)}, rate, {"paper": (1322,), "without-meam": (2710,), "ppf": (2752,)}),
    7: Figure("Table 7. Recognition rate, Tohoku University 6D Pose Estimation Dataset", "tohoku", TOHOKU, ALL,
              {"paper": (96.7, 97.3, 100), "ppf": (92, 96.7, 100)}, rate),
    8: Figure("Table 8. Speed, Tohoku University 6D Pose Estimation Dataset (ms a scene)", "tohoku", TOHOKU, ALL, {}, milliseconds,
              note="The figures of the paper's Table 8 are not known to us."),
}


def name_of(method):
    """A method as the tables name it."""
    return METHODS.get(method) or method.removeprefix(FOUND)


def with_others(names):
    """The tables, those of the dataset with rows for other programs, too."""
    others = tuple(FOUND + name for name in names)
    return {number: table if table.source != "tohoku" else
            Figure(table.title, table.source, table.columns, table.methods + others, table.paper, table.value, table.times, table.note)
            for number, table in TABLES.items()}


def planned(tables, scenes, first, copies=COPIES):
    """The searches that the tables need, those of one part and of one scene one after the other."""
    rows = {}
    for table in tables:
        for method in table.methods:
            for _, where in table.columns:
                for seed in range(first, first + scenes):
                    at = seed - first if table.source == "tohoku" else seed
                    row = {"source": table.source, "method": method, "seed": str(at),
                           "copies": "" if table.source == "tohoku" else str(copies), **where}
                    rows[run_of(row)] = row
    return sorted(rows.values(), key=lambda row: (row["part"], row["source"], int(row["seed"]), row["method"], int(row["views"])))


def run_of(row):
    """Which search a row is of."""
    return tuple(row[name] for name in RUN)


def belongs(row, table, method, where):
    return row["source"] == table.source and row["method"] == method and all(row[name] == value for name, value in where.items())


def markdown(head, rows):
    return "\n".join("| " + " | ".join(row) + " |" for row in (head, ["---"] * len(head), *rows)).replace("| --- ", "|---")


def write_text(folder, name, text):
    with scripting.written(os.path.join(folder, name)) as file:
        file.write(text)
    return text


def write_csv(folder, name, head, rows):
    """Numbers as numbers; None and NaN are empty."""
    text = io.StringIO()
    writer = csv.writer(text, lineterminator="\n")
    writer.writerow(head)
    writer.writerows([words, *("" if value is None or value != value else f"{value:.2f}" for value in values)]
                     for words, values in rows)
    write_text(folder, name, text.getvalue())


def failures_of(rows):
    """What went wrong in the scenes of a table, a sentence for each reason."""
    reasons = {}
    for row in rows:
        if row["failure"]:
            reasons.setdefault(row["failure"], []).append(row)
    return [f"{len(of)} of {len(rows)} searches failed, first {name_of(of[0]['method'])}, {of[0]['part']}, scene {of[0]['seed']}; all "
            f"their poses are missing: {reason}" for reason, of in reasons.items()]


def wrong_poses(poses):
    """Of poses of the recommended preset those that are wrong, in words."""
    wrong = [f"- {pose['part']}, scene {pose['seed']}, rank {pose['rank']}: {pose['outcome']}, {float(pose['mm']):.1f} mm and "
             f"{float(pose['degrees']):.0f} degrees off, right with {100 * float(pose['probability']):.0f} % as it says itself"
             for pose in poses if pose["outcome"] != OUTCOMES[0]]
    if wrong:
        return "\n".join(["Wrong poses of the recommended preset:", "", *wrong])
    return f"None of the {len(poses)} poses of the recommended preset is wrong." if poses else ""


def details(number, table, rows, poses, folder):
    """What the poses of a table are, which of the recommended preset are wrong, and the figures of the BOP benchmark where it
    has them, in Markdown, which is also written, with the table as CSV."""
    figures = dataset.BIN_FIGURES[1:] if table.source == "image" else ()
    lines = []
    for method in table.methods:
        of_method = [row for row in rows for _, where in table.columns if belongs(row, table, method, where)]
        asked = sum(int(row["asked"]) for row in of_method)
        counts = [sum(int(row[name] or 0) for row in of_method) for name in OUTCOMES]
        shares = [100 * count / asked if asked else None for count in (*counts, asked - sum(counts))]
        lines.append((name_of(method), [*shares, *(dataset.mean_of(of_method, name) for name in figures)]))
    head = ["method", *OUTCOMES, "missing", *figures]
    about = (f"The poses of Table {number}, of those asked for"
             + ("; and the BOP benchmark's recalls over copies of which at least a tenth is visible, AP2-20 by the ranks in each bin."
                if figures else "."))
    cells = [[name, *("-" if value is None else f"{value:.1f} %" for value in values)] for name, values in lines]
    write_csv(folder, f"table{number}_poses.csv", head, lines)
    wrong = wrong_poses([pose for pose in poses for _, where in table.columns if belongs(pose, table, "recommended", where)])
    return write_text(folder, f"table{number}_poses.md", "\n\n".join(filter(None, (about, markdown(head, cells), wrong))) + "\n")


def written(number, table, rows, folder):
    """The table in Markdown, which is also written, as CSV and, where there is a display, as a chart."""
    names = [name for name, _ in table.columns]
    lines, bars, mean = [], {}, len(names) > 1 and table.columns is not OF_VIEWS
    unit, used = " %" if table.value is rate else "", []
    for method in table.methods:
        of_method = [[row for row in rows if belongs(row, table, method, where)] for _, where in table.columns]
        used += sum(of_method, [])
        name, paper = name_of(method), table.paper.get(method)
        bars[name] = [table.value(of) for of in of_method]
        lines.append((name, bars[name], unit))
        if unit:
            lines.append((name + ", of the poses asked for", [strict(of) for of in of_method], unit))
        if paper:
            lines.append((name + ": the paper says", paper, unit))
            bars[name + " (paper)"] = [math.nan if value is None else value for value in paper]
        if table.times:
            lines.append((name + ", ms a scene", [milliseconds(of) for of in of_method], ""))
            if method in table.times:
                lines.append((name + ", ms a scene: the paper says", table.times[method], ""))

    def cells(values, unit):
        known = [value for value in values if value is not None and not math.isnan(value)]
        if mean:
            values = [*values, numpy.mean(known) if len(known) == len(values) else None]
        return ["-" if value is None or math.isnan(value) else f"{value:.{1 if unit else 0}f}{unit}" for value in values]

    text = "\n\n".join(filter(None, (
        table.title + ".", markdown(["method", *names, *(["average"] if mean else [])],
                                    [[name, *cells(values, unit)] for name, values, unit in lines]),
        table.note, *failures_of(used)))) + "\n"
    write_csv(folder, f"table{number}.csv", ["method", *names], [(name, values) for name, values, _ in lines])
    charts.bars(os.path.join(folder, f"table{number}.png"), table.title.partition(" (")[0], names, bars,
                "%" if unit else "ms a scene")
    return write_text(folder, f"table{number}.md", text)
