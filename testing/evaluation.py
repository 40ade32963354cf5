#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Measures the tables of docs/evaluation.md and writes them there, each with its commands, date, commit and machine.

  . build/release/env.sh; testing/evaluation.py [--only NAME,...] [--quick]

Tables that are not measured in a run stay as they are, under their own stamp. All together take hours: name them one at a
time, or take the --quick ones. Data are looked for in $PPFMEAM_DATA (tohoku/, cad/, rings/ and scanner/); bins are simulated
once and kept in build/evaluation. The tables `voting`, `decisions`, `slopes` and `scene-edges` need the target
meamBenchmarks. A figure that stands in README.md comes from here, too."""
import argparse
import csv
import datetime
import json
import os
import platform
import re
import shutil
import subprocess
import sys

ROOT = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
DATA = os.environ.get("PPFMEAM_DATA", "")
KEPT = os.path.join(ROOT, "build", "evaluation")
BENCHMARKS = os.path.join(ROOT, "build", "release", "bin", "meamBenchmarks")
DOCUMENT, README = os.path.join(ROOT, "docs", "evaluation.md"), os.path.join(ROOT, "README.md")
HEAD = """# Evaluation

What was measured, table by table; each is written by `testing/evaluation.py --only NAME` from the commands above it, and says when, with which commit and on which machine. `DATA` is the folder that `PPFMEAM_DATA` names, `OUT` one for files in between. Times are those of a machine that may have had other work (see the load); rates and errors come out the same again. A table tells of the version that it names; what has changed since stands in [CHANGELOG.md](../CHANGELOG.md).

- *strict*: right poses / poses asked for, five a scene; each true instance counts once, a missing pose is wrong. Right is within 10 % of D and 5 degrees.
- *first*: scenes whose first pose is right.
- *recall*, *AP*: of the instances that are at least half visible, by all poses that come out; *R@99*: recall by the likeliest poses of all scenes, as long as 99 % of them are right.
- *mm*, *degrees* (*deg*): median errors of the right poses.

"""
PAPER = {1: 96.7, 2: 97.3, 3: 100.0}  # Liu et al., Table 7, %
BIN_PARTS = {  # of the bins: the CAD file, and its factor to mm
    "ridged_disc": ("examples/parts/ridged_disc.stl", 1), "arc_lever": ("examples/parts/arc_lever.stl", 1),
    "flap": ("examples/parts/flap.stl", 1), "hole_plate": ("examples/parts/hole_plate.stl", 1),
    "gear": ("DATA/cad/gear.ply", 1), "regulator": ("DATA/cad/assembly_regulator_collision.stl", 1000),
    "lug": ("DATA/cad/small.ply", 1000)}
BINS, BINS_SEED = 20, 501  # of each part; nothing was fitted on these seeds
GAP, LEAST_POSES = 5, 20  # % between claim and rate that are told, of classes of so many poses
RIVALS = ("OpenCV", "OpenCV--refined", "PCL", "PCL--refined")  # what testing/rivals/tohoku.sh leaves in OUT/rivals
README_COLUMNS = ("", "strict", "first", "recall", "mm", "degrees", "ms a scene, 2 threads", "in the paper (Table 7)")


class Failure(Exception):
    """Why a table could not be measured."""


class Commands:
    """Runs commands and remembers them as a reader would type them."""

    def __init__(self):
        self.lines = []

    def run(self, *words):
        """The output of a script of examples/, or of the benchmarks; DATA/ and OUT/ in the words are folders."""
        name, *arguments = words
        is_script = name.endswith(".py")
        self.lines.append(" ".join(["examples/run.sh" if is_script else "build/release/bin/meamBenchmarks"]
                                   + ([name] if is_script else []) + [f"'{word}'" if re.search(r"[|()* ]", word) else word
                                                                     for word in arguments]))
        if is_script:
            program = [sys.executable, os.path.join(ROOT, "examples", name)]
            if name == "real_scans.py" and not os.environ.get("DISPLAY"):
                program = [os.path.join(ROOT, "testing", "display.sh"), *program]
        else:
            program = [BENCHMARKS]
        return self.output_of(program + [path_of(word) for word in arguments])

    def run_tool(self, tool, *words):
        """The output of a program of testing/."""
        self.lines.append(" ".join([f"testing/{tool}", *words]))
        program = [os.path.join(ROOT, "testing", tool)]
        if tool.endswith(".py"):
            program = [sys.executable, "-W", "ignore", *program]
        return self.output_of(program + [path_of(word) for word in words]).strip()

    def output_of(self, program, given=None):
        """Of the command that was noted last; it gets `given` (text) to read."""
        print(self.lines[-1], file=sys.stderr, flush=True)
        done = subprocess.run(program, input=given, stdout=subprocess.PIPE, text=True, cwd=ROOT, check=False)
        if done.returncode:
            raise Failure(f"{self.lines[-1]} ended with {done.returncode}")
        return done.stdout


def path_of(word):
    return re.sub(r"\bOUT(?=/|$)", KEPT, re.sub(r"\bDATA(?=/|$)", DATA, word))


def table(head, rows):
    return "\n".join(["| " + " | ".join(head) + " |", "|" + "---|" * len(head)]
                     + ["| " + " | ".join(row) + " |" for row in rows])


# The tables: each function returns Markdown.

def tohoku_rows(commands, *arguments):
    """The figures of each part."""
    commands.run("evaluate.py", "tohoku", "DATA/tohoku", *arguments, "--out", "OUT/tohoku")
    with open(path_of("OUT/tohoku/tohoku.csv"), encoding="utf-8") as file:
        return {int(row["part"]): {name: float(value) for name, value in row.items()} for row in csv.DictReader(file)}


def tohoku(commands):
    two = tohoku_rows(commands, "--threads", "2")
    one = tohoku_rows(commands, "--threads", "1")
    paper = tohoku_rows(commands, "--threads", "2", "--preset", "paper")
    rates = [[f"Part {part}", f"{row['strict']:.0f} %", f"{row['top1']:.0f} %", f"{row['recall']:.1f} %",
              f"{row['recall_99']:.1f} %", f"{row['AP']:.1f} %", f"{row['mm']:.3f}", f"{row['deg']:.3f}", f"{row['ms']:.0f}", f"{one[part]['ms']:.0f}",
              f"{paper[part]['strict']:.0f} %", f"{PAPER[part]} %"] for part, row in two.items()]
    stages = [name for name in one[1] if name.endswith("_ms")]
    times = [[f"Part {part}"] + [f"{row[stage]:.1f}" for stage in stages] for part, row in one.items()]
    return "\n\n".join((
        table(("", "strict", "first", "recall", "R@99", "AP", "mm", "degrees", "ms a scene, 2 threads", "1 thread",
               "preset `Paper`: strict", "in the paper (Table 7)"), rates),
        "The paper counts right poses among those that came out, on 30 scenes a part. Its preset here takes the text literally, "
        "one P_ref (20 %) for all parts, and where the text is silent what comes closest ([readings](#paper-reading)). Median ms of each stage, one thread:",
        table(["", *(stage.removesuffix("_ms").lower() for stage in stages)], times)))


def noise(commands):
    levels = ("0", "0.3", "0.5", "1%")
    found = [tohoku_rows(commands, "--noise", level) for level in levels]
    rows = [[f"Part {part}"] + [f"{rows[part]['strict']:.0f} % ({rows[part]['recall']:.1f} %) {rows[part]['mm']:.2f}, "
                                f"{rows[part]['deg']:.2f}" for rows in found] for part in found[0]]
    return ("Normal noise on every coordinate of surface and edge points: strict (recall) mm, degrees.\n\n"
            + table(("", "none", "0.3 mm", "0.5 mm", "1 % of D"), rows))


def ablation(commands):
    return ("What changes by a decision that is switched off: copies found, those found with 99 % right, log loss of the "
            "probabilities, right/wrong poses above 50 %, processor time. Of real scans not all copies are known. All figures: "
            "[ablation.csv](evaluation/ablation.csv).\n\n" + commands.run_tool("evaluation/ablation.py", "--out", "OUT/ablation"))


def models(commands):
    return ("Each row differs from the first one in what its name says; [models.md](models.md) explains the choices. *pairs*, "
            "*MB*: entries and size of the table; *training*: from the clean mesh to the model, symmetries included.\n\n"
            + commands.run("compare_models.py", "--tohoku", "DATA/tohoku").strip())


def models_20(commands):
    return commands.run("compare_models.py", "--tohoku", "DATA/tohoku", "--scenes", "20", "--only",
                        "preset,mesh-visibility,mesh-edges,mesh-both,views-14").strip()


def models_paper(commands):
    return commands.run("compare_models.py", "--tohoku", "DATA/tohoku", "--preset", "paper", "--only",
                        "preset,mesh-edges,separate,whole").strip()


def calibration(commands):
    return ("All poses that come out, by their probability; below each table the logistic regression that fits these scenes "
            "best, with its mean logarithmic loss. With a surface what is used was fitted on simulated bins of every kind of sensor, "
            "not on this dataset; by edges alone it was fitted here.\n\n" + with_gaps(commands.run("calibration.py", "DATA/tohoku")))


def with_gaps(told):
    """The tables of calibration.py, below each how far the classes are from what they claim."""
    sections = []
    for section in re.split(r"\n(?=### )", told.strip()):
        rows = re.findall(r"^\| ([\d.]+ to [\d.]+) \| (\d+) \| ([\d.]+) % \| ([\d.]+) % \|", section, re.M)
        gaps = [(words, float(mean) - float(right)) for words, poses, right, mean in rows if int(poses) >= LEAST_POSES]
        kinds = (("too much", [words for words, gap in gaps if gap > GAP]), ("too little", [words for words, gap in gaps if gap < -GAP]))
        told = "; ".join(f"{kind}: {', '.join(classes) or 'none'}" for kind, classes in kinds)
        sections.append(section.strip() + (f"\n\nClasses of {LEAST_POSES} poses or more that claim {told}; by more than {GAP} %." if rows else ""))
    return "\n\n".join(sections)


def calibration_bins(commands):
    make_bins(commands)
    told = with_gaps(commands.run("calibration.py", "--bop", ",".join(f"OUT/bins/{name}" for name in BIN_PARTS)))
    return "Gear, regulator and lug had no part in the fit, nor had these bins.\n\n" + told


def make_bins(commands):
    for name, (cad, scale) in BIN_PARTS.items():
        words = ["simulate.py", "--cad", cad, *(("--cad-scale", str(scale)) if scale != 1 else ()), "--copies", "20",
                 "--scenes", str(BINS), "--seed", str(BINS_SEED), "--out"]
        folder = path_of(f"OUT/bins/{name}")
        if not os.path.exists(folder):
            shutil.rmtree(folder + ".part", ignore_errors=True)
            commands.run(*words, f"OUT/bins/{name}.part")
            commands.lines.pop()
            os.rename(folder + ".part", folder)
        commands.lines.append(" ".join(["examples/run.sh", *words, f"OUT/bins/{name}"]))


def bin_figures(commands, name, *arguments):
    """Figures by the words of evaluate.py's heads."""
    lines = commands.run("evaluate.py", "bop", f"OUT/bins/{name}", *arguments, "--out", f"OUT/{name}.csv").splitlines()
    numbers = [re.findall(r"-?\d+\.?\d*|nan", line) for line in lines]
    at = next(k for k, line in enumerate(lines) if line.startswith("obj."))
    measures = next(k for k, line in enumerate(lines) if line.startswith("obj.") and "recall of" in line)
    figures = dict(zip(("scenes", "poses", "paper", "strict", "top1", "recall", "AP", "AP2-20", "R@99", "mm", "deg", "axis", "roll", "ms"),
                       numbers[at + 1][1:]))
    figures.update(zip(lines[measures].split("recall of")[1].split(), numbers[measures + 1][1:]))
    return figures


def bins(commands):
    make_bins(commands)
    columns = {"strict": "strict, %", "top1": "first, %", "recall": "recall, %", "AP": "AP, %", "mm": "mm", "deg": "degrees",
               "ms": "ms a scan"}
    rows = []
    for name in BIN_PARTS:
        figures = bin_figures(commands, name)
        measures = [key for key in figures if key.isupper() and key != "AP"]  # AP2-20 first
        rows.append([name] + [figures[key] for key in (*columns, *measures)])
    return (f"{BINS} bins of 20 copies each, seeds {BINS_SEED} to {BINS_SEED + BINS - 1}, the sensor's defaults, edges from its own image. The "
            "benchmark's measures are of all copies of which at least a tenth is visible, by all poses that come out; AP2-20 is AP "
            "at MSSD of 2 to 20 mm, ADD and ADI are at a tenth of D.\n\n" + table(["part", *columns.values(), *measures], rows))


def robustness(commands):
    parts = list(BIN_PARTS)[:4]  # those of our own
    found = {}
    for name in parts:
        commands.run("robustness.py", "--cad", BIN_PARTS[name][0], "--scenes", "5", "--out", f"OUT/robustness_{name}.csv")
        with open(path_of(f"OUT/robustness_{name}.csv"), encoding="utf-8") as file:
            for row in csv.DictReader(file):
                level = (f"{row['depth_noise_mm']} mm", f"{row['image_noise']}, {row['image_blur_px']} pixels", row["edges"])
                found.setdefault(level, {})[name] = (f"{float(row['strict']):.0f} % ({float(row['recall']):.0f} %) "
                                                     f"{float(row['mm']):.2f}, {float(row['deg']):.2f}")
    return ("Five bins of 20 copies, seeds 1 to 5: first the depth gets noisier (standard deviation at 1 m), then the image "
            "worse (noise in grey values, blur); edges of image and depth, of the image alone, and both without the bin's walls. "
            "strict (recall) mm, degrees. One pose of the best five is 4 %.\n\n"
            + table(["depth noise", "image noise, blur", "edges", *parts],
                    [[*level, *(row[name] for name in parts)] for level, row in found.items()]))


def world(commands):
    for name in ("world.csv", "poses.csv"):
        if os.path.exists(path_of(f"OUT/world/{name}")):
            os.remove(path_of(f"OUT/world/{name}"))  # of another version; the bins are the same
    return ("Two bins of 20 copies, of seeds that nothing was fitted on, of each part and each kind of sensor, by edges, by the surface and by both, with "
            "the image of the sensor, and two of the next part, in which the part is not. *AR*, *AP2-20*: the BOP "
            "benchmark's, of all copies of which at least a tenth is visible; AP at MSSD of 2 to 20 mm by the ranks in each bin. *R@99*: with the poses found where the part is not. *claim - rate*: mean probability of all poses less the share of the right "
            "ones; *without the part*: the highest probability of a pose there.\n\n"
            + commands.run("evaluate.py", "world", "--bins", "2", "--seed", "51", "--scenes", "OUT/world/scenes", "--out", "OUT/world").strip())


def paper(commands):
    for name in ("paper.csv", "poses.csv", "figure13_trials.csv"):
        if os.path.exists(path_of(f"OUT/paper/{name}")):
            os.remove(path_of(f"OUT/paper/{name}"))  # of another version; the bins are the same
    others = []
    if os.path.exists(os.path.join(os.path.dirname(BENCHMARKS), "meamRivalOpenCV")):
        commands.run_tool("rivals/tohoku.sh", "build/release", "DATA/tohoku", "OUT/rivals", "20")
        others = [word for name in RIVALS for word in ("--found", f"{name.replace('--', ', ')}=OUT/rivals/{name}")]
    told = [commands.run("evaluate.py", "paper", *which, "--threads", "2", "--out", "OUT/paper").strip()
            for which in (("--table", "1-8", "--scenes", "30", "--tohoku", "DATA/tohoku", *others), ("--figure", "13"))]
    return ("30 bins of each part, as in the paper, with 20 copies, seeds 1 to 30, and the 20 scenes of each part that the dataset holds here (the paper: 30); parts A to D are "
            "`ridged_disc`, `arc_lever`, `flap` and `hole_plate`. *of the poses asked for*: a missing pose is wrong. Table 9 is "
            "[the picking cell](#cell); what wrong poses of the compared methods are is [below](#wrong-poses).\n\n" + "\n\n".join(told) + "\n\n"
            "The preset `Paper` judges a pose by the share of its edge points that fit: of a part such as `ridged_disc`, all of whose edges "
            "but those of the ribs fit at any turn about its axis, that hardly tells one turn from another. Times are those of a "
            "machine with other work all the while.")


def wrong_poses(commands):
    told = commands.run_tool("wrong_poses.py", "DATA/tohoku", "OUT/paper/bins", "5")
    return ("Where the five best poses of a scene go, five scenes of each part. *Half a turn*: right place, turned by more than 150 degrees; "
            "*on the bin*: most of the part's vertices are where the sensor sees the bin; *evidence*: what our verification says of the "
            "candidates in place of their votes.\n\n" + told + "\n\n"
            "Votes say what fits and never what does not. The bin's floor and walls are planes as most faces of these parts are, and the pair "
            "feature fits them; pairs of normals fit both faces of a thin plate, both ways round, and the holes and outlines that tell "
            "them apart make no pairs. The preset `Paper` has no bin's plane to fit, and no surface speaks against its poses.")


def cell(commands):
    shutil.rmtree(path_of("OUT/cell"), ignore_errors=True)  # of another version
    rows, failures = [], []
    for gripper, part in (("cup", "ridged_disc"), ("jaws", "cap"), ("jaws", "ribbed_flange")):
        lines = commands.run("cell.py", "--gripper", gripper, "--part", part, "--sensor", "structured-light", "--sensor",
                             "active-stereo", "--seed", "6", "--threads", "1", "--out", "OUT/cell").splitlines()
        rows += [line for line in lines if line.startswith("|") and line not in rows]
        failures += [line for line in lines if line.startswith("- ")]
    return ("Table 9 of the paper with a simulated cell ([picking.md](picking.md#a-cell-simulated)): 12 parts in a bin, five bins each, "
            "picked until none is left or none can be picked; one thread. Seeds 6 to 10, which nothing was chosen on. A *trial* is one "
            "way of the gripper among the true parts; *success*: it holds a part and has touched nothing else. *Left in the bins*: parts "
            "of which none could be picked when the cell stopped.\n\n" + "\n".join(rows)
            + "\n\nEvery trial that failed, and every bin that was left: how many parts of it are found, and what keeps the gripper "
            "from these.\n\n" + "\n".join(failures))


def paper_reading(commands):
    told = commands.run_tool("paper_reading.py", "DATA/tohoku")
    return ("What the paper's text leaves open, one choice after the other, on scenes 0 to 9: strict. A value that is better than "
            "the one before is kept. What is better on these scenes alone is not in the preset.\n\n" + told)


def rivals(commands):
    told = commands.run_tool("rivals/tohoku.sh", "build/release", "DATA/tohoku", "OUT/rivals", "10")
    rows = []
    for name, preset in (("PPF-MEAM, recommended", ()), ("original PPF of this program", ("--method", "ppf"))):
        ours = tohoku_rows(commands, "--scenes", "0-9", "--threads", "1", *preset)
        rows.append([name, *(f"{row['strict']:.1f} % ({row['recall']:.1f} %) {row['AP_mm']:.1f} %" for row in ours.values()),
                     f"{max(row['ms'] for row in ours.values()) / 1000:.2f}"])
    for name, seconds, rest in re.findall(r"== (.*?): ([\d.]+) s .*?\n(.*?)(?=\n==|\Z)", told, re.S):
        figures = [re.findall(r"-?\d+\.?\d*|nan", line) for line in rest.splitlines() if re.match(r"\s+[123]\s", line)]
        rows.append([name.strip().replace(" --refined", ", refined and ranked by us"),
                     *(f"{row[4]} % ({row[6]} %) {row[8]} %" for row in figures), f"{float(seconds):.2f}"])
    return ("Ten scenes of each part, the five best poses (PCL returns one, so that as shipped 20 % is all; of ours recall and AP are of all): strict (recall) AP at MSSD of "
            "2 to 20 mm, each judged as ours are; s: median processor time a scene with reading and normals, of ours the time of the "
            "slowest part on one thread.\n\n" + table(("", "Part 1", "Part 2", "Part 3", "s"), rows))


def rings(commands):
    rows = []
    for edges in (("image",), ("image", "depth"), ("image", "depth", "creases"), ("depth", "creases")):
        told = commands.run("real_scans.py", "DATA", "--seeds", "20", "--edges", *edges, "--out", "OUT")
        once = re.search(r"flips are wrong: (\d+) of (\d+) .*median error ([\d.]+) mm, ([\d.]+) degrees", told)
        seeds = re.search(r"20 seeds: ([\d.]+) met on average, (\d+) to (\d+)", told)
        rows.append([", ".join(edges), f"{once[1]} of {once[2]}", f"{once[3]} mm, {once[4]} degrees", seeds[1],
                     f"{seeds[2]} to {seeds[3]}"])
    return ("Ten rings on a plate, a real scan; the true poses were made by ICP.\n\n"
            + table(("edges", "met with the default seed", "median error", "met on average of 20 seeds", "least to most"), rows))


def resolution(commands):
    told = commands.run_tool("resolution.py", "DATA/scanner/V2D63xModel.ply", "1", "10", "5", "2.5", "1.25", "0.6")
    return ("A housing of 122 mm alone in a simulated bin, ten bins each: the first pose right (right anywhere). The housing in "
            "[the real scan](gallery.md#a-housing-time-of-flight) has pixels of 5 mm.\n\n" + told)


def benchmarks(commands, names, repetitions):
    """Medians and rates of benchmarks."""
    if not os.path.exists(BENCHMARKS):
        raise Failure(f"there is no {BENCHMARKS}: cmake/build.sh release meamBenchmarks")
    told = commands.run("benchmarks", f"--benchmark_filter=^({names})(/|$)", f"--benchmark_repetitions={repetitions}",
                        "--benchmark_enable_random_interleaving=true", "--benchmark_report_aggregates_only=true",
                        "--benchmark_format=json")
    rows = []
    for run in json.loads(told)["benchmarks"]:
        if run.get("aggregate_name") == "median":
            rates = [f"{value / 1e6:.0f} million {name}" for name, value in run.items() if name.endswith("/s")]
            rows.append([f"`{run['run_name'].replace('/real_time', '')}`", f"{run['real_time']:.{0 if run['real_time'] >= 100 else 2}f} {run['time_unit']}",
                         ", ".join(rates)])
    if not rows:
        raise Failure("no benchmark was measured: do the names still fit?")
    return f"Medians of {repetitions} runs in random order.\n\n" + table(("benchmark", "time", "rate"), sorted(rows))


def voting(commands):
    return ("`ReadEntries` and `Increments` are the limits: entries of the table read in order, and bins of the accumulator "
            "increased, nothing else. `CastVotes` has the votes alone, `Voting` features and peaks, too; `VotingByHashMap` is "
            "the same by a hash map of structs. `bracket` is a simulated scene, `tohoku` scene 0 of Part 1; a number is "
            "threads. " + benchmarks(commands, "ReadEntries|Increments|IncrementsInFirstCache|CastVotes|Voting|"
                                     "VotingByHashMap|Peaks|PairKeys|PairKeysOneByOne", 9))


def decisions(commands):
    return ("What decisions of the online phase cost: Part 1, scene 0, one thread. "
            + benchmarks(commands, "Decision", 5))


def scene_edges(commands):
    return ("Scans of 1280 x 1024 points; the first number is the noise in tenths of a millimetre, the second threads. "
            + benchmarks(commands, "ImageEdges|ImageEdgesTangentsOfPoints|ImageOfAnotherCamera|DepthEdgesAndCreases|"
                         "BackgroundRemoval", 5))


def slopes(commands):
    if not os.path.exists(BENCHMARKS):
        raise Failure(f"there is no {BENCHMARKS}: cmake/build.sh release meamBenchmarks")
    told = commands.run("benchmarks", "--benchmark_filter=By.*Points/", "--benchmark_format=json")
    commands.lines[-1] += " | testing/benchmarks/slopes.py"
    fitted = commands.output_of([sys.executable, os.path.join(ROOT, "testing", "benchmarks", "slopes.py")], told)
    return "How the time grows: time = c points^slope, one thread.\n\n```\n" + fitted.strip() + "\n```"


TABLES = {  # name: the heading, what makes it, whether it takes a few minutes at most
    "tohoku": ("Tohoku dataset", tohoku, True),
    "noise": ("Tohoku dataset with noise", noise, True),
    "ablation": ("Each decision switched off", ablation, False),
    "models": ("Which model to train", models, False),
    "models-20": ("Which model to train: candidates for the default, all scenes", models_20, False),
    "models-paper": ("Which model to train, with the paper's parameters", models_paper, False),
    "calibration": ("How likely a pose is right", calibration, False),
    "calibration-bins": ("How likely a pose is right in simulated bins", calibration_bins, False),
    "bins": ("Simulated bins", bins, False),
    "robustness": ("Noise and image quality in simulated bins", robustness, False),
    "world": ("Parts and sensors", world, False),
    "paper": ("The paper's own experiments", paper, False),
    "wrong-poses": ("Where wrong poses of the compared methods go", wrong_poses, False),
    "cell": ("The picking cell", cell, False),
    "paper-reading": ("Readings of the paper's text", paper_reading, False),
    "rivals": ("What others would use instead", rivals, False),
    "rings": ("A real scan: rings", rings, False),
    "resolution": ("How many pixels a part needs", resolution, False),
    "voting": ("Speed of voting", voting, False),
    "decisions": ("What decisions cost", decisions, False),
    "scene-edges": ("Speed of scene edges", scene_edges, False),
    "slopes": ("How the time grows", slopes, False),
}


def stamp():
    """Date, commit and machine."""
    def git(*words):
        return subprocess.run(["git", "-C", ROOT, *words], stdout=subprocess.PIPE, text=True, check=False).stdout.strip()

    commit = git("rev-parse", "--short", "HEAD") or "unknown"
    changed = " with changes" if git("status", "--porcelain", "--", "core", "filters", "examples") else ""
    with open("/proc/cpuinfo", encoding="utf-8") as file:
        model = re.search(r"model name\s*: (.*)", file.read())
    return (f"*{datetime.date.today()}, commit {commit}{changed}; {model[1].strip() if model else platform.machine()}, "
            f"{os.cpu_count()} processors, load {os.getloadavg()[0]:.1f} at the start*")


def sections_of(document):
    """The sections of the file by name."""
    if not os.path.exists(document):
        return {}
    with open(document, encoding="utf-8") as file:
        parts = re.split(r'^<a id="([^"]+)"></a>\n', file.read(), flags=re.MULTILINE)
    return {name: text.strip() for name, text in zip(parts[1::2], parts[2::2])}


def write(document, sections):
    with open(document, "w", encoding="utf-8") as file:
        file.write(HEAD)
        file.write("\n\n".join(f'<a id="{name}"></a>\n' + sections.get(
            name, f"## {TABLES[name][0]}\nNot measured yet.") for name in TABLES) + "\n")


def write_readme(section):
    """Some columns of the first table of the section take the place of the table in README.md."""
    with open(README, encoding="utf-8") as file:
        text = file.read()
    lines = re.search(r"^\|.*?(?=\n\n)", section, flags=re.MULTILINE | re.DOTALL)[0].splitlines()
    head, _, *rows = ([cell.strip() for cell in line.strip("| \n").split("|")] for line in lines)
    head = [""] * (len(rows[0]) - len(head)) + head  # the first has no words
    chosen = [k for k, words in enumerate(head) if words in README_COLUMNS]
    short = table([head[k] for k in chosen], [[row[k] for k in chosen] for row in rows])
    new, count = re.subn(r"(<!-- evaluation: tohoku -->\n)\|.*?(?=\n\n)", lambda match: match[1] + short, text,
                         flags=re.DOTALL)
    if count != 1:
        raise Failure("README.md has no table after <!-- evaluation: tohoku -->")
    with open(README, "w", encoding="utf-8") as file:
        file.write(new)


def measure(name):
    title, make, _ = TABLES[name]
    commands, made = Commands(), stamp()
    body = make(commands)
    return f"## {title}\n{made}\n```\n" + "\n".join(commands.lines) + f"\n```\n{body}"


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--only", type=lambda text: text.split(","), metavar="NAME,...",
                        help=f"tables to measure (default: all: {', '.join(TABLES)})")
    parser.add_argument("--quick", action="store_true", help="only tables that take a few minutes at most")
    options = parser.parse_args()
    names = options.only or list(TABLES)
    unknown = [name for name in names if name not in TABLES]
    if unknown:
        parser.error(f"unknown tables: {', '.join(unknown)}; there are {', '.join(TABLES)}")
    if not os.path.isdir(os.path.join(DATA, "tohoku")):
        parser.error("PPFMEAM_DATA has to name a folder that holds tohoku/")
    os.makedirs(KEPT, exist_ok=True)
    failed = []
    for name in names:
        if options.quick and not TABLES[name][2]:
            continue
        try:
            section = measure(name)
            write(DOCUMENT, {**sections_of(DOCUMENT), name: section})
            if name == "tohoku":
                write_readme(section)
        except Failure as failure:
            print(f"{name}: {failure}", file=sys.stderr)
            failed.append(name)
    if failed:
        sys.exit(f"not measured: {', '.join(failed)}")


if __name__ == "__main__":
    main()
