# SPDX-License-Identifier: BSD-3-Clause
"""The scripts of examples/ that measure, on a dataset of one scene or on simulated bins: evaluate.py, compare_models.py,
calibration.py, robustness.py. With --long more of their choices."""
import csv
import math
import os
import shutil

import numpy
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy

from ppfmeam import evaluation, scripting, world
from ppfmeam.filters import vtkMEAMPoseWriter
from meamtest import LONG, Trained, check, connect, points, poses, run, tuples
from scripttest import EXAMPLES, read, refuses, scan_of_bin, script, works, write_pcd, write_stl

scan, truth, mesh = scan_of_bin()
places = vtk_to_numpy(scan.GetPoints().GetData())
true = numpy.array(tuples(truth, "Transform")).reshape(-1, 4, 4)

# True poses of which only the hidden ones are wrong fit, those of which only the hidden ones are right do not, in any order.
model = run(Trained(mesh).model)
edges = evaluation.scene_edges(scan)
away = true.copy()
away[:, :3, 3] += (40, 40, 20)
for mixed, fits in ((numpy.concatenate((true[:1], away[1:3])), True), (numpy.concatenate((away[:1], true[1:3])), False)):
    for order in ([0, 1, 2], [2, 1, 0]):
        known = scripting.poses_of(mixed[order])
        visible = numpy_to_vtk(numpy.array((0.9, 0.2, 0.1))[order], deep=True)
        visible.SetName("VisibleFraction")
        known.GetPointData().AddArray(visible)
        try:
            evaluation.with_visibility(evaluation.half_visible(known), model, edges, scan)
            check(fits, f"wrong where they are seen, in the order {order}")
        except scripting.Failure as failure:
            check(not fits and "another scene" in str(failure), f"right where they are seen, in the order {order}: {failure}")

# evaluate.py: the dataset is seen from above, z up. The second scene is missing.
up = numpy.diag((1.0, -1.0, -1.0, 1.0))
os.makedirs("data/Part_1/Scenes")
os.makedirs("data/Part_1/Results")
write_stl("data/Part_1/Part_1.STL", mesh)
surface = places[numpy.isfinite(places).all(axis=1)][::5] @ up[:3, :3]
write_pcd("data/Part_1/Scenes/Scene0.pcd", surface, len(surface), 1, "x y z")
outline = numpy.array(points(edges)) @ up[:3, :3]
write_pcd("data/Part_1/Scenes/Scene_boundary0.pcd", outline, len(outline), 1, "x y z")
writer = connect(vtkMEAMPoseWriter(), poses(*[tuple((up @ t).ravel()) for t in true]))
writer.SetFileName("data/Part_1/Results/trans0.txt")
writer.Write()
text = works("evaluate.py", "tohoku", "data", "--parts", "1", "--scenes", "0", "--poses", "2", "--out", "result")
check(len(read("result/Part_1/trans0.txt").split()) == 32, "two matrices are written")
row, = csv.DictReader(read("result/tohoku.csv").splitlines())
check(row["part"] == "1" and float(row["strict"]) >= 50 and float(row["ms"]) > 0, f"the row is {row}")
check(f"{float(row['strict']):.1f}" in text, "the table shows the same")
shown = dict(zip(text.splitlines()[0].split(), text.splitlines()[1].split()))
check(shown["R@99"] == f"{float(row['recall_99']):.1f}" and 0 < float(row["recall_99"]) <= float(row["recall"]), f"recall at 99 %: {text}")
result = script("evaluate.py", "tohoku", "data", "--parts", "1", "--scenes", "0,1", "--poses", "2", "--out", "result")
check(result.returncode == 1 and "scene 1: cannot read" in result.stderr and "1 failed, see above" in result.stderr, result.stderr)
rows = list(csv.DictReader(read("result/tohoku.csv").splitlines()))
check(math.isclose(float(rows[0]["strict"]), float(row["strict"]) / 2), "the missing scene counts")
check(os.listdir("result/Part_1") == ["trans0.txt"], "there is no file for the missing scene")
# True poses that are not of the scene, and poses of another program that are not there.
for name in ("Scene", "Scene_boundary"):
    shutil.copy(f"data/Part_1/Scenes/{name}0.pcd", f"data/Part_1/Scenes/{name}1.pcd")
away = up @ true
away[:, :3, 3] += (40, 40, 20)
writer = connect(vtkMEAMPoseWriter(), poses(*[tuple(t.ravel()) for t in away]))
writer.SetFileName("data/Part_1/Results/trans1.txt")
writer.Write()
os.makedirs("away/Part_1")
shutil.copy("data/Part_1/Results/trans1.txt", "away/Part_1")
result = script("evaluate.py", "tohoku", "data", "--parts", "1", "--scenes", "1", "--found", "away")
check(result.stdout.splitlines()[1].split()[4] == "0.0", f"poses that equal true ones of another scene: {result.stdout}")
check(result.returncode == 1 and "scene 1: the true poses fit" in result.stderr and "another part or another scene" in result.stderr, result.stderr)
text = works("evaluate.py", "tohoku", "data", "--parts", "1", "--scenes", "0", "--poses", "2", "--found", "result")
check(text.splitlines()[1].split()[4] == f"{float(row['strict']):.1f}", "our own poses, judged again")
# --why: a row for each true instance, with the reason of one that is not there.
for name in ("Scene", "Scene_boundary"):
    shutil.copy(f"data/Part_1/Scenes/{name}0.pcd", f"data/Part_1/Scenes/{name}2.pcd")
writer = connect(vtkMEAMPoseWriter(), poses(*[tuple(t.ravel()) for t in (*(up @ true), away[0])]))
writer.SetFileName("data/Part_1/Results/trans2.txt")
writer.Write()
works("evaluate.py", "tohoku", "data", "--parts", "1", "--scenes", "2", "--poses", "2", "--why", "why.csv")
*rows, missed = csv.DictReader(read("why.csv").splitlines())
check(len(rows) == len(true) and all((row["found by"] == "") == (row["why"] != "") for row in (*rows, missed)), f"{rows} {missed}")
check(missed["lost in"] == "voting" and "lost in voting" in missed["why"] and missed["found by"] == "", f"{missed}")
refuses("leave --found out", "evaluate.py", "tohoku", "data", "--parts", "1", "--found", "result", "--why", "w.csv")
refuses("result has no folder Part_2 with the poses of part 2", "evaluate.py", "tohoku", "data", "--parts", "2", "--found", "result")
# Noise: the same again with the same one.
noisy = [works("evaluate.py", "tohoku", "data", "--parts", "1", "--scenes", "0", "--poses", "2", "--noise", noise,
               "--out", "noisy") and read("noisy/Part_1/trans0.txt") for noise in ("0.2", "0.2", "0.1%")]
check(noisy[0] == noisy[1] != noisy[2], "the noise is not what was asked for")
check(noisy[0] != read("result/Part_1/trans0.txt"), "there is no noise")
for noise in ("loud", "-1", "nan", "inf", "%"):
    result = script("evaluate.py", "tohoku", "data", "--noise", noise)
    check(result.returncode == 2 and result.stderr.rstrip().endswith(f"0 or more, not {noise}"), result.stderr)

# compare_models.py: a row for each model, the same scenes for all.
text = works("compare_models.py", "--tohoku", "data", "--parts", "1", "--scenes", "1", "--simulated", "1", "--copies", "2",
             "--poses", "2", "--only", "whole,mesh-both" if LONG else "mesh-both", "--out", "models.md")
check(text.strip() == read("models.md").strip() and text.count("###") == 2, f"two tables: {text}")
rows = [[cell.strip() for cell in line.strip("|").split("|")] for line in text.splitlines() if "MEAM |" in line or "mesh edges |" in line]
check(len(rows) == (4 if LONG else 2) and all(float(row[1].rstrip(" %")) >= 50 and float(row[5]) > 1000 for row in rows), f"{text}")

# calibration.py: every pose is in one row; by edges and surface right poses are likely.
text = works("calibration.py", "data", "--parts", "1", "--scenes", "0", "--noise", "0")
tables = [[[cell.strip(" %") for cell in line.strip("|").split("|")] for line in table.splitlines()[4:] if line.startswith("|")]
          for table in text.split("### ")[1:]]
totals = [int(table.split("poses: ")[1].split()[0]) for table in text.split("### ")[1:]]
check([sum(int(row[1]) for row in table) for table in tables] == totals and len(totals) == 2 and totals[0] > 0, text)
check(float(tables[0][-1][2]) >= 50 and text.count("log(Certainty)") == 2, text)

# evaluate.py world: a bin with the part and one without; a run that was stopped goes on.
WORLD = ("evaluate.py", "world", "--parts", "hole_plate", "--sensors", "time-of-flight", "--bins", "1", "--copies", "3",
         "--poses", "2", "--features", "both", "--scenes", "bins", "--out", "world")
result = script(*WORLD)
check(result.returncode == 0 and result.stderr.count("training") == 1 and "2 of 2: hole_plate by both" in result.stderr, result.stderr)
table, rows = result.stdout, list(csv.DictReader(read("world/world.csv").splitlines()))
check(read("world/world.md") == table and "| hole_plate | time-of-flight | both |" in table, table)
check([row["bin"] for row in rows] == ["hole_plate", "pipe_elbow"] and all(row["failure"] == "" for row in rows), f"{rows}")
check(int(rows[0]["right"]) >= 1 and 0 < float(rows[0]["mm"]) < 5 and float(rows[0]["ms"]) > 0, f"{rows[0]}")
check(rows[1]["right"] == "0" and rows[1]["mm"] == "", f"{rows[1]}")
check(50 < float(rows[0]["AR"]) <= 100 and 50 < float(rows[0]["AP2-20"]) <= 100 and rows[1]["targets"] == "0", f"{rows}")
check(0 < int(rows[0]["half_visible_found"]) <= int(rows[0]["half_visible"]) <= 3 and rows[1]["half_visible"] == "0", f"{rows}")
found = list(csv.DictReader(read("world/poses.csv").splitlines()))
check(sum(row["found"] == "1" for row in found) == int(rows[0]["half_visible_found"]), "half visible ones that were found")
at = [cell.strip() for cell in table.splitlines()[0].split("|")].index("R@99")
shown = [cell.strip() for cell in table.splitlines()[2].split("|")][at]
check(0 < float(shown.rstrip(" %")) <= 100, f"recall at 99 %: {shown}")
likely = [{"probability": f"{0.9 - k / 1000}", "found": "1"} for k in range(150)] + [{"probability": "0.05", "found": "1"}]
check(world.recall_at_precision_99(likely + [{"probability": "0.1", "found": "0"}] * 2, 200) == 75, "150 before two wrong ones")
check(world.recall_at_precision_99(likely + [{"probability": "0.1", "found": "0"}, {"probability": "0.1", "found": ""}], 200) == 75.5,
      "one of 152 is wrong, and one does not count")
check(len(found) == sum(int(row["poses"]) for row in rows), "a row for each pose")
check(f"{len(found)} poses" in table and sorted(os.listdir("bins"))[0] == "hole_plate_time-of-flight_3_1.vtp", table)
# A hundred poses that claim 0.5, of which 80 are right, and a hundred that are sure: by chance a class of 0.5 is off by 0.05
# at one standard deviation, in one of 20 draws by about twice that.
claimed = [{"probability": "0.5", "right": str(int(k < 80))} for k in range(100)] + [{"probability": "1", "right": "1"}] * 100
told = world.largest_gap(claimed)
check("claims 50.0 %, and 80.0 % of it are right" in told, told)
by_chance = float(told.split("largest gap of ")[1].split(" %")[0])
check(8 <= by_chance <= 12, told)

whole = read("world/world.csv")
with open("world/world.csv", "w") as file:
    file.write(whole[:-3])
before = read("world/poses.csv")
result = script(*WORLD)
check(result.returncode == 0 and "2 of 2" in result.stderr and "1 of 2" not in result.stderr, result.stderr)
check(read("world/poses.csv") == before, "the same poses again, from the bins that were kept")
check([line.split(",")[:-2] for line in read("world/world.csv").splitlines()]
      == [line.split(",")[:-2] for line in whole.splitlines()], "the same rows again, but for the times")
result = script(*WORLD)
check(result.returncode == 0 and result.stderr == "" and result.stdout == read("world/world.md"), "nothing is left to do")
for extension in (".vts", ".vtp"):  # a bin that cannot be read
    with open("bins/hole_plate_time-of-flight_3_1" + extension, "w") as file:
        file.write("nothing")
result = script(*WORLD[:-1], "broken")
failed, absent = csv.DictReader(read("broken/world.csv").splitlines())
check(result.returncode == 1 and "1 failed" in result.stderr, result.stderr)
check("hole_plate" in failed["failure"] and failed["right"] == "0" and absent["failure"] == "", f"{failed}")

# robustness.py: a bin that gets worse.
PART = os.path.join(EXAMPLES, "parts", "hole_plate.stl")
if LONG:
    result = script("robustness.py", "--cad", PART, "--copies", "3", "--scenes", "1", "--poses", "3", "--out", "curve.csv")
    check(result.returncode == 0, result.stderr)
    rows = list(csv.DictReader(read("curve.csv").splitlines()))
    check(len(rows) == 17 and len(result.stdout.splitlines()) == 1 + 18, "a row for each level, the usual one is in both curves")
    check(float(rows[0]["strict"]) == 100, f"three of three where the depth has no noise: {rows[0]}")

# Bad input.
for arguments, word in ((("--parts", "nothing"), "there is no nothing"), (("--sensors", "eye"), "there is no eye"), (("--features", "ears"), "there is no ears")):
    result = script("evaluate.py", "world", *arguments, "--out", "o")
    check(result.returncode == 2 and word in result.stderr and not os.path.exists("o"), result.stderr)
refuses("cannot read nowhere", "compare_models.py", "--tohoku", "nowhere", "--out", "o.md")
result = script("evaluate.py", "tohoku", "nowhere", "--out", "o")
check(result.returncode == 1 and "cannot read nowhere" in result.stderr and not os.path.exists("o"), result.stderr)
for arguments in (("--cad", "nothing.stl"), ("--cad", PART, "--scenes", "0"), ("--cad", PART, "--out", "no/such/curve.csv")):
    result = script("robustness.py", *arguments)
    check(result.returncode != 0 and "Traceback" not in result.stderr and result.stderr, f"{arguments}: {result.stderr}")
