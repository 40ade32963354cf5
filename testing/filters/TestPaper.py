# SPDX-License-Identifier: BSD-3-Clause
"""The paper's experiments, testing/evaluation/paper.py: what they count, which scenes they need, that a stopped run goes
on, what becomes of bad scenes and datasets, and with --long all of them by one command, short. Tables 7 and 8 when the Tohoku dataset is there; charts when there is Xvfb."""
import math
import os
import re
import shutil
import signal
import subprocess
import sys
import tempfile

import numpy
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkIOImage import vtkPNGReader

from ppfmeam import scripting
from meamtest import LONG, check, close, connect, grid, poses, read, rows_of, set_fields, write
import paper
import results
import search
import stage
from scripttest import EVALUATION, TESTING, refuses

# Two scenes, of which one returns three poses of five.
TABLE = paper.Table("Table.", "image", paper.by_part([("D", "plate")]), ("ppf", "b2b"), {"ppf": (40,)}, "%", {"ppf": (900,)})
ROW = {**dict.fromkeys(search.ROW, ""), "source": "image", "part": "plate", "method": "ppf", "views": "6", "asked": "5"}
ROWS = [{**ROW, "poses": "5", "right": "4", "wrong turn": "1", "ms": "100"}, {**ROW, "poses": "3", "right": "2", "wrong place": "1", "ms": "300"}]
(of_d, of_all, nothing, _), kinds = paper.rows_of(TABLE, ROWS), ("rate", "strict", "ms", "paper", "paper ms", "wrong turn", "wrong place", "missing")
check(close([of_d[name] for name in kinds], [75, 60, 200, 40, 900, 10, 10, 20]), f"of two scenes: {of_d}")
check(of_all["scenes"] == "all" and of_all["rate"] == 75 and of_all["paper"] is None, f"{of_all}")
check(nothing["method"] == "B2B" and all(nothing[name] is None for name in kinds), f"nothing is no rate: {nothing}")
text = paper.text_of(6, TABLE, paper.rows_of(TABLE, ROWS), ROWS, [])
for line in ("| original PPF | 75.0 % |", "| original PPF, of the poses asked for | 60.0 % |", "| original PPF: the paper says | 40.0 % |",
             "| original PPF, ms a scene | 200 |", "| original PPF, ms a scene: the paper says | 900 |", "| B2B | - |"):
    check(line in text, f"{line}: {text}")


def planned(numbers, *arguments):
    return paper.planned([paper.TABLES[number] for number in numbers], *arguments)


# Table 1 is four parts by three methods; 2 is of the same scenes; of 5 and 6 some are the same.
check(len(planned([1], 30, 1)) == len(planned([1, 2], 30, 1)) == 4 * 3 * 30, "scenes of tables 1 and 2")
check(len(planned([3], 2, 1)) == 24 and len(planned([3, 4, 5, 6], 2, 1)) == 24 + 8 + 4, "scenes of tables 3 to 6")
check(not set(map(search.key_of, planned([1], 2, 1, 8))) & set(map(search.key_of, planned([1], 2, 1))), "bins of fewer copies are others")
check({row["seed"] for row in planned([7], 2, 1)} == {"0", "1"}, "scenes of a dataset count from 0")

# A camera of 100 pixels at 100 mm: of four edge points one lies behind what is measured at its pixel, one beside the scan.
scan = grid(3, 3, [(column - 1, row - 1, 100 if column < 2 else math.nan) for row in range(3) for column in range(3)])
set_fields(scan, CameraMatrix=(100, 0, 1, 0, 100, 1, 0, 0, 1))
truth = set_fields(poses((1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 100, 0, 0, 0, 1)), Diameter=50)
edges = numpy.array([(0, 0, 0.4), (0, 0, 0.6), (1, 0, 30), (9, 0, 0)], dtype=float)
kept = vtk_to_numpy(search.seen(edges, truth, scan).GetPoints().GetData())
check(numpy.allclose(kept, [(0, 0, 100.4), (1, 0, 130)]), f"of four edge points these are seen: {kept}")

# A step of 10 mm that is found as 10.5, a turn of 20 degrees found as 19.
still = numpy.eye(4)
check(close([stage.errors(still, stage.moved(still, 10.5), numpy.array([3.0, 0, 0]), distance=10)], [0.5], 1e-9), "the error of a move")
middle = numpy.array([3.0, 4.0, 5.0])
turned = stage.turned(still, middle, 19)
check(close([stage.errors(still, turned, middle, degrees=20)], [1.0], 1e-6), "the error of a turn")
check(numpy.allclose(turned[:3, :3] @ middle + turned[:3, 3], middle), "a turn moves the middle")
check(numpy.allclose(stage.turned(still, middle, 90, "x")[:3, :3] @ (0, 1, 0), (0, 0, 1)), "a turn about x")



class Stand:
    """In place of the stage: 0.5 mm are added to steps of 10 mm, nothing is found after 20 mm, and scans of one trial fail."""

    fails, middle, trials = True, middle, []

    def __init__(self, *_):
        pass

    def lying(self, seed):
        self.trials.append(seed)
        return numpy.eye(4)

    def found(self, transform, seed):
        if self.fails and seed > stage.SCANS:
            raise scripting.Failure("the lamp is out")
        x = transform[0, 3] - (middle - transform[:3, :3] @ middle)[0]
        return None if abs(x - 20) < 1e-6 else stage.moved(transform, 0.5) if abs(x - 10) < 1e-6 else transform


# A trial that fails is a row with its reason, and the only one that is made again.
with tempfile.TemporaryDirectory() as folder:
    stage.Stage, whole_stage = Stand, stage.Stage
    text, rows = stage.run(folder, "plate", "paper", 1, 1, 2)
    check(len(results.failed) == 1 and rows[1]["found"] == 1 and "The trial of seed 14 failed: the lamp is out" in text, text)
    check("| 10 mm | 1 of 2 | 0.500 mm | 0.500 mm |" in text and "| 20 mm | 0 of 2 | - | - |" in text, text)
    check("| 15 degrees about x | 1 of 2 | 0.000 degrees" in text, text)
    rows = rows_of(os.path.join(folder, "figure13_trials.csv"))
    check([row["failure"] for row in rows] == ["", "the lamp is out"] and rows[0]["20 mm"] == "", f"{rows}")
    Stand.fails, Stand.trials = False, Stand.trials[:0]
    text, _ = stage.run(folder, "plate", "paper", 1, 1, 2)
    check(len(results.failed) == 1 and Stand.trials == [14] and "| 10 mm | 2 of 2 |" in text, f"{Stand.trials}: {text}")
    stage.Stage = whole_stage

EVALUATE = [sys.executable, os.path.join(EVALUATION, "paper.py")]
TOHOKU = os.path.join(os.environ.get("PPFMEAM_DATA", ""), "tohoku")
ON_SCREEN = os.path.join(TESTING, "display.sh")


def run(*words, **environment):
    kept = {name: value for name, value in os.environ.items() if name != "DISPLAY"}
    return subprocess.run(words, capture_output=True, text=True, check=False, env={**kept, **environment})


for words, *arguments in (
        ("table 7 needs the Tohoku dataset", "--table", "7"), ("there is no table 10", "--table", "10"),
        ("cannot read nowhere: --tohoku has to be the folder", "--table", "7", "--tohoku", "nowhere"),
        ("cannot read nowhere: --tohoku has to be the folder", "--all", "--tohoku", "nowhere"),
        ("--scenes has to be 1 or more", "--table", "1", "--scenes", "0"), ("--copies has to be 1 or more", "--table", "1", "--copies", "0"),
        ("--found is for tables 7 and 8", "--table", "1", "--found", "x=y"),
        ("has no folder Part_1 with the poses", "--table", "7", "--tohoku", ".", "--found", "x=.")):
    refuses(words, "paper.py", *arguments, "--out", "refused")
os.makedirs("other")
write("other/paper.csv", "something,else\n")
refuses("is not of this version", "paper.py", "--table", "6", "--out", "other")

# A table of plates alone, which are soon trained, for the runs that are stopped.
PLATES = f"""
import sys
sys.path.append({EVALUATION!r})
import paper
from ppfmeam import scripting
paper.TABLES[6] = paper.TABLES[6]._replace(columns=paper.by_part([("D", "hole_plate")]), methods=("ppf", "recommended"))
paper.TABLES[7] = paper.TABLES[7]._replace(methods=("ppf",))
scripting.run(paper.main)
"""
SHORT = [sys.executable, "-c", PLATES, "--table", "6", "--scenes", "2", "--copies", "3", "--threads", "1", "--out"]


def without_times(path):
    """The text of a file but for times."""
    if os.path.basename(path) == "paper.csv" or path.endswith("table6.csv"):
        return [{**row, "ms": ""} for row in rows_of(path)]
    return re.sub(r"(?m)^.*ms a scene.*$", "", read(path))


def stop(command, line, how):
    """Starts a command and stops it once it has told of a search."""
    process = subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True)
    told = ""
    while line not in told:
        told = process.stderr.readline()
        check(told, f"it ended before '{line}'")
    process.send_signal(how)
    process.communicate()
    return process.returncode


# A run that is stopped after the first search and killed after the second leaves, when it goes on, what one does that is not.
with tempfile.TemporaryDirectory() as folder:
    whole, parts = os.path.join(folder, "whole"), os.path.join(folder, "parts")
    done = run(*SHORT, whole)
    check(done.returncode == 0 and "4 of 4: " in done.stderr, done.stderr)
    status = stop([*SHORT, parts], "1 of 4: ", signal.SIGINT), stop([*SHORT, parts], "2 of 4: ", signal.SIGKILL)
    check(status == (128 + signal.SIGINT, -signal.SIGKILL), f"status {status}")
    with open(os.path.join(parts, "paper.csv"), "a", encoding="utf-8") as file:
        file.write("image,hole_pl")  # killed while it writes
    done = run(*SHORT, parts)
    check(done.returncode == 0 and "1 of 4: " not in done.stderr and "2 of 4: " not in done.stderr, done.stderr)
    files = {name for name in os.listdir(whole) if name != "bins"}
    check(files == {"paper.csv", "poses.csv", "table6.md", "table6.csv"}, f"{files}")
    check(files == {name for name in os.listdir(parts) if name != "bins"}, f"{os.listdir(parts)}")
    for name in files:
        texts = [without_times(os.path.join(place, name)) for place in (whole, parts)]
        check(texts[0] == texts[1], f"{name}: {texts}")
    rows, poses = rows_of(os.path.join(whole, "paper.csv")), rows_of(os.path.join(whole, "poses.csv"))
    check(all(int(row["poses"]) == sum(int(row[name]) for name in search.OUTCOMES) for row in rows), f"{rows}")
    best = [pose for pose in poses if int(pose["rank"]) <= paper.POSES]
    check(len(best) == sum(int(row["poses"]) for row in rows) and poses[0]["rank"] == "1", f"{poses}")
    wrong = [pose for pose in best if pose["method"] == "recommended" and pose["outcome"] != "right"]
    text = read(os.path.join(whole, "table6.md"))
    check(all(f"rank {pose['rank']}: {pose['outcome']}" in text for pose in wrong) and text.count("\n- ") == len(wrong), text)
    right = sum(int(row["right"]) for row in rows if row["method"] == "recommended")
    table = {row["method"]: row for row in rows_of(os.path.join(whole, "table6.csv")) if row["scenes"] == "D"}
    check(float(table["PPF-MEAM, recommended"]["strict"]) == 10 * right >= 50, f"{table}, {right}")
    check(table["original PPF"]["paper ms"] == "2752" and float(table["original PPF"]["ms"]) > 0, f"{table}")

    # A bin that cannot be read is a row with its reason, its poses are missing, and the next run looks at it again.
    os.rename(os.path.join(parts, "bins"), os.path.join(folder, "bins"))
    os.remove(os.path.join(parts, "paper.csv"))
    shutil.copytree(os.path.join(folder, "bins"), os.path.join(parts, "bins"))
    for extension in (".vts", ".vtp"):
        write(os.path.join(parts, "bins", "hole_plate_structured-light_3_1" + extension), "nothing")
    done = run(*SHORT, parts)
    check(done.returncode == 1 and "2 failed, see above" in done.stderr and "2 of 4 searches failed" in done.stdout, done.stderr + done.stdout)
    check("nan" not in done.stdout, done.stdout)
    failed = [row for row in rows_of(os.path.join(parts, "paper.csv")) if row["failure"]]
    check(len(failed) == 2 and all("hole_plate_structured-light_3_1" in row["failure"] for row in failed), f"{failed}")
    shutil.rmtree(os.path.join(parts, "bins"))
    os.rename(os.path.join(folder, "bins"), os.path.join(parts, "bins"))
    done = run(*SHORT, parts)
    check(done.returncode == 0 and "2 of 4: " not in done.stderr and "4 of 4: " in done.stderr, done.stderr)
    check(without_times(os.path.join(parts, "table6.md")) == without_times(os.path.join(whole, "table6.md")), "the bins are whole again")


def check_dataset(folder):
    """True poses of another part, true poses that are not there and a part that is not there are rows with their reasons."""
    for part in (1, 2):
        os.makedirs(os.path.join(folder, f"Part_{part}", "Results"))
        for name in ("Scenes", f"Part_{part}.STL"):
            os.symlink(os.path.join(TOHOKU, f"Part_{part}", name), os.path.join(folder, f"Part_{part}", name))
    shutil.copy(os.path.join(TOHOKU, "Part_2", "Results", "trans0.txt"), os.path.join(folder, "Part_1", "Results"))
    out = os.path.join(folder, "out")
    done = run(sys.executable, "-c", PLATES, "--table", "7", "--scenes", "1", "--tohoku", folder, "--out", out)
    check(done.returncode == 1 and "3 failed, see above" in done.stderr and "nan" not in done.stdout, done.stderr + done.stdout)
    reasons = {row["part"]: row["failure"] for row in rows_of(os.path.join(out, "paper.csv"))}
    check("another part or another scene" in reasons["tohoku_1"] and "trans0.txt: No such file" in reasons["tohoku_2"]
          and "Part_3.STL: No such file" in reasons["tohoku_3"], f"{reasons}")
    check(all(reason in read(os.path.join(out, "table7.md")) for reason in reasons.values()), done.stdout)


def check_all(folder, dataset):
    """All of it by one command: every table has its files and figures."""
    out, found = os.path.join(folder, "out"), os.path.join(folder, "found")
    command = [*EVALUATE, "--all", "--quick", "--out", out]
    if dataset:
        for part in (1, 2, 3):  # of another program: the first true pose of each scene, and a time of one scan
            os.makedirs(os.path.join(found, f"Part_{part}"))
            for name in (f"trans{scene}.txt" for scene in range(3)):
                write(os.path.join(found, f"Part_{part}", name), " ".join(read(os.path.join(TOHOKU, f"Part_{part}", "Results", name)).split()[:16]) + "\n")
        write(os.path.join(found, "seconds.txt"), "data/Part_2/Scenes/Scene0.pcd 0.25\n")
        command += ["--tohoku", TOHOKU, "--found", f"another program={found}"]
    done = run(*command)
    check(done.returncode == 0, done.stderr)
    check("no charts were made" in done.stderr and "xvfb-run" in done.stderr, done.stderr)
    check(("tables 7 and 8 are left out" in done.stderr) != dataset, done.stderr)
    numbers = range(1, 9) if dataset else range(1, 7)
    files = ({f"table{number}.{form}" for number in numbers for form in ("md", "csv")}
             | {"paper.csv", "poses.csv", "picks.csv", "table9.md", "figure13.md", "figure13.csv", "figure13_trials.csv"})
    check(files <= set(os.listdir(out)), f"{files - set(os.listdir(out))} are missing")
    texts = [read(os.path.join(out, name)) for name in files]
    check(not any(re.search(r"\bnan\b|\bfailed\b", text) for text in texts + [done.stdout]), done.stdout)
    rows = rows_of(os.path.join(out, "paper.csv"))
    check(len(rows) == 3 * (27 + (15 + 3 if dataset else 0)) and not any(row["failure"] for row in rows), f"{len(rows)} rows: {rows}")
    recommended = [row for row in rows if row["method"] == "recommended"]
    right = sum(int(row["right"]) for row in recommended)
    check(right >= 0.85 * 5 * len(recommended) and len(recommended) == 3 * (11 if dataset else 8), f"{right} right of {5 * len(recommended)}")
    trial, = rows_of(os.path.join(out, "figure13_trials.csv"))
    errors = [float(trial[name]) for name in stage.ROW[3:-1] if trial[name]]
    check(len(errors) >= 10 and max(errors) < 2, f"{trial}")
    check("about theta_x" in read(os.path.join(out, "figure13.md")), "what the paper does")
    check("3360 or 3560" in read(os.path.join(out, "table5.md")), "what is not certain")
    if dataset:
        check("Table 8 are not known" in read(os.path.join(out, "table8.md")), "what is not known")
        others = [row for row in rows_of(os.path.join(out, "table7.csv")) if row["method"] == "another program" and row["scenes"] != "all"]
        check([[float(row[name]) for row in others] for name in ("rate", "strict")] == [[100] * 3, [20] * 3], f"{others}")
        check([row["ms"] for row in others] == ["", "250", ""], f"{others}")

    # Again, with a display: nothing is left to do but to judge the other program's poses and to draw the charts.
    shown = run(ON_SCREEN, *command)
    if shown.returncode != 77:
        searched = [line for line in shown.stderr.splitlines() if " right; " in line and "found another program" not in line]
        check(shown.returncode == 0 and "no charts" not in shown.stderr and not searched, shown.stderr)
        check(shown.stdout == done.stdout, f"{shown.stdout} {done.stdout}")
        pictures = {f"table{number}.png" for number in (*numbers, 9)} | {f"figure13_{word}.png" for word in ("moved", "turned_about_x", "turned_about_z")}
        check(pictures <= set(os.listdir(out)), f"{pictures - set(os.listdir(out))} are missing")
        for name in pictures:
            reader = connect(vtkPNGReader(), FileName=os.path.join(out, name))
            reader.Update()
            pixels = vtk_to_numpy(reader.GetOutput().GetPointData().GetScalars())[:, :3].astype(int)
            colored = (pixels.max(axis=1) - pixels.min(axis=1) > 60).mean()
            check(colored > 0.003, f"{name} has {100 * colored:.2f} % of colour")


if LONG:
    with tempfile.TemporaryDirectory() as folder:
        check_all(folder, os.path.isdir(TOHOKU))
if os.path.isdir(TOHOKU):
    with tempfile.TemporaryDirectory() as folder:
        check_dataset(folder)
