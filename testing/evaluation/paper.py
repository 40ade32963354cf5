#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""The experiments of the paper (Liu et al., Sensors 2018, Section 6): its tables and Figure 13, with parts of our own in place of
its parts A to D, which were never published, beside the paper's figures.

DIR gets paper.csv, a row for each scene, and poses.csv, one for each pose, from which a run goes on that was stopped, scenes that
failed again; of each table a .md, a .csv and with a display a chart; and the bins."""
import argparse
import collections
import os
import sys

import numpy

from ppfmeam import dataset, evaluation, scripting, simulation

import cells
import charts
import results
import search
import stage
from scenes import TOHOKU, require_found, tohoku_scenes
from search import FOUND, OUTCOMES

PARTS = ("ridged_disc", "arc_lever", "flap", "hole_plate")  # in place of A, B, C and D
METHODS = {"recommended": "PPF-MEAM, recommended", "paper": "PPF-MEAM as in the paper", "without-meam": "B2B-TL without MEAM",
           "ppf": "original PPF", "b2b": "B2B"}
VIEWS = (1, 2, 6, 14, 26)
COPIES = 20  # in a bin
POSES = 5  # wanted of a scene
QUICK = {"scenes": 3, "copies": 6, "bins": 1, "picks": 3, "trials": 1, "views": ("1", "6")}  # a quick run

# What a table of the paper says: by the methods of its rows the values of its columns, and its times where it has both.
Table = collections.namedtuple("Table", "title source columns methods paper unit times note", defaults=({}, ""))


def by_part(parts, views=6):
    return [(letter, {"part": part, "views": str(views)}) for letter, part in parts]


OURS = by_part(zip("ABCD", PARTS))
OF_DATASET = by_part((f"Part {part}", f"tohoku_{part}") for part in TOHOKU)
COMPARED = ("paper", "recommended", "ppf")
ALL = ("paper", "recommended", "without-meam", "ppf", "b2b")
OF_VIEWS = [(str(count), {"part": PARTS[0], "views": str(count)}) for count in VIEWS]
TABLES = {  # the paper's figures by method, column by column; its own method stands for ours in both presets
    1: Table("Table 1. Recognition rate, synthetic scenes with perfect edges", "perfect", OURS, COMPARED,
             {"paper": (100, 99.3, 100, 100), "ppf": (49, 66, 71.3, 90)}, "%"),
    2: Table("Table 2. Speed, synthetic scenes with perfect edges (ms a scene)", "perfect", OURS, COMPARED,
             {"paper": (1276, 401, 987, 892), "ppf": (3033, 1470, 1754, 4430)}, "ms"),
    3: Table("Table 3. Recognition rate, edges of the image (the paper's real scans were never published: a simulated "
             "structured-light sensor)", "image", OURS, COMPARED, {"paper": (97, 97, 98.3, 97), "ppf": (8, 72, 58.3, 89)}, "%"),
    4: Table("Table 4. Speed, edges of the image (ms a scene)", "image", OURS, COMPARED,
             {"paper": (1322, 1353, 1271, 1360), "ppf": (2752, 3673, 1765, 1438)}, "ms"),
    5: Table("Table 5. Recognition rate by the number N of appearance models, part A, edges of the image", "image", OF_VIEWS,
             ("paper",), {"paper": (69, 93, 97, 95, None)}, "%", {"paper": (942, 1140, 1322, None, None)},
             "The paper has no N = 26; its time for N = 14 is not legible for certain, 3360 or 3560 ms."),
    6: Table("Table 6. Recognition rate with MEAM, without it, and of the original PPF, part A, edges of the image", "image",
             OURS[:1], ("paper", "without-meam", "ppf", "b2b", "recommended"),
             {"paper": (97,), "without-meam": (91,), "ppf": (8,)}, "%",
             {"paper": (1322,), "without-meam": (2710,), "ppf": (2752,)}),
    7: Table("Table 7. Recognition rate, Tohoku University 6D Pose Estimation Dataset", "tohoku", OF_DATASET, ALL,
             {"paper": (96.7, 97.3, 100), "ppf": (92, 96.7, 100)}, "%"),
    8: Table("Table 8. Speed, Tohoku University 6D Pose Estimation Dataset (ms a scene)", "tohoku", OF_DATASET, ALL, {}, "ms",
             note="The figures of the paper's Table 8 are not known to us."),
}


def name_of(method):
    """A method as the tables name it."""
    return METHODS.get(method) or method.removeprefix(FOUND)


def with_others(names):
    """The tables, those of the dataset with rows for other programs, too."""
    others = tuple(FOUND + name for name in names)
    return {number: table._replace(methods=table.methods + others) if table.source == "tohoku" else table
            for number, table in TABLES.items()}


def planned(tables, scenes, first=1, copies=COPIES):
    """The searches that the tables need, those of one part and of one scene one after the other."""
    rows = {}
    for table in tables:
        stored = table.source == "tohoku"
        for method in table.methods:
            for _, where in table.columns:
                for seed in range(first, first + scenes):
                    row = {"source": table.source, "method": method, "features": "both", "asked": POSES,
                           "seed": str(seed - first if stored else seed),
                           "sensor": "" if stored else simulation.SENSORS[0], "bin": "" if stored else where["part"],
                           "copies": "" if stored else str(copies), **where}
                    rows[search.key_of(row)] = row
    return sorted(rows.values(), key=lambda row: (row["part"], row["source"], int(row["seed"]), row["method"], int(row["views"])))


def share(part, whole):
    return 100 * part / whole if whole else None


def rows_of(table, searches):
    """Of each method and each column, and of all columns of a method, in %: right poses of those that came out, as the paper
    counts, and of those asked for; the median ms; what the paper says; what became of the poses asked for; the BOP benchmark's
    figures."""
    rows = []
    for method in table.methods:
        known = [[row for row in searches if row["source"] == table.source and row["method"] == method
                  and all(row[name] == value for name, value in where.items())] for _, where in table.columns]
        for k, of in enumerate([*known, sum(known, [])]):
            counts = {name: sum(int(row[name] or 0) for row in of) for name in ("poses", "asked", *OUTCOMES)}
            here = k < len(known)
            rows.append({
                "method": name_of(method), "scenes": table.columns[k][0] if here else "all",
                "rate": share(counts["right"], counts["poses"]),
                "strict": share(counts["right"], counts["asked"]), "ms": results.median(of, "ms"),
                "paper": table.paper[method][k] if here and method in table.paper else None,
                "paper ms": table.times[method][k] if here and method in table.times else None,
                **{name: share(counts[name], counts["asked"]) for name in OUTCOMES},
                "missing": share(counts["asked"] - counts["poses"], counts["asked"]),
                **{name: dataset.mean_of(of, name) for name in dataset.BIN_FIGURES[1:]}})
    return rows


def failures_of(rows):
    """What went wrong in the scenes of a table, a sentence for each reason."""
    reasons = {}
    for row in rows:
        if row["failure"]:
            reasons.setdefault(row["failure"], []).append(row)
    return [f"{len(of)} of {len(rows)} searches failed, first {name_of(of[0]['method'])}, {of[0]['part']}, scene {of[0]['seed']}; "
            f"all their poses are missing: {reason}" for reason, of in reasons.items()]


def wrong_poses(poses):
    """Of poses of the recommended preset those that are wrong, in words."""
    wrong = [f"- {pose['part']}, scene {pose['seed']}, rank {pose['rank']}: {pose['outcome']}, {float(pose['mm']):.1f} mm and "
             f"{float(pose['degrees']):.0f} degrees off, right with {100 * float(pose['probability']):.0f} % as it says itself"
             for pose in poses if pose["outcome"] != OUTCOMES[0]]
    if wrong:
        return "\n".join(["Wrong poses of the recommended preset:", "", *wrong])
    return f"None of the {len(poses)} poses of the recommended preset is wrong." if poses else ""


def lines_of(table, rows):
    """The lines of a table as the paper has it: the name, the values of its columns, the unit."""
    for method in dict.fromkeys(row["method"] for row in rows):
        of = [row for row in rows if row["method"] == method and row["scenes"] != "all"]
        rates = table.unit == "%"
        for name, words, unit in (("rate" if rates else "ms", "", table.unit),
                                  ("strict", ", of the poses asked for", "%" if rates else None),
                                  ("paper", ": the paper says", table.unit),
                                  ("ms", ", ms a scene", "ms" if table.times else None),
                                  ("paper ms", ", ms a scene: the paper says", "ms")):
            if unit and (not name.startswith("paper") or any(row[name] for row in of)):
                yield method + words, [row[name] for row in of], unit


def text_of(number, table, rows, searches, poses):
    """A table in Markdown, with what the poses are where it compares methods."""
    names = [name for name, _ in table.columns]
    averaged, lines = len(names) > 1 and table.columns is not OF_VIEWS, []
    for name, values, unit in lines_of(table, rows):
        if averaged:
            values = [*values, None if None in values else float(numpy.mean(values))]
        lines.append([name, *("-" if value is None else f"{value:.1f} %" if unit == "%" else f"{value:.0f}" for value in values)])
    parts = [table.title + ".", results.markdown(["method", *names, *(["average"] if averaged else [])], lines), table.note]
    if table.unit == "%" and len(table.methods) > 1:
        kinds = (*OUTCOMES, "missing", *(dataset.BIN_FIGURES[1:] if table.source == "image" else ()))
        parts += [f"The poses of Table {number}, of those asked for" + (
            "; and the BOP benchmark's recalls over copies of which at least a tenth is visible, AP2-20 by the ranks in each bin."
            if table.source == "image" else "."), results.markdown(["method", *kinds], [
                [row["method"], *("-" if row[name] is None else f"{row[name]:.1f} %" for name in kinds)] for row in rows
                if row["scenes"] == "all"]),
            wrong_poses([pose for pose in poses if pose["method"] == "recommended" and int(pose["rank"]) <= POSES])]
    return "\n\n".join(filter(None, (*parts, *failures_of(searches)))) + "\n"


def write(number, table, searches, poses, folder):
    """DIR/tableN.md, .csv and, with a display, .png; returns the text and the rows."""
    used = [[row for row in each if row["source"] == table.source and row["method"] in table.methods
             and any(all(row[name] == value for name, value in where.items()) for _, where in table.columns)]
            for each in (searches, poses)]
    rows = rows_of(table, searches)
    text, path = text_of(number, table, rows, *used), os.path.join(folder, f"table{number}")
    results.write(path + ".csv", rows)
    with scripting.written(path + ".md") as file:
        file.write(text)
    bars = {name.replace(": the paper says", " (paper)"): values for name, values, unit in lines_of(table, rows)
            if unit == table.unit and not name.endswith("asked for")}
    charts.bars(path + ".png", table.title.partition(" (")[0], [name for name, _ in table.columns], bars, table.unit)
    return text, rows


def found_by(text):
    """For argparse: NAME=DIR."""
    name, equals, folder = text.partition("=")
    if not (name and equals and folder):
        raise argparse.ArgumentTypeError(f"it has to be NAME=DIR, not {text}")
    return name, folder


def options_of_user():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    which = parser.add_mutually_exclusive_group(required=True)
    which.add_argument("--table", type=evaluation.numbers, metavar="N,...", help="such as 1,2 or 5-8")
    which.add_argument("--figure", type=int, choices=(13,), metavar="13", help="the stage: relative errors of moves and turns")
    which.add_argument("--all", action="store_true", help="all of them")
    parser.add_argument("--scenes", type=scripting.count, default=30, help="of each part (default: %(default)s)")
    parser.add_argument("--quick", action="store_true",
                        help=f"to see it run: {QUICK['scenes']} scenes of each part, {QUICK['copies']} copies, "
                             f"{' and '.join(QUICK['views'])} appearance models, of Table 9 one bin of {QUICK['picks']} parts and of Figure 13 one trial")
    parser.add_argument("--seed", type=scripting.count, default=1, help="of the first bin, the next has the next one")
    parser.add_argument("--copies", type=scripting.count, default=COPIES, help="in a bin (default: %(default)s)")
    parser.add_argument("--tohoku", metavar="DIR", help="where the Tohoku dataset is, for tables 7 and 8")
    parser.add_argument("--found", metavar="NAME=DIR", type=found_by, action="append", default=[],
                        help="in tables 7 and 8 also the poses that another program left in DIR/Part_P/transI.txt, best first, 16 "
                             "numbers each, and its times, where DIR/seconds.txt has lines such as "
                             "Part_1/Scenes/Scene0.pcd 0.5; again for more")
    parser.add_argument("--threads", type=scripting.count, default=0, help="threads to work with; 0: all cores (default)")
    parser.add_argument("--out", metavar="DIR", required=True, help="folder to write")
    return parser.parse_args()


def tables_of(options):
    """The numbers of the tables to make of scenes; says what is wrong with the options."""
    numbers = list(TABLES) if options.all else options.table or []
    for number in numbers:
        if number not in TABLES and number != 9:
            raise scripting.Failure(f"there is no table {number}; known are 1 to 9")
    for name in ("scenes", "copies"):
        if getattr(options, name) < 1:
            raise scripting.Failure(f"--{name} has to be 1 or more")
    of_dataset = [number for number in numbers if number in TABLES and TABLES[number].source == "tohoku"]
    if options.tohoku and not os.path.isdir(options.tohoku):
        raise scripting.Failure(f"cannot read {options.tohoku}: --tohoku has to be the folder that holds Part_1 to Part_3")
    if of_dataset and not options.tohoku:
        if not options.all:
            raise scripting.Failure(f"table {of_dataset[0]} needs the Tohoku dataset: --tohoku DIR")
        print("tables 7 and 8 are left out: they need the Tohoku dataset, --tohoku DIR", file=sys.stderr)
        numbers = [number for number in numbers if number not in of_dataset]
    if options.found and not (of_dataset and options.tohoku):
        raise scripting.Failure("--found is for tables 7 and 8, which need --tohoku DIR")
    for _, folder in options.found:
        require_found(folder, TOHOKU)
    return [number for number in numbers if number != 9]


def measure(out, numbers, scenes=30, copies=COPIES, seed=1, tohoku=None, found=(), threads=0, views=None):
    """Makes tables; returns their rows, each with the number of its table."""
    tables, found = with_others(dict(found)), dict(found)
    # Of the dataset as many scenes as there are, and of a part that is not there one, which says so.
    there = {f"tohoku_{part}": tohoku_scenes(tohoku, part, scenes) or [0] for part in TOHOKU} if tohoku else {}
    wanted = [row for row in planned([tables[number] for number in numbers], scenes, seed, copies)
              if (row["source"] != "tohoku" or int(row["seed"]) in there[row["part"]])
              and not (views and row["views"] not in views)]
    searches, poses = search.Searches(out, "paper").measure(wanted, search.Scenes(os.path.join(out, "bins"), tohoku, found),
                                                            threads)
    rows = []
    for number in numbers:
        text, of_table = write(number, tables[number], searches, poses, out)
        print(text, flush=True)
        rows += [{"table": number, **row} for row in of_table]
    return rows


def main():
    options = options_of_user()
    numbers, quick = tables_of(options), QUICK if options.quick else {}
    scripting.make_folder(options.out)
    scenes, copies = (min(getattr(options, name), quick.get(name, 10 ** 6)) for name in ("scenes", "copies"))
    measure(options.out, numbers, scenes, copies, options.seed, options.tohoku, options.found, options.threads,
            quick.get("views"))
    if options.all or 9 in (options.table or ()):
        print(cells.table9(options.out, [PARTS[0]], [simulation.SENSORS[0]], "cup", min(quick.get("bins", cells.BINS), scenes),
                           quick.get("picks", cells.COPIES), options.seed, options.threads)[0], flush=True)
    if options.all or options.figure:
        print(stage.run(options.out, PARTS[0], "recommended", options.threads, options.seed,
                        quick.get("trials", stage.TRIALS))[0], flush=True)
    charts.tell_of_display()
    results.require_whole()


if __name__ == "__main__":
    scripting.run(main)
