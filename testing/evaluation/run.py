#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Measures the tables of docs/evaluation/, a CSV file each with its date and commit, and writes docs/evaluation.md, the table of
README.md and what decisions are worth in docs/parameters.md from these files.

  . build/release/env.sh; testing/evaluation/run.py [--only NAME,...] [--quick]

Tables that are not measured stay as they are. All together take hours: name them one at a time, or take the --quick ones; `--only
none` writes the documents alone. Data are looked for in $PPFMEAM_DATA (tohoku/, cad/, rings/, scanner/, pipes/ and real/); bins
are simulated once and kept in build/evaluation. `voting`, `slopes` and `scene-edges` build the target meamBenchmarks,
`rivals` needs the build option PPFMEAM_BUILD_RIVALS, which adds them to `paper`, too."""
import argparse
import datetime
import os
import shutil
import subprocess
import sys

from ppfmeam import dataset, evaluation, scripting

import benchmarks
import calibration
import cells
import good_scans
import megapixels
import models
import page
import paper
import paper_reading
import real_scans
import resolution
import results
import robustness
import stage
import tohoku
import world

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
DATA = os.environ.get("PPFMEAM_DATA", "")
TOHOKU = os.path.join(DATA, "tohoku")
KEPT = os.path.join(ROOT, "build", "evaluation")
TABLES = os.path.join(ROOT, "docs", "evaluation")
DOCUMENT, README = os.path.join(ROOT, "docs", "evaluation.md"), os.path.join(ROOT, "README.md")
PAPER = {1: 96.7, 2: 97.3, 3: 100.0}  # Liu et al., Table 7, %
BIN_PARTS = {  # of the bins: the CAD file, and its factor to mm
    **{name: (os.path.join(ROOT, "examples", "parts", name + ".stl"), 1)
       for name in ("ridged_disc", "arc_lever", "flap", "hole_plate")},
    "gear": (os.path.join(DATA, "cad", "gear.ply"), 1),
    "regulator": (os.path.join(DATA, "cad", "assembly_regulator_collision.stl"), 1000),
    "lug": (os.path.join(DATA, "cad", "small.ply"), 1000)}
BINS, BINS_SEED = 20, 501  # of each part; nothing was fitted on these seeds
RIVALS = {"OpenCV": "OpenCV", "OpenCV--refined": "OpenCV, refined", "PCL": "PCL",
          "PCL--refined": "PCL, refined"}  # what tohoku.sh leaves


def kept(name, anew=False):
    """A folder of build/evaluation; anew: without what another version left."""
    folder = os.path.join(KEPT, name)
    if anew:
        shutil.rmtree(folder, ignore_errors=True)
    os.makedirs(folder, exist_ok=True)
    return folder


def of_tohoku():
    two, one, of_paper = (tohoku.measure(TOHOKU, threads=threads, preset=preset)
                          for threads, preset in ((2, "recommended"), (1, "recommended"), (2, "paper")))
    return [{**row, "ms, 1 thread": single["ms"], **{name: single[name] for name in row if name.endswith("_ms")},
             "preset Paper: strict": other["strict"],
             "the paper": PAPER[row["part"]]} for row, single, other in zip(two, one, of_paper)]


def noise():
    return [{"noise": level, **row} for level in ("0", "0.3", "0.5", "1%") for row in tohoku.measure(TOHOKU, noise=level)]


def make_bins():
    """The folders of the bins by part."""
    folders = {}
    for name, (cad, scale) in BIN_PARTS.items():
        folders[name] = os.path.join(kept("bins"), name)
        if not os.path.exists(folders[name]):
            part = folders[name] + ".part"
            shutil.rmtree(part, ignore_errors=True)
            subprocess.run([sys.executable, os.path.join(ROOT, "examples", "simulate.py"), "--cad", cad, "--cad-scale",
                            str(scale), "--copies", "20",
                            "--scenes", str(BINS), "--seed", str(BINS_SEED), "--out", part], check=True,
                           stdout=subprocess.DEVNULL)
            os.rename(part, folders[name])
    return folders


def bins():
    """The seven parts' bins, by the poses and by the benchmark's measures."""
    rows = []
    for name, folder in make_bins().items():
        data = dataset.Dataset(folder)
        model, mesh = data.train(1, "recommended"), data.mesh(1)
        run, benchmark = evaluation.Evaluation(model, mesh=mesh), dataset.BOPFigures(mesh, model)
        for image in (scene.image(step) for scene in map(data.scene, data.scenes()) for step in scene.steps):
            poses, truth = run.find(image.scan), image.truth_of(1)
            run.add(poses, truth)
            benchmark.add(poses, truth, image.scan)
        figures = run.figures()
        rows.append({"part": name, **{key: figures[key]
                                      for key in ("strict", "top1", "recall", "recall_99", "AP", "AP_mm", "mm", "deg", "ms")},
                     **benchmark.recalls()})
    return rows


def of_paper():
    others = [(words, os.path.join(kept("rivals"), name))
              for name, words in RIVALS.items()] if run_rivals(20, optional=True) else ()
    folder = kept("paper")
    for name in ("paper.csv", "poses.csv", "figure13_trials.csv"):
        if os.path.exists(os.path.join(folder, name)):
            os.remove(os.path.join(folder, name))  # of another version; the bins are the same
    return paper.measure(folder, range(1, 9), tohoku=TOHOKU, found=others, threads=2)


def cell():
    """Cells whose seeds nothing was chosen on."""
    folder, rows = kept("cell", anew=True), []
    for gripper, part in (("cup", "ridged_disc"), ("jaws", "cap"), ("jaws", "ribbed_flange")):
        rows += cells.table9(folder, [part], ["structured-light", "active-stereo"], gripper, cells.BINS, cells.COPIES, 6,
                             1)[1][bool(rows):]
    return rows


def run_rivals(scenes, optional=False):
    program = [os.path.join(ROOT, "testing", "rivals", "tohoku.sh"), os.path.join(ROOT, "build", "release"), TOHOKU,
               kept("rivals"), str(scenes)]
    done = subprocess.run(program, stdout=subprocess.DEVNULL, check=False)
    if done.returncode and not optional:
        raise scripting.Failure("the rivals could not be run")
    return done.returncode == 0


def rivals():
    """PCL returns one pose, so that as shipped 20 % is all; of ours recall and AP are of all."""
    run_rivals(10)
    scenes, rows = list(range(10)), []
    sets = {"PPF-MEAM, recommended": {"threads": 1}, "original PPF of this program": {"threads": 1, "preset": "ppf"},
            **{words: {"found": os.path.join(kept("rivals"), name)} for name, words in RIVALS.items()}}
    for name, options in sets.items():
        of_parts = tohoku.measure(TOHOKU, scenes=scenes, **options)
        seconds = max(row["ms"] for row in of_parts) / 1000
        if "found" in options:
            with open(os.path.join(options["found"], "seconds.txt"), encoding="utf-8") as file:
                known = sorted(float(line.split()[-1]) for line in file)
            seconds = known[(len(known) - 1) // 2]
        rows += [{"program": name, "part": row["part"], **{key: row[key] for key in ("strict", "recall", "AP_mm")}, "s": seconds}
                 for row in of_parts]
    return rows


def ablation():
    """By the target meamAblation, in several worlds."""
    folder, program = kept("ablation", anew=True), os.path.join(ROOT, "testing", "evaluation", "ablation.py")
    subprocess.run([sys.executable, program, "--out", folder], check=True)
    return results.read(os.path.join(folder, "ablation.csv"))


def robust():
    return [{"part": name, **row} for name in list(BIN_PARTS)[:4]
            for row in robustness.measure(BIN_PARTS[name][0])]  # those of our own


def of_scans():
    return [{"part": name, **row} for name in ("ridged_disc", "hole_plate") for row in good_scans.measure(BIN_PARTS[name][0])]


def of_pixels():
    return [{"part": name, **row} for name in ("hole_plate", "ridged_disc") for row in megapixels.measure(BIN_PARTS[name][0], seed=5201)]


def rings():
    return [real_scans.rings(DATA, edges, 20)
            for edges in (("image",), ("image", "depth"), ("image", "depth", "creases"), ("depth", "creases"))]


def parts_and_sensors():
    for name in ("world.csv", "poses.csv"):
        if os.path.exists(os.path.join(kept("world"), name)):
            os.remove(os.path.join(kept("world"), name))  # of another version; the bins are the same
    return world.measure(kept("world"), bins=2, seed=51, scenes=os.path.join(kept("world"), "scenes"))


MEASURED = {  # name: the heading, what makes it, whether it takes a few minutes at most
    "tohoku": ("Tohoku dataset", of_tohoku, True),
    "noise": ("Tohoku dataset with noise", noise, True),
    "bins": ("Simulated bins", bins, False),
    "world": ("Parts and sensors", parts_and_sensors, False),
    "calibration": ("How likely a pose is right", lambda: calibration.measure(TOHOKU), False),
    "calibration-bins": ("How likely a pose is right in simulated bins",
                         lambda: calibration.measure(bop=list(make_bins().values())), False),
    "rings": ("A real scan: rings", rings, False),
    "known": ("Real scans of other sensors", lambda: real_scans.known(DATA), True),
    "robustness": ("Noise and image quality in simulated bins", robust, False),
    "good-scans": ("Scans that shine, are exposed wrongly or have holes", of_scans, False),
    "megapixels": ("Time by megapixels and threads", of_pixels, True),
    "resolution": ("How many pixels a part needs", lambda: resolution.measure(os.path.join(DATA, "scanner", "V2D63xModel.ply")),
                   False),
    "paper": ("The paper's own experiments", of_paper, False),
    "figure13": ("The paper's Figure 13", lambda: stage.run(kept("paper"), paper.PARTS[0], "recommended", 2, 1)[1], False),
    "paper-reading": ("Readings of the paper's text", lambda: paper_reading.measure(TOHOKU), False),
    "rivals": ("What others would use instead", rivals, False),
    "cell": ("The picking cell", cell, False),
    "models": ("Which model to train", lambda: models.measure(TOHOKU), False),
    "ablation": ("Each decision switched off, in several worlds", ablation, False),
    "voting": ("Speed of voting", lambda: benchmarks.medians(
        "ReadEntries|Increments|IncrementsInFirstCache|CastVotes|Voting|VotingByHashMap|Peaks|PairKeys|PairKeysOneByOne", 9),
               False),
    "scene-edges": ("Speed of scene edges", lambda: benchmarks.medians(
        "ImageEdges|ImageEdgesTangentsOfPoints|ImageOfAnotherCamera|DepthEdgesAndCreases|BackgroundRemoval"), False),
    "slopes": ("How the time grows", benchmarks.slopes, False),
}


def stamp():
    """Date and commit."""
    def git(*words):
        return subprocess.run(["git", "-C", ROOT, *words], stdout=subprocess.PIPE, text=True, check=False).stdout.strip()

    changed = " with changes" if git("status", "--porcelain", "--", "core", "filters", "testing/evaluation") else ""
    return {"date": str(datetime.date.today()), "commit": (git("rev-parse", "--short", "HEAD") or "unknown") + changed}


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--only", type=results.names_of((*MEASURED, "none")), metavar="NAME,...", default=list(MEASURED),
                        help=f"tables to measure (default: all: {', '.join(MEASURED)})")
    parser.add_argument("--quick", action="store_true", help="only tables that take a few minutes at most")
    options = parser.parse_args()
    names = [name for name in options.only if name != "none" and (MEASURED[name][2] or not options.quick)]
    if names and not os.path.isdir(TOHOKU):
        raise scripting.Failure("PPFMEAM_DATA has to name a folder that holds tohoku/")
    scripting.make_folder(TABLES)
    missing = []
    for name in names:
        print(f"{name}: {MEASURED[name][0]}", file=sys.stderr, flush=True)
        made = stamp()
        results.failed.clear()
        with results.told(name):
            rows = MEASURED[name][1]()
        if results.failed:
            missing.append(name)
        else:
            results.write(os.path.join(TABLES, name + ".csv"), [{**row, **made} for row in rows])
    page.write(DOCUMENT, README, TABLES, {name: title for name, (title, _, _) in MEASURED.items()})
    if missing:
        raise scripting.Failure(f"not measured: {', '.join(missing)}")


if __name__ == "__main__":
    scripting.run(main)
