# SPDX-License-Identifier: BSD-3-Clause
"""The scripts of examples/ that train and detect: a bin scan as files, with the CAD and with the trained model; bad input."""
import json
import math
import os
import re
import warnings

import numpy
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkMath

import ppfmeam
from ppfmeam import picture
from ppfmeam.filters import vtkMEAMBinSceneSource
from meamtest import box, bracket, check, connect, png, read, rows_of, run, scaled, tuples, write
from scripttest import EVALUATION, EXAMPLES, H, W, refuses, scan_of_bin, script, works, write_pcd, write_stl

SUBCOMMANDS = {"evaluate.py": ("bop",)}


def helps():
    """Each script and each of its subcommands says what it takes."""
    # No programs, and those of the ablation, which need a target of their own.
    shared = {"TestAblation.py", "ablation.py", "benchmarks.py", "chains.py", "charts.py", "page.py", "results.py", "scenes.py", "search.py",
              "siblings.py", "stage.py"}
    for name in sorted({*os.listdir(EXAMPLES), *os.listdir(EVALUATION)} - shared):
        if name.endswith(".py"):
            for subcommand in ((), *((word,) for word in SUBCOMMANDS.get(name, ()))):
                text = works(name, *subcommand, "--help")
                check(text.startswith("usage:"), f"{name} {subcommand}: {text}")


helps()

scan, truth, mesh = scan_of_bin()
write_stl("part.stl", mesh)
large_bracket = scaled(bracket(), 2)  # soon trained
write_stl("bracket.stl", large_bracket)
write_stl("box.stl", box(30, 20, 10))
places = vtk_to_numpy(scan.GetPoints().GetData())
grey = vtk_to_numpy(scan.GetPointData().GetArray("Intensity"))
write_pcd("scan.pcd", numpy.column_stack((places, grey)), W, H, "x y z intensity")
write_pcd("plain.pcd", places, W, H, "x y z")
png("image.png", grey.reshape(H, W))

# detect.py: the table, the times and three files.
text = works("detect.py", "--cad", "part.stl", "--scene", "scan.pcd", "--poses", "2", "--out", "a.csv", "--json", "a.json",
             "--matrices", "a.txt", "--threads", "2", "--method", "meam")
check([line.split()[0] for line in text.splitlines()] == ["rank", "1", "2", "found:", "scan:", "advice:", "edges:", "time:"] and "total" in text,
          f"a table of two, what the scan shows of its sensor, and times: {text}")
check(len(read("a.csv").splitlines()) == 3 and len(json.loads(read("a.json"))["poses"]) == 2, "two poses in the files")
transforms = numpy.array(read("a.txt").split(), float).reshape(-1, 4, 4)
true = numpy.array(tuples(truth, "Transform")).reshape(-1, 4, 4)
for found in transforms:
    check(min(numpy.abs(found - t).max() for t in true) < 1, f"not a true pose: {found}")
# pick.py: a sentence, and of each copy the best pick, with where the gripper goes.
text = works("pick.py", "part.stl", "scan.pcd", "--cup", "8", "--json", "picks.json")
picks = json.loads(read("picks.json"))
text_of_picks = text.split("\n", 1)[0]
check(text.startswith(picks["report"]), text)
told = re.match(r"(\d+) of (\d+) copies can be picked, by (\d+) of \d+ picks", text)
check(told and 0 < int(told[1]) <= int(told[2]) and (int(told[1]) < int(told[2])) == ("Copies " in text), text)
rows = [line.split() for line in text.splitlines() if " suction " in line]
check([row[1] for row in rows] == list(dict.fromkeys(str(pick["instances"] + 1) for pick in picks["picks"] if pick["possible"])) and
      len(rows) == int(told[1]), f"a row for each copy: {text}")
best = numpy.array(picks["picks"][0]["transforms"])
x, y, z, w = (float(word) for word in rows[0][-4:])
turn = numpy.zeros((3, 3)).tolist()
vtkMath.QuaternionToMatrix3x3((w, x, y, z), turn)
check(numpy.allclose([float(word) for word in rows[0][-7:-4]], best[:3, 3], atol=1e-3) and numpy.allclose(turn, best[:3, :3], atol=1e-4), f"{rows[0]} {best}")
few = json.loads((works("pick.py", "part.stl", "scan.pcd", "--cup", "8", "--covered", "0", "--json", "few.json"), read("few.json"))[1])["picks"]
check(sum(pick["possible"] for pick in few) < sum(pick["possible"] for pick in picks["picks"]), "less may lie on them")
result = script("pick.py", "part.stl", "scan.pcd", "--dep", "depth.png")
check(result.returncode == 2 and "unrecognized arguments: --dep depth.png" in result.stderr, f"no other option is meant: {result.stderr}")
without = re.match(r"(\d+) of", works("pick.py", "part.stl", "scan.pcd", "--cup", "8", "--no-bin"))
check(without and int(without[1]) >= int(told[1]), "no fewer copies can be picked where no walls are in the way")
both = works("pick.py", "scan.pcd", "--cad", "part.stl", "--cad", "box.stl", "--cup", "8", "--no-bin", "--json", "both.json")
told = json.loads(read("both.json"))
check(told["parts"] == ["part", "box"], f"{told['parts']}")
check({line.split()[-1] for line in both.splitlines() if " suction " in line} <= {"part", "box"}, both)
# As detect has it, the part may be one in metres that is moved; its grasps move with it.
write_stl("metres.stl", scaled(mesh, 0.001))
works("pick.py", "metres.stl", "scan.pcd", "--cad-scale", "1000", "--cad-offset", "0", "0", "5", "--time-limit", "60", "--cup", "8", "--json", "moved.json")
at, moved = (numpy.array([pick["transforms"] for pick in json.loads(read(name))["picks"] if pick["possible"]])[:, :3, 3] for name in ("picks.json", "moved.json"))
nearest = numpy.linalg.norm(at[:, None] - moved, axis=2).min(axis=1)
check(nearest.max() < 2, f"the picks of the moved part are {nearest} mm off")
refuses("no such file", "pick.py", "box.stl", "missing.pcd")
refuses("the name of a picture ends in .png or .jpg", "detect.py", "--cad", "part.stl", "--scene", "scan.pcd", "--picture", "found.gif")
# A scan without a part is none without a bin: nothing is picked, and what to look at is told.
floor = numpy.zeros((W * H, 3))
floor[:, 0], floor[:, 1], floor[:, 2] = numpy.arange(W * H) % W - W / 2, numpy.arange(W * H) // W - H / 2, 600
write_pcd("floor.pcd", floor, W, H, "x y z")
result = script("pick.py", "part.stl", "floor.pcd", "--cup", "8", "--json", "none.json")
check(result.returncode == 0 and result.stdout.startswith("There is no copy to pick. ") and "The scan shows no edges" in result.stdout, f"{result}")
check(json.loads(read("none.json"))["picks"] == [] and json.loads(read("none.json"))["advice"] in result.stdout, read("none.json"))
refuses("a gripper has no length foo; it has opening", "pick.py", "box.stl", "scan.pcd", "--gripper", "foo=3")
refuses("opening", "pick.py", "box.stl", "scan.pcd", "--opening", "-5")
# The trained model, and the image as a file, give the same poses.
text = works("train.py", "--cad", "part.stl", "--out", "model.vtpc", "--json", "train.json")
check("model.vtpc" in text and os.path.isdir("model"), "the model is written")
check(re.search(r"pairs in \d+\.\d MB, .* trained in \d", text) and "\nsymmetry: " in text, f"train.py says {text}")
trained = json.loads(read("train.json"))
check(text.endswith(f"\n{trained['conclusion']}\n") and trained["conclusion"].startswith("Nearly the same after half a turn: ") and
      0 < trained["pairs"] < 1e7, f"a conclusion ends it: {text}")
check(works("pick.py", "--model", "model.vtpc", "--cad", "part.stl", "scan.pcd", "--cup", "8").split("\n", 1)[0] == text_of_picks,
      "with the trained model the picks differ")
works("detect.py", "--model", "model.vtpc", "--scene", "scan.pcd", "--poses", "2", "--matrices", "c.txt")
check(read("c.txt") == read("a.txt"), "with the trained model the poses differ")
works("detect.py", "--model", "model.vtpc", "--scene", "scan.pcd", "--poses", "0", "--json", "all.json")
check(min(pose["probability"] for pose in json.loads(read("all.json"))["poses"]) < 0.5, "0 poses are all, unlikely ones, too")
works("detect.py", "--model", "model.vtpc", "--scene", "plain.pcd", "--image", "image.png", "--poses", "2", "--matrices", "b.txt")
check(read("b.txt") == read("a.txt"), "with the image of the file the poses differ")
check("mesh: open" not in text, text)
write("tray.obj", "".join(f"v {x} {y} {z}\n" for z in (0, 20) for y in (0, 50) for x in (0, 80)) +
      "f 1 3 4 2\nf 1 2 6 5\nf 3 7 8 4\nf 1 5 7 3\nf 2 4 8 6\n")  # without its upper side
text = works("train.py", "--cad", "tray.obj", "--out", "tray.vtpc", "--json", "tray.json")
check("\nmesh: open, 4 of its 17 edges have a face on one side alone" in text and json.loads(read("tray.json"))["border_edges"] == 4, text)
for _ in range(2):
    works("train.py", "--cad", "box.stl", "--out", "over.vtpc")  # again, over the old one
# What is known of a part's symmetries, also with the preset that does without; a box has three half turns.
for preset in ("recommended", "paper"):
    text = works("train.py", "--cad", "box.stl", "--out", "box.vtpc", "--models-info", "models_info.json", "--preset", preset)
    check("symmetry: 3 exact turns: 180, 180, 180 degrees" in text, f"of a box train.py says {text}")
    entry = json.loads(read("models_info.json"))["1"]
    check(len(entry["symmetries_discrete"]) == 3 and abs(entry["diameter"] - math.sqrt(1400)) < 1e-3, f"{entry}")
# The pieces go to a folder beside: one that holds something else stays as it is.
os.mkdir("mine")
write(os.path.join("mine", "drawing.step"), "precious")
result = script("train.py", "--cad", "box.stl", "--cad-scale", "0.001", "--out", "small.meam")
check(result.returncode == 0 and re.fullmatch(r"warning: the part is 0\.0\d+ mm long: a file in metres needs --cad-scale 1000\n", result.stderr), result.stderr)
refuses("other files", "train.py", "--cad", "bracket.stl", "--out", "mine.vtpc")
check(read(os.path.join("mine", "drawing.step")) == "precious", "the folder of the user is gone")
os.remove(os.path.join("mine", "drawing.step"))
os.rmdir("mine")
# An offset of the CAD is an offset of the poses: both are among the four that are all but sure there, in whatever order.
works("detect.py", "--cad", "part.stl", "--cad-offset", "0", "0", "5", "--scene", "scan.pcd", "--poses", "4",
      "--matrices", "d.txt", "--preset", "recommended")
moved = numpy.array(read("d.txt").split(), float).reshape(-1, 4, 4) @ (0, 0, 5, 1)
for transform in transforms:
    shift = numpy.abs(moved - transform[:, 3]).max(axis=1).min()
    check(shift < 0.2, f"the offset part is {shift} mm away")

# Two types of part: the left half of a bin of one, the right half of a bin of the other, seen by the same camera.
bins = {"1": connect(vtkMEAMBinSceneSource(), mesh), "2": connect(vtkMEAMBinSceneSource(), large_bracket)}
halves = numpy.arange(W * H) % W < W // 2
columns = []
for half in bins.values():
    data = run(connect(half, Copies=6, Seed=7, Width=W, Height=H, BinSize=300, SensorHeight=900))
    columns.append(numpy.column_stack((vtk_to_numpy(data.GetPoints().GetData()),
                                       vtk_to_numpy(data.GetPointData().GetArray("Intensity")))))
write_pcd("two.pcd", numpy.where(halves[:, None], *columns), W, H, "x y z intensity")
text = works("detect.py", "--cad", "part.stl", "--cad", "bracket.stl", "--scene", "two.pcd", "--poses", "4",
             "--out", "two.csv", "--json", "two.json", "--matrices", "two.txt")
check(text.startswith("rank  part  score") and "\ntime: " in text, f"a table with parts: {text}")
rows = rows_of("two.csv")
check(len(rows) == 4 and {row["obj_id"] for row in rows} == {"1", "2"}, f"both types are found: {rows}")
check([pose["obj_id"] for pose in json.loads(read("two.json"))["poses"]] == [int(row["obj_id"]) for row in rows], "JSON")
for row, found in zip(rows, numpy.array(read("two.txt").split(), float).reshape(-1, 4, 4)):
    here = bins[row["obj_id"]].GetOutputDataObject(1)
    miss = min(numpy.abs(found - t).max() for t in numpy.array(tuples(here, "Transform")).reshape(-1, 4, 4))
    check(miss < 1, f"{miss} mm from a true pose of part {row['obj_id']}: {found}")
with warnings.catch_warnings():
    warnings.simplefilter("ignore")
    together = ppfmeam.detect([ppfmeam.load("model.vtpc"), "bracket.stl"], "two.pcd", poses=4)
told = [(int(row["obj_id"]), [float(word) for word in row["t"].split()]) for row in rows]
check([(pose.part + 1, list(pose.transform[:3, 3])) for pose in together] == told, f"the same in Python: {together} {told}")
check(sorted({0, 1} & set(together.parts)) == [0, 1] and sum(len(together.of(k)) for k in (0, 1)) == 4, "by part")
check(tuples(together.data, "PartId") == [(part,) for part in together.parts], "as data")
for wrong in (2, -1, "a", True):
    try:
        together.of(wrong)
        check(False, f"there is no part {wrong!r}")
    except ppfmeam.Error as error:
        check("2 were looked for" in str(error), str(error))
for arguments in ({"rank": True}, {"rank": 1, "part": 1 - together.parts[0]}, {"at": (0, 0, 600), "part": -1}):
    try:
        together.why(**arguments)
        check(False, f"{arguments} are refused")
    except ppfmeam.Error:
        pass
told = together.why(rank=1)
again = together.why(at=told.points[told.states.index("explained")])
check((told.rank, told.part) == (again.rank, again.part) == (1, together.parts[0]), f"why: {told} {again}")
words = works("why.py", "two.pcd", "--cad", "part.stl", "--cad", "bracket.stl", "--at", *map(str, told.points[told.states.index("explained")]),
              "--poses", "4", "--json", "why.json")
check(words.startswith(f"{('part', 'bracket')[told.part]}: Found as rank ") and json.loads(read("why.json"))["part"] == told.part, words)
for wrong in (("two.pcd",), ("part.stl", "two.pcd", "--cad", "bracket.stl")):
    result = script("why.py", *wrong, "--at", "0", "0", "800")
    check(result.returncode == 2 and "or SCAN and --cad, or --model, once for each type of part" in result.stderr, result.stderr)
# Picks of both, each by its own grasps.
grasps = [ppfmeam.grasps(f"{name}.stl", grasps=2, opening=80) for name in ("part", "bracket")]
picks = ppfmeam.pick(together, grasps, "two.pcd", bin="none", opening=80)
check(len(picks) == 8 and (picks.parts == together.parts[picks.instances]).all() and set(picks.parts) == {0, 1}, f"{picks}")
check(all(name == grasps[part].names[grasp] for name, part, grasp in zip(picks.names, picks.parts, picks.grasps)), f"{picks}")
alone = ppfmeam.pick(together.of(1), grasps[1], "two.pcd", bin="none", opening=80)
check((alone.parts == 1).all() and len(alone) == 2 * len(together.of(1)), f"{alone}")
for few in (grasps[0], grasps[:1]):
    try:
        ppfmeam.pick(together, few, "two.pcd", bin="none")
        check(False, "grasps of one type are refused")
    except ppfmeam.Error as error:
        check("grasps of each type of part, in the order of detect(): found has 2 and grasps 1" in str(error), str(error))
result = script("detect.py", "--cad", "part.stl", "--cad", "box.stl", "--model", "model.vtpc", "--scene", "two.pcd")
check(result.returncode == 2 and "a --cad for each --model" in result.stderr, result.stderr)

# Bad input.
for name in ("empty.stl", "empty.ply", "empty.obj", "empty.pcd"):
    open(name, "w").close()
write("junk.stl", bytes(range(256)) * 4)
for name in ("junk.ply", "junk.obj", "junk.pcd", "junk.png", "junk.vtpc"):
    os.link("junk.stl", name)
with open("cut.stl", "wb") as file, open("part.stl", "rb") as whole:
    file.write(whole.read(5000))
with open("points.ply", "w") as file:
    file.write("ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
               "end_header\n0 0 0\n1 0 0\n0 1 0\n")
write("cut.ply", read("points.ply")[:-4])
write_pcd("nan.pcd", numpy.full((12, 3), numpy.nan), 4, 3, "x y z")
write_pcd("none.pcd", numpy.zeros((0, 3)), 0, 1, "x y z")
write_pcd("metres.pcd", numpy.column_stack((places / 1000, grey)), W, H, "x y z intensity")
png("small.png", numpy.zeros((20, 30)))
out = ("--out", "o.csv", "--json", "o.json", "--matrices", "o.txt")
refuses("cannot read none.stl", "detect.py", "--cad", "none.stl", "--scene", "scan.pcd", *out)
for name in ("empty.stl", "empty.ply", "empty.obj", "junk.stl", "junk.ply", "junk.obj", "cut.stl", "cut.ply"):
    refuses(name, "detect.py", "--cad", name, "--scene", "scan.pcd", *out)
refuses("mesh with faces", "detect.py", "--cad", "points.ply", "--scene", "scan.pcd", *out)
refuses("mesh with faces", "detect.py", "--cad", "scan.pcd", "--scene", "scan.pcd", *out)
refuses("known are .pcd, .ply", "detect.py", "--cad", "part.stl", "--scene", "points.las", *out)
refuses("it is a trained model, for the --model of commands that take one", "detect.py", "--cad", "model.vtpc", "--scene", "scan.pcd", *out)
refuses(".igs; CAD programs export .step", "detect.py", "--cad", "image.png", "--scene", "scan.pcd", *out)
refuses("is an image: give a depth image with --depth", "detect.py", "--cad", "part.stl", "--scene", "image.png", *out)
refuses("it is a folder", "detect.py", "--cad", "part.stl", "--scene", "model", *out)
refuses("the name of a page ends in .html", "detect.py", "--cad", "part.stl", "--scene", "scan.pcd", "--report", "o.pdf", *out)
for arguments, words in ((("detect.py", "--cad", "part.stl", "--scene", "plain.pcd", "--scene", "scan.pcd"), "argument --scene: it is given twice"),
                         (("train.py", "--cad", "part.stl", "--out", "o.meam", "--cad", "bracket.stl"), "argument --cad: it is given twice"),
                         (("evaluate.py", "bop", "bins", "--split", "a", "--split", "b"), "argument --split: it is given twice"),
                         (("evaluate.py", "bop", "bins", "--objects", "5-"), "argument --objects: it has to be whole numbers such as 1,5-7, not 5-"),
                         (("detect.py", "--model", "model.vtpc", "--cad", "part.stl", "--scene", "scan.pcd"), "--cad beside --model"),
                         (("why.py", "--model", "model.vtpc", "--cad", "part.stl", "scan.pcd", "--at", "0", "0", "0"), "--cad beside --model"),
                         (("pick.py", "--model", "model.vtpc", "scan.pcd"), "give a trained model by --model, and its --cad"),
                         (("pick.py", "model.vtpc", "scan.pcd"), "give a trained model by --model, and its --cad"),
                         (("pick.py", "scan.pcd", "--cad", "model.vtpc"), "give a trained model by --model, and its --cad"),
                         (("pick.py", "part.stl", "scan.pcd", "--opening", "60", "--cup", "20"), "--cup: not allowed with argument --opening")):
    result = script(*arguments)
    check(result.returncode == 2 and words in result.stderr and not os.path.exists("o.meam"), f"{arguments}: {result.stderr}")
for name in ("nowhere.pcd", "empty.pcd", "junk.pcd"):
    refuses(name, "detect.py", "--cad", "part.stl", "--scene", name, *out)
refuses("NaN", "detect.py", "--model", "model.vtpc", "--scene", "nan.pcd", *out)
refuses("no points", "detect.py", "--model", "model.vtpc", "--scene", "none.pcd", *out)
refuses("1000", "detect.py", "--model", "model.vtpc", "--scene", "metres.pcd", *out)
works("detect.py", "--model", "model.vtpc", "--scene", "metres.pcd", "--scene-scale", "1000", "--poses", "2",
      "--matrices", "metres.txt")
for scaled in numpy.array(read("metres.txt").split(), float).reshape(-1, 4, 4):
    difference = min(numpy.abs(scaled - transform).max() for transform in transforms)
    check(difference < 0.2, f"metres, scaled: a pose differs by {difference} mm")
os.remove("metres.txt")
larger = script("detect.py", "--cad", "part.stl", "--cad-scale", "12", "--scene", "scan.pcd")
check(larger.returncode == 0 and larger.stderr.startswith("warning: ") and "likely factor is 10" in larger.stderr, larger.stderr)
check("no image" in script("detect.py", "--model", "model.vtpc", "--scene", "plain.pcd").stdout, "a scan without an image")
for method in (("--method", "ppf"), ("--preset", "paper")):
    for no_image in ((), ("--no-image",)):
        refuses("of the depth, too (--preset recommended)", "detect.py", "--model", "model.vtpc", "--scene", "plain.pcd", *method, *no_image)
refuses("30 x 20", "detect.py", "--model", "model.vtpc", "--scene", "plain.pcd", "--image", "small.png", *out)
refuses("not a PNG", "detect.py", "--model", "model.vtpc", "--scene", "plain.pcd", "--image", "junk.png", *out)
refuses("only 3 points", "detect.py", "--model", "model.vtpc", "--scene", "points.ply", *out)
refuses("junk.vtpc", "detect.py", "--model", "junk.vtpc", "--scene", "scan.pcd", *out)
refuses("cannot write", "detect.py", "--cad", "part.stl", "--scene", "scan.pcd", "--out", "no/such/folder.csv")
path, os.environ["PATH"], display = os.environ["PATH"], "", os.environ.pop("DISPLAY", None)
try:
    picture.require_display()
    check(False, "no picture without a display and without xvfb")
except ppfmeam.Error as error:
    check("install the Debian package xvfb" in str(error), str(error))
os.environ["PATH"] = path
if display:
    os.environ["DISPLAY"] = display
refuses("mesh with faces", "train.py", "--cad", "points.ply", "--out", "o.vtpc")
refuses(".vtpc", "train.py", "--cad", "bracket.stl", "--out", "o.model")
refuses("cannot write", "train.py", "--cad", "part.stl", "--out", "o.vtpc", "--models-info", "no/such/folder.json")
os.remove("model/model_0_0.vtp")
refuses("model", "detect.py", "--model", "model.vtpc", "--scene", "scan.pcd", *out)
