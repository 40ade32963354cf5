# SPDX-License-Identifier: BSD-3-Clause
"""docs/evaluation.md, the table of README.md, and what decisions are worth in docs/parameters.md and docs/method.md, from the
CSV files of docs/evaluation/."""
import os
import re

from ppfmeam import scripting

from results import markdown, read, words_of

HEAD = """# Evaluation

What was measured: ten tables, and all figures as CSV files in [evaluation/](evaluation). `testing/evaluation/run.py --only NAME`
measures one again and writes this page from the files. Each was measured at the commit beside it, on two processors of an AMD
EPYC, which may have had other work.

- *strict*: right poses of those asked for, five a scene, each copy once; a missing pose is wrong. Right is within 10 % of D and 5
  degrees. *first*: scenes whose first pose is right.
- *recall*, *AP*: of copies at least half visible, by all poses. *R@99*: recall by the likeliest poses, as long as 99 % of them are
  right. *AR*, *AP2-20*: the BOP benchmark's, of copies at least a tenth visible.
- *mm*, *degrees*: median errors of the right poses. *ms*: medians, without training.
"""
FIGURES = {"strict": ("strict", 0, " %"), "top1": ("first", 0, " %"), "recall": ("recall", 1, " %"),
           "recall_99": ("R@99", 1, " %"),
           "AP": ("AP", 1, " %"), "AP_mm": ("AP2-20", 1, " %"), "AR": ("AR", 1, " %"), "mm": ("mm", 3, ""),
           "deg": ("degrees", 3, ""), "ms": ("ms", 0, "")}


def number(row, name, digits=1, unit=""):
    """A value of a CSV file, rounded."""
    return words_of(float(row[name]), digits) + unit if row.get(name) else "-"


def columns_of(rows, first, names, **others):
    """A table of FIGURES, `first` (heading and value of a row) before them and `others` (name: heading, digits, unit) behind."""
    figures = {**{name: FIGURES[name] for name in names}, **others}
    return markdown((first[0], *(heading for heading, _, _ in figures.values())),
                    [(first[1](row), *(number(row, name, digits, unit) for name, (_, digits, unit) in figures.items()))
                     for row in rows])


def of_tohoku(rows):
    return columns_of(rows, ("", lambda row: f"Part {row['part']}"), ("strict", "top1", "recall", "recall_99", "mm", "deg"), **{
        "ms": ("ms a scene, 2 threads", 0, ""), "ms, 1 thread": ("1 thread", 0, ""),
        "preset Paper: strict": ("preset `Paper`", 0, " %"),
        "the paper": ("in the paper (Table 7)", 1, " %")})


def of_bins(rows):
    return columns_of(rows, ("part", lambda row: row["part"]),
                      ("strict", "recall", "recall_99", "AR", "AP_mm", "mm", "deg", "ms"))


def of_world(rows):
    sensors = list(dict.fromkeys(row["sensor"] for row in rows if row["sensor"] != "all"))
    lines = {}
    for row in rows:
        if row["features"] == "both" or row["part"] == "all":
            name = row["part"] if row["features"] == "both" else f"all, by {row['features']} alone"
            lines.setdefault(name, {})[row["sensor"]] = ", ".join(number(row, figure, 0) for figure in ("strict", "recall", "AR"))
    return markdown(("%: strict, recall, AR", *sensors),
                    [(name, *(line[sensor] for sensor in sensors)) for name, line in lines.items()])


def of_probabilities(rows):
    return markdown(("probability", "poses", "right", "mean probability"), [
        (row["probability"], row["poses"], number(row, "right", 1, " %"), number(row, "mean probability", 1, " %"))
        for row in rows])


def of_rings(rows):
    return markdown(("edges", "met", "median error", "met on average of 20 seeds", "least to most"), [
        (row["edges"], f"{row['met']} of {row['known']}", f"{number(row, 'mm', 2)} mm, {number(row, 'degrees', 2)} degrees",
         number(row, "met on average"), f"{row['least']} to {row['most']}") for row in rows])


def of_known(rows):
    parts = {part: [row for row in rows if row["part"] == part] for part in dict.fromkeys(row["part"] for row in rows)}
    return markdown(("part", "scans", "known poses", "met"), [
        (part, len(of), *(sum(int(row[name]) for row in of) for name in ("known", "met"))) for part, of in parts.items()])


def of_paper(rows):
    methods = ("PPF-MEAM, recommended", "PPF-MEAM as in the paper", "original PPF")
    lines = []
    for table, words in (("1", "perfect edges, %"), ("3", "edges of the image, %"), ("7", "Tohoku dataset, %"),
                         ("2", "perfect edges, ms"),
                         ("4", "edges of the image, ms"), ("8", "Tohoku dataset, ms")):
        line = [f"{table}: {words}"]
        for method in methods:
            of = [row for row in rows if row["table"] == table and row["method"] == method and row["scenes"] != "all"]
            for name in ("rate" if words.endswith("%") else "ms", "paper"):
                known = [float(row[name]) for row in of if row[name]]
                line.append(words_of(sum(known) / len(known), 0 if words.endswith("ms") else 1) if known else "-")
        lines.append([*line[:2], *line[3:]])  # the paper has no figure of ours
    return markdown(("table", "ours", "preset `Paper`", "the paper says", "original PPF", "the paper says of it"), lines)


def of_cell(rows):
    names = ("part", "sensor", "gripper", "trials", "success", "left in the bins", "detection ms", "planning ms")
    return markdown((*names[:5], "left", *names[6:]), [[row[name] or "-" for name in names] for row in rows])


def pivot(rows, first, second, value):
    """`first` down and `second` across, tuples of a heading and a function of a row, the cells by another."""
    across = list(dict.fromkeys(map(second, rows)))
    lines = {}
    for row in rows:
        lines.setdefault(first[1](row), {})[second(row)] = value(row)
    return markdown((first[0], *across), [(name, *(line.get(other, "-") for other in across)) for name, line in lines.items()])


def of_rivals(rows):
    return pivot(rows, ("strict (recall), %", lambda row: f"{row['program']}, {number(row, 's', 2)} s"),
                 lambda row: f"Part {row['part']}",
                 lambda row: f"{number(row, 'strict', 0)} ({number(row, 'recall', 0)})")


def of_speed(tohoku, bins, edges, voting):
    def benchmark(rows, name):
        return next(row for row in rows if row["benchmark"] == name)

    def across(rows, name):
        values = sorted(float(row[name]) for row in rows)
        return f"{values[0]:.0f} to {values[-1]:.0f} ms"

    stages = {name: [float(row[name]) for row in tohoku] for name in tohoku[0] if name.endswith("_ms")}
    largest = max(stages, key=lambda name: sum(stages[name]))
    return markdown(("", "time"), [
        ("a scene of the Tohoku dataset, one thread", across(tohoku, "ms, 1 thread")), ("two threads", across(tohoku, "ms")),
        (f"of this the longest stage, {largest.removesuffix('_ms').lower()}",
         f"{min(stages[largest]):.0f} to {max(stages[largest]):.0f} ms"),
        ("a simulated scan of 960 x 768 points, 20 copies, two threads", across(bins, "ms")),
        ("edges of an image of 1280 x 1024, two threads", number(benchmark(edges, "ImageEdges/3/2"), "ms", 0, " ms")),
        ("edges of its depth", number(benchmark(edges, "DepthEdgesAndCreases/3/2"), "ms", 0, " ms")),
        ("votes a second, two threads", f"{float(benchmark(voting, 'Voting/tohoku/2')['rate']) / 1e6:.0f} million")])


# Anchor: heading, the CSV files, what makes the table of their rows, and what has to be known of it.
SECTIONS = {
    "tohoku": ("Tohoku dataset", ("tohoku",), of_tohoku,
               "20 scenes of each part. The paper counts right poses among those that came out, of 30 scenes."),
    "bins": ("Simulated bins", ("bins",), of_bins,
             "20 bins of 20 copies of each part, seeds that nothing was fitted on, edges of the sensor's image."),
    "world": ("Parts and sensors", ("world",), of_world, "Two bins of 20 copies of each part and sensor, by edges and surface."),
    "calibration-bins": ("How likely a pose is right", ("calibration-bins",), of_probabilities,
                         "All poses of the simulated bins above; three of the parts had none in the fit."),
    "rings": ("A real scan", ("rings",), of_rings, "Ten rings on a plate; the true poses were made by ICP."),
    "known": ("Real scans of other sensors", ("known",), of_known,
              "Known poses that one of the ten best meets, within 10 % of D and 10 degrees; not all copies are known."),
    "paper": ("The paper's experiments", ("paper",), of_paper,
              "Means over four parts of our own: the paper's parts and scans were never published."),
    "cell": ("The picking cell", ("cell",), of_cell,
             "The paper's Table 9, simulated: five bins of 12 parts each ([picking.md](picking.md#a-cell-simulated))."),
    "rivals": ("What others would use instead", ("rivals",), of_rivals,
               "Ten scenes of each part, processor time a scene. PCL returns one pose: 20 % is all."),
    "speed": ("Speed", ("tohoku", "bins", "scene-edges", "voting"), of_speed, ""),
}


def stamp_of(names, tables):
    return "; ".join("[{0}.csv](evaluation/{0}.csv), {date}, {commit}".format(name, **tables[name][0]) for name in names)


def page(folder, titles):
    """The text, of the files that are there. `titles`: of every table."""
    tables = {name: read(os.path.join(folder, name + ".csv")) for name in titles
              if os.path.exists(os.path.join(folder, name + ".csv"))}
    parts = [HEAD]
    for anchor, (title, names, make, text) in SECTIONS.items():
        if all(name in tables for name in names):
            parts += [f'<a id="{anchor}"></a>\n## {title}', f"*{stamp_of(names, tables)}*", *([text] if text else []),
                      make(*(tables[name] for name in names))]
    shown = set(SECTIONS)
    others = [f'- <a id="{name}"></a>{titles[name]}: {stamp_of([name], tables)}' for name in tables if name not in shown]
    return "\n\n".join([*parts, "## All other tables", "\n".join(others)]) + "\n"


def write_readme(path, rows):
    """The table of the Tohoku dataset in README.md."""
    with open(path, encoding="utf-8") as file:
        text = file.read()
    short = columns_of(rows, ("", lambda row: f"Part {row['part']}"), ("strict", "top1", "recall", "mm", "deg"), **{
        "ms": ("ms a scene, 2 threads", 0, ""), "the paper": ("in the paper (Table 7)", 1, " %")})
    new, count = re.subn(r"(<!-- evaluation: tohoku -->\n)\|.*?(?=\n\n)", lambda match: match[1] + short, text, flags=re.DOTALL)
    if count != 1:
        raise scripting.Failure("README.md has no table after <!-- evaluation: tohoku -->")
    with open(path, "w", encoding="utf-8") as file:
        file.write(new)


WORLDS = {"pipes": "pipes", "real": "other real scans", "tohoku": "noise", "bins": "bins", "sensors": "sensors",
          "siblings": "siblings", "absent": "absent parts", "sheets": "sheets"}  # as they are called in the documents
LEAST_COPIES, LEAST_LOSS = 2, 2  # less is within what chance changes; the second is a percentage


def worth(rows):
    """What is lost without a decision, by the rows of its switch: in each world copies, those at 99 %, and log loss."""
    parts = []
    for world, name in WORLDS.items():
        for row in (row for row in rows if row["world"] == world):
            copies = int(row["found"]) - int(row["found, nothing changed"])
            sure = int(row["found at 99 %"]) - int(row["found at 99 %, nothing changed"]) if row["found at 99 %"] else 0
            before = float(row["log loss, nothing changed"] or 0)
            loss = 100 * (float(row["log loss"]) / before - 1) if before else 0
            told = [f"{copies:+d}" + (f" ({sure:+d})" if before else "")] if max(abs(copies), abs(sure)) >= LEAST_COPIES else []
            told += [f"×{1 + loss / 100:.2f}"] if abs(loss) >= LEAST_LOSS else []
            if told:
                parts.append(f"{name} {', '.join(told)}")
    return "; ".join(parts) or "nothing"


def with_worth(text, rows):
    """A document whose links to the table of switches, [SWITCH](evaluation.md#ablation): ..., are followed by what it tells."""
    by = {}
    for row in rows:
        by.setdefault(row["switch"], []).append(row)
    def told(match):
        if match["name"] == "none":
            sizes = ", ".join(f"{WORLDS[row['world']]} {row['copies'] or row['found']}" for row in by["none"])
            return f"{match['link']}: {sizes}."
        return f"{match['link']}: {worth(by[match['name']]) if match['name'] in by else 'not measured on its own'}."
    return re.sub(r"(?P<link>\[(?P<name>[a-z0-9.-]+)\]\(evaluation\.md#ablation\)): [^|\n]*?\.(?=\s|$)", told, text)


def write(document, readme, folder, titles):
    text = page(folder, titles)
    with open(document, "w", encoding="utf-8") as file:
        file.write(text)
    if os.path.exists(os.path.join(folder, "tohoku.csv")):
        write_readme(readme, read(os.path.join(folder, "tohoku.csv")))
    if os.path.exists(os.path.join(folder, "ablation.csv")):
        for name in ("parameters.md", "method.md"):
            path = os.path.join(os.path.dirname(document), name)
            with open(path, encoding="utf-8") as file:
                text = with_worth(file.read(), read(os.path.join(folder, "ablation.csv")))
            with open(path, "w", encoding="utf-8") as file:
                file.write(text)
