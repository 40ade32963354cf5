# SPDX-License-Identifier: BSD-3-Clause
"""The programs that measure, on a dataset of one scene or on simulated bins: tohoku.py, models.py, calibration.py, world.py,
robustness.py; and the page of their tables. With --long more of their choices."""
import math
import os
import shutil

import numpy
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy

from ppfmeam import evaluation, scripting
from ppfmeam.filters import vtkMEAMPoseWriter
from meamtest import LONG, Trained, check, points, poses, read, rows_of, run, tuples, write, written
import benchmarks
import page
import results
import scenes
import world
from scripttest import EXAMPLES, refuses, scan_of_bin, script, works, write_pcd, write_stl

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

# tohoku.py: the dataset is seen from above, z up. The second scene is missing.
up = numpy.diag((1.0, -1.0, -1.0, 1.0))
os.makedirs("data/Part_1/Scenes")
os.makedirs("data/Part_1/Results")
write_stl("data/Part_1/Part_1.STL", mesh)
surface = places[numpy.isfinite(places).all(axis=1)][::5] @ up[:3, :3]
write_pcd("data/Part_1/Scenes/Scene0.pcd", surface, len(surface), 1, "x y z")
outline = numpy.array(points(edges)) @ up[:3, :3]
write_pcd("data/Part_1/Scenes/Scene_boundary0.pcd", outline, len(outline), 1, "x y z")
written("data/Part_1/Results/trans0.txt", poses(*[tuple((up @ t).ravel()) for t in true]), vtkMEAMPoseWriter)
TOHOKU = ("tohoku.py", "data", "--parts", "1", "--poses", "2")
text = works(*TOHOKU, "--scenes", "0", "--matrices", "result", "--out", "result.csv")
check(len(read("result/Part_1/trans0.txt").split()) == 32, "two matrices are written")
row, = results.read("result.csv")
check(row["part"] == "1" and float(row["strict"]) >= 50 and float(row["ms"]) > 0, f"the row is {row}")
check(0 < float(row["recall_99"]) <= float(row["recall"]), f"recall at 99 %: {row}")
shown = dict(zip(*([cell.strip() for cell in line.strip("|").split("|")] for line in (text.splitlines()[0], text.splitlines()[2]))))
check(shown["recall"] == f"{float(row['recall']):.3f}", f"the table shows the same: {text}")
result = script(*TOHOKU, "--scenes", "0,1", "--matrices", "result", "--out", "result.csv")
check(result.returncode == 1 and "scene 1: cannot read" in result.stderr and "1 failed, see above" in result.stderr, result.stderr)
rows = results.read("result.csv")
check(math.isclose(float(rows[0]["strict"]), float(row["strict"]) / 2), "the missing scene counts")
check(os.listdir("result/Part_1") == ["trans0.txt"], "there is no file for the missing scene")
# True poses that are not of the scene, and poses of another program that are not there.
for name in ("Scene", "Scene_boundary"):
    shutil.copy(f"data/Part_1/Scenes/{name}0.pcd", f"data/Part_1/Scenes/{name}1.pcd")
away = up @ true
away[:, :3, 3] += (40, 40, 20)
written("data/Part_1/Results/trans1.txt", poses(*[tuple(t.ravel()) for t in away]), vtkMEAMPoseWriter)
os.makedirs("away/Part_1")
shutil.copy("data/Part_1/Results/trans1.txt", "away/Part_1")
result = script(*TOHOKU, "--scenes", "1", "--found", "away", "--out", "away.csv")
check(float(results.read("away.csv")[0]["strict"]) == 0, f"poses that equal true ones of another scene: {result.stdout}")
check(result.returncode == 1 and "scene 1: the true poses fit" in result.stderr and "another part or another scene" in result.stderr, result.stderr)
works(*TOHOKU, "--scenes", "0", "--found", "result", "--out", "again.csv")
check(results.read("again.csv")[0]["strict"] == row["strict"], "our own poses, judged again")
# --why: a row for each true instance, with the reason of one that is not there.
for name in ("Scene", "Scene_boundary"):
    shutil.copy(f"data/Part_1/Scenes/{name}0.pcd", f"data/Part_1/Scenes/{name}2.pcd")
written("data/Part_1/Results/trans2.txt", poses(*[tuple(t.ravel()) for t in (*(up @ true), away[0])]), vtkMEAMPoseWriter)
works(*TOHOKU, "--scenes", "2", "--why", "why.csv")
*rows, missed = rows_of("why.csv")
check(len(rows) == len(true) and all((row["found by"] == "") == (row["why"] != "") for row in (*rows, missed)), f"{rows} {missed}")
check(missed["lost in"] == "voting" and "lost in voting" in missed["why"] and missed["found by"] == "", f"{missed}")
refuses("leave --found out", *TOHOKU, "--found", "result", "--why", "w.csv")
refuses("result has no folder Part_2 with the poses of part 2", "tohoku.py", "data", "--parts", "2", "--found", "result")
# Noise: the same again with the same one.
noisy = [works(*TOHOKU, "--scenes", "0", "--noise", "0.2", "--matrices", "noisy") and read("noisy/Part_1/trans0.txt") for _ in range(2)]
check(noisy[0] == noisy[1], "the noise is not the same")
check((scenes.noise("0.2")(50), scenes.noise("1%")(50)) == (0.2, 0.5), "the noise is not what was asked for")
check(noisy[0] != read("result/Part_1/trans0.txt"), "there is no noise")
for noise in ("loud", "-1", "nan", "inf", "%"):
    result = script("tohoku.py", "data", "--noise", noise)
    check(result.returncode == 2 and result.stderr.rstrip().endswith(f"0 or more, not {noise}"), result.stderr)

# models.py: a row for each model, the same scenes for all.
choices = {"whole": "without MEAM", "mesh-both": "mesh visibility and mesh edges"} if LONG else {"mesh-both": "mesh visibility and mesh edges"}
bins = ["bins"] if LONG else []
works("models.py", "--tohoku", "data", "--parts", "1", "--scenes", "1", "--bins", str(len(bins)), "--copies", "2", "--poses", "2",
      "--only", ",".join(choices), "--out", "models.csv")
rows = results.read("models.csv")
check([(row["scenes"], row["model"]) for row in rows] == [(places, words) for places in ("Part 1", *bins) for words in choices.values()], f"{rows}")
check(all(float(row["strict"]) >= 50 and float(row["pairs"]) > 1000 and float(row["ms"]) > 0 for row in rows), f"{rows}")

# calibration.py: every pose is in one class; by edges and surface right poses are likely.
works("calibration.py", "--tohoku", "data", "--parts", "1", "--scenes", "0", "--noise", "0", "--out", "classes.csv")
rows = results.read("classes.csv")
kinds = [[row for row in rows if row["scenes"] == name] for name in ("edges and surface", "edges alone")]
check(all(sum(int(row["poses"]) for row in of[:-1]) == int(of[-1]["poses"]) > 0 and of[-1]["probability"] == "all" for of in kinds), f"{rows}")
check(float(kinds[0][-2]["right"]) >= 50 and all(0 < float(of[-1]["loss of the best fit"]) <= float(of[-1]["loss"]) + 1e-3 for of in kinds), f"{rows}")

# world.py: a bin with the part and one without; a run that was stopped goes on.
WORLD = ("world.py", "world", "--parts", "hole_plate", "--sensors", "time-of-flight", "--bins", "1", "--copies", "3",
         "--poses", "2", "--features", "both", "--scenes", "bins", "--out", "table.csv")
result = script(*WORLD)
check(result.returncode == 0 and "2 of 2: recommended by both, hole_plate" in result.stderr, result.stderr)
table, rows = result.stdout, rows_of("world/world.csv")
line, = results.read("table.csv")
check([line[name] for name in world.KIND] == ["hole_plate", "time-of-flight", "both"] and "| hole_plate | time-of-flight | both |" in table, table)
check([row["bin"] for row in rows] == ["hole_plate", "pipe_elbow"] and all(row["failure"] == "" for row in rows), f"{rows}")
check(int(rows[0]["right"]) >= 1 and float(rows[0]["ms"]) > 0 and rows[1]["right"] == "0", f"{rows}")
check(50 < float(rows[0]["AR"]) <= 100 and 50 < float(rows[0]["AP2-20"]) <= 100 and rows[1]["targets"] == "0", f"{rows}")
check(0 < int(rows[0]["half_visible_found"]) <= int(rows[0]["half_visible"]) <= 3 and rows[1]["half_visible"] == "0", f"{rows}")
found = rows_of("world/poses.csv")
check(sum(row["found"] == "1" for row in found) == int(rows[0]["half_visible_found"]), "half visible ones that were found")
check(0 < float(line["R@99"]) <= 100 and 0 < float(line["mm"]) < 5 and math.isclose(float(line["strict"]), 50 * int(rows[0]["right"])), f"{line}")
likely = [{"probability": f"{0.9 - k / 1000}", "found": "1"} for k in range(150)] + [{"probability": "0.05", "found": "1"}]
check(world.recall_at_precision_99(likely + [{"probability": "0.1", "found": "0"}] * 2, 200) == 75, "150 before two wrong ones")
check(world.recall_at_precision_99(likely + [{"probability": "0.1", "found": "0"}, {"probability": "0.1", "found": ""}], 200) == 75.5,
      "one of 152 is wrong, and one does not count")
check(f"{len(found)} poses" in result.stderr and sorted(os.listdir("bins"))[0] == "hole_plate_time-of-flight_3_1.vtp", result.stderr)
# A hundred poses that claim 0.5, of which 80 are right, and a hundred that are sure: by chance a class of 0.5 is off by 0.05
# at one standard deviation, in one of 20 draws by about twice that.
told = world.largest_gap(numpy.repeat((0.5, 1.0), 100), numpy.repeat((1.0, 0.0, 1.0), (80, 20, 100)))
check("claims 50.0 %, and 80.0 % of it are right" in told, told)
by_chance = float(told.split("largest gap of ")[1].split(" %")[0])
check(8 <= by_chance <= 12, told)
# Of two sensors and one part there is a line for each, and one for both.
lines = world.table([{**rows[0], "sensor": sensor} for sensor in ("eye", "nose")], [])
check([[line[name] for name in world.KIND] for line in lines] == [["hole_plate", "eye", "both"], ["hole_plate", "nose", "both"],
                                                                  ["all", "eye", "both"], ["all", "nose", "both"], ["all", "all", "both"]], f"{lines}")

whole = read("world/world.csv")
write("world/world.csv", whole[:-3])
before = read("world/poses.csv")
result = script(*WORLD)
check(result.returncode == 0 and "2 of 2" in result.stderr and "1 of 2" not in result.stderr, result.stderr)
check(read("world/poses.csv") == before, "the same poses again, from the bins that were kept")
check([line.split(",")[:-2] for line in read("world/world.csv").splitlines()]
      == [line.split(",")[:-2] for line in whole.splitlines()], "the same rows again, but for the times")
result = script(*WORLD)
check(result.returncode == 0 and " of 2: " not in result.stderr and result.stdout == table, "nothing is left to do")
if LONG:
    for extension in (".vts", ".vtp"):  # a bin that cannot be read
        write("bins/hole_plate_time-of-flight_3_1" + extension, "nothing")
    result = script(WORLD[0], "broken", *WORLD[2:])
    failed, absent = rows_of("broken/world.csv")
    check(result.returncode == 1 and "1 failed" in result.stderr, result.stderr)
    check("hole_plate" in failed["failure"] and failed["right"] == "" and absent["failure"] == "", f"{failed}")

# robustness.py: a bin that gets worse.
PART = os.path.join(EXAMPLES, "parts", "hole_plate.stl")
if LONG:
    result = script("robustness.py", PART, "--copies", "3", "--scenes", "1", "--poses", "3", "--out", "curve.csv")
    check(result.returncode == 0, result.stderr)
    rows = rows_of("curve.csv")
    check(len(rows) == 17, "a row for each level")
    check(float(rows[0]["strict"]) == 100, f"three of three where the depth has no noise: {rows[0]}")

# benchmarks.py: the time of a benchmark that grows with the square of its points.
runs = [{"run_name": "ByPoints/" + str(n), "run_type": "iteration", "points": n, "real_time": 2 * n * n, "time_unit": "us"} for n in (10, 20, 40)]
slope, = benchmarks.slopes(runs)
check(math.isclose(slope["slope"], 2) and math.isclose(slope["ms to"], 3.2) and slope["farthest from the line, %"] < 1e-6, f"{slope}")

# page.py: the page says what the files say, and leaves out tables that are not measured.
os.makedirs("tables")
results.write("tables/rings.csv", [{"edges": "image", "known": 10, "met": 9, "mm": 0.8063, "degrees": None, "met on average": 9.75, "least": 9, "most": 10,
                                    "date": "2026-01-02", "commit": "abc"}])
results.write("tables/slopes.csv", [{"benchmark": "x", "slope": 1.5, "date": "2026-01-03", "commit": "def"}])
text = page.page("tables", {"rings": "Rings", "slopes": "Growth", "noise": "Noise"})
check('<a id="rings"></a>' in text and "| image | 9 of 10 | 0.81 mm, - degrees | 9.8 | 9 to 10 |" in text and "2026-01-02, abc" in text, text)
check('<a id="slopes"></a>Growth: [slopes.csv](evaluation/slopes.csv), 2026-01-03, def' in text and "noise" not in text, text)

# What a switch changes follows its links, but for what chance changes as well.
switched = [{"world": world, "switch": switch, "copies": copies, **{name + end: value for end, of in (("", after), (", nothing changed", before))
                                                                    for name, value in zip(("found", "found at 99 %", "log loss"), of)}}
            for world, switch, copies, after, before in (("bins", "none", "412", ("1", "1", "1"), ("1", "1", "1")), ("bins", "signs", "412", ("388", "300", "11"), ("400", "340", "10")),
                                                         ("pipes", "signs", "", ("9", "", ""), ("10", "", "")), ("bins", "shared", "412", ("401", "3", "10.1"), ("400", "3", "10")))]
links = [f"[{name}](evaluation.md#ablation): " for name in ("none", "signs", "shared", "tiles")]
told = page.with_worth("".join(f"{link}old. " for link in links), switched)
check(told == "{}bins 412. {}bins -12 (-40), ×1.10. {}nothing. {}not measured on its own. ".format(*links), told)
check(page.with_worth(told, switched) == told, "and again the same")

# Bad input.
for arguments, word in ((("--parts", "nothing"), "there is no nothing"), (("--sensors", "eye"), "there is no eye"), (("--features", "ears"), "there is no ears")):
    result = script("world.py", "o", *arguments)
    check(result.returncode == 2 and word in result.stderr and not os.path.exists("o"), result.stderr)
result = script("models.py", "--tohoku", "nowhere", "--out", "o.csv")
check(result.returncode == 1 and "cannot read nowhere" in result.stderr and not os.path.exists("o.csv"), result.stderr)
result = script("tohoku.py", "nowhere", "--matrices", "o")
check(result.returncode == 1 and "cannot read nowhere" in result.stderr and not os.path.exists("o"), result.stderr)
for arguments in (("nothing.stl",), (PART, "--scenes", "0"), (PART, "--out", "no/such/curve.csv")):
    result = script("robustness.py", *arguments)
    check(result.returncode != 0 and "Traceback" not in result.stderr and result.stderr, f"{arguments}: {result.stderr}")
