# SPDX-License-Identifier: BSD-3-Clause
"""The scripts of examples/: a bin scan as files, with the CAD and with the trained model; a dataset; bad input."""
import csv
import json
import math
import os
import re
import subprocess
import sys
import tempfile

import numpy
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkCommonDataModel import vtkImageData
from vtkmodules.vtkIOGeometry import vtkSTLReader, vtkSTLWriter
from vtkmodules.vtkIOImage import vtkPNGWriter

from ppfmeam.filters import vtkMEAMBinSceneSource, vtkMEAMPoseWriter, vtkMEAMSceneEdgeExtraction
from meamtest import box, check, connect, points, poses, run, tuples

EXAMPLES = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", "examples")
SUBCOMMANDS = {"evaluate.py": ("tohoku", "bop")}
folder = tempfile.TemporaryDirectory()
os.chdir(folder.name)


def script(name, *arguments):
    environment = {k: v for k, v in os.environ.items() if k != "DISPLAY"}
    return subprocess.run([sys.executable, os.path.join(EXAMPLES, name), *arguments], env=environment,
                          capture_output=True, text=True)


def works(name, *arguments):
    result = script(name, *arguments)
    check(result.returncode == 0, f"{name} {arguments}: {result.stderr}")
    check(result.stderr == "", f"{name} {arguments} says {result.stderr}")
    return result.stdout


def refuses(word, name, *arguments):
    """Exit status 1, one message with the word, no file."""
    before = sorted(os.listdir())
    result = script(name, *arguments)
    what = f"{name} {' '.join(arguments)}: status {result.returncode}, {result.stderr}"
    check(result.returncode == 1 and word.lower() in result.stderr.lower(), f"expected '{word}': {what}")
    check(result.stderr.count("\n") == 1 and result.stderr.startswith(name), f"more than a message: {what}")
    check(sorted(os.listdir()) == before, f"left files behind: {what}")


def helps():
    """Each script and each of its subcommands says what it takes."""
    for name in sorted(os.listdir(EXAMPLES)):
        if name.endswith(".py"):
            for subcommand in ((), *((word,) for word in SUBCOMMANDS.get(name, ()))):
                text = works(name, *subcommand, "--help")
                check(text.startswith("usage:"), f"{name} {subcommand}: {text}")


def write_pcd(path, columns, width, height, fields):
    """Binary, floats."""
    count = len(fields.split())
    with open(path, "wb") as file:
        file.write(f"VERSION .7\nFIELDS {fields}\nSIZE{' 4' * count}\nTYPE{' F' * count}\nCOUNT{' 1' * count}\n"
                   f"WIDTH {width}\nHEIGHT {height}\nPOINTS {width * height}\nDATA binary\n".encode())
        file.write(numpy.ascontiguousarray(columns, dtype="<f4").tobytes())


def read(path):
    with open(path) as file:
        return file.read()


helps()

W, H = 640, 480
source = vtkMEAMBinSceneSource()
source.SetCopies(4)
source.SetWidth(W)
source.SetHeight(H)
scan = run(source)
truth, mesh = source.GetOutputDataObject(1), source.GetOutputDataObject(2)
stl = connect(vtkSTLWriter(), mesh)
stl.SetFileName("part.stl")
stl.SetFileTypeToBinary()
stl.Write()
places = vtk_to_numpy(scan.GetPoints().GetData())
grey = vtk_to_numpy(scan.GetPointData().GetArray("Intensity"))
write_pcd("scan.pcd", numpy.column_stack((places, grey)), W, H, "x y z intensity")
write_pcd("plain.pcd", places, W, H, "x y z")
image = vtkImageData()
image.SetDimensions(W, H, 1)
upwards = numpy.ascontiguousarray(grey.reshape(H, W)[::-1]).ravel()
image.GetPointData().SetScalars(numpy_to_vtk(upwards, deep=True))
png = connect(vtkPNGWriter(), image)
png.SetFileName("image.png")
png.Write()

# detect.py: the table, the times and three files.
text = works("detect.py", "--cad", "part.stl", "--scene", "scan.pcd", "--poses", "2", "--out", "a.csv", "--json", "a.json",
             "--matrices", "a.txt", "--threads", "2", "--method", "meam")
check(len(text.splitlines()) == 4 and text.startswith("rank") and "total" in text, f"a table of two and times: {text}")
check(len(read("a.csv").splitlines()) == 3 and len(json.loads(read("a.json"))["poses"]) == 2, "two poses in the files")
transforms = numpy.array(read("a.txt").split(), float).reshape(-1, 4, 4)
true = numpy.array(tuples(truth, "Transform")).reshape(-1, 4, 4)
for found in transforms:
    check(min(numpy.abs(found - t).max() for t in true) < 1, f"not a true pose: {found}")
# The image as a file, and the trained model, give the same poses.
works("detect.py", "--cad", "part.stl", "--scene", "plain.pcd", "--image", "image.png", "--poses", "2", "--matrices", "b.txt")
check(read("b.txt") == read("a.txt"), "with the image of the file the poses differ")
text = works("train.py", "--cad", "part.stl", "--out", "model.vtpc")
check("model.vtpc" in text and os.path.isdir("model"), "the model is written")
check(re.search(r"pairs in \d+\.\d MB, .* trained in \d", text) and "\nsymmetry: " in text, f"train.py says {text}")
works("detect.py", "--model", "model.vtpc", "--scene", "scan.pcd", "--poses", "2", "--matrices", "c.txt")
check(read("c.txt") == read("a.txt"), "with the trained model the poses differ")
works("train.py", "--cad", "part.stl", "--out", "model.vtpc")  # again, over the old one
# What is known of a part's symmetries, also with the preset that does without; a box has three half turns.
stl.SetInputDataObject(box(30, 20, 10))
stl.SetFileName("box.stl")
stl.Write()
for preset in ("recommended", "paper"):
    text = works("train.py", "--cad", "box.stl", "--out", "box.vtpc", "--models-info", "models_info.json", "--preset", preset)
    check("symmetry: 3 exact turns: 180, 180, 180 degrees" in text, f"of a box train.py says {text}")
    entry = json.loads(read("models_info.json"))["1"]
    check(len(entry["symmetries_discrete"]) == 3 and abs(entry["diameter"] - math.sqrt(1400)) < 1e-3, f"{entry}")
# The pieces go to a folder beside: one that holds something else stays as it is.
os.mkdir("mine")
with open(os.path.join("mine", "drawing.step"), "w") as file:
    file.write("precious")
refuses("other files", "train.py", "--cad", "part.stl", "--out", "mine.vtpc")
check(read(os.path.join("mine", "drawing.step")) == "precious", "the folder of the user is gone")
os.remove(os.path.join("mine", "drawing.step"))
os.rmdir("mine")
# An offset of the CAD is an offset of the poses.
works("detect.py", "--cad", "part.stl", "--cad-offset", "0", "0", "5", "--scene", "scan.pcd", "--poses", "2",
      "--matrices", "d.txt", "--preset", "recommended")
for moved in numpy.array(read("d.txt").split(), float).reshape(-1, 4, 4):
    shift = min(numpy.abs(moved @ (0, 0, 5, 1) - transform[:, 3]).max() for transform in transforms)
    check(shift < 0.2, f"the offset part is {shift} mm away")

# Two types of part: the left half of a bin of one, the right half of a bin of the other, seen by the same camera.
plate = vtkSTLReader()
plate.SetFileName(os.path.join(EXAMPLES, "parts", "hole_plate.stl"))
bins = {"1": vtkMEAMBinSceneSource(), "2": connect(vtkMEAMBinSceneSource(), plate)}
halves = numpy.arange(W * H) % W < W // 2
columns = []
for half in bins.values():
    for name, value in (("Copies", 6), ("Seed", 2), ("Width", W), ("Height", H), ("BinSize", 300), ("SensorHeight", 900)):
        getattr(half, "Set" + name)(value)
    data = run(half)
    columns.append(numpy.column_stack((vtk_to_numpy(data.GetPoints().GetData()),
                                       vtk_to_numpy(data.GetPointData().GetArray("Intensity")))))
write_pcd("two.pcd", numpy.where(halves[:, None], *columns), W, H, "x y z intensity")
text = works("detect.py", "--cad", "part.stl", "--cad", plate.GetFileName(), "--scene", "two.pcd", "--poses", "4",
             "--out", "two.csv", "--json", "two.json", "--matrices", "two.txt")
check(text.startswith("rank  part  score") and "\npart 2 time" in text, f"a table with parts: {text}")
rows = list(csv.DictReader(read("two.csv").splitlines()))
check(len(rows) == 4 and {row["obj_id"] for row in rows} == {"1", "2"}, f"both types are found: {rows}")
check([pose["obj_id"] for pose in json.loads(read("two.json"))["poses"]] == [int(row["obj_id"]) for row in rows], "JSON")
for row, found in zip(rows, numpy.array(read("two.txt").split(), float).reshape(-1, 4, 4)):
    here = bins[row["obj_id"]].GetOutputDataObject(1)
    miss = min(numpy.abs(found - t).max() for t in numpy.array(tuples(here, "Transform")).reshape(-1, 4, 4))
    check(miss < 1, f"{miss} mm from a true pose of part {row['obj_id']}: {found}")
result = script("detect.py", "--cad", "part.stl", "--cad", "box.stl", "--model", "model.vtpc", "--scene", "two.pcd")
check(result.returncode == 2 and "a --cad for each --model" in result.stderr, result.stderr)

# evaluate.py, on a dataset of our own: seen from above, z up. The second scene is missing.
up = numpy.diag((1.0, -1.0, -1.0, 1.0))
edges = run(connect(vtkMEAMSceneEdgeExtraction(), scan))
os.makedirs("data/Part_1/Scenes")
os.makedirs("data/Part_1/Results")
os.rename("part.stl", "data/Part_1/Part_1.STL")
os.symlink("data/Part_1/Part_1.STL", "part.stl")
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
result = script("evaluate.py", "tohoku", "data", "--parts", "1", "--scenes", "0,1", "--poses", "2", "--out", "result")
check(result.returncode == 1 and "scene 1: cannot read" in result.stderr and "1 failed, see above" in result.stderr, result.stderr)
rows = list(csv.DictReader(read("result/tohoku.csv").splitlines()))
check(math.isclose(float(rows[0]["strict"]), float(row["strict"]) / 2), "the missing scene counts")
check(os.listdir("result/Part_1") == ["trans0.txt"], "there is no file for the missing scene")
# Noise: the same again with the same one.
noisy = [works("evaluate.py", "tohoku", "data", "--parts", "1", "--scenes", "0", "--poses", "2", "--noise", noise,
               "--out", "noisy") and read("noisy/Part_1/trans0.txt") for noise in ("0.2", "0.2", "0.1%")]
check(noisy[0] == noisy[1] != noisy[2], "the noise is not what was asked for")
check(noisy[0] != read("result/Part_1/trans0.txt"), "there is no noise")
for noise in ("loud", "-1", "nan", "inf", "%"):
    for name in (("evaluate.py", "tohoku"), ("ablation.py",)):
        result = script(*name, "data", "--noise", noise)
        check(result.returncode == 2 and result.stderr.rstrip().endswith(f"0 or more, not {noise}"), result.stderr)

# compare_models.py: a row for each model, the same scenes for all.
text = works("compare_models.py", "--tohoku", "data", "--parts", "1", "--scenes", "1", "--simulated", "1", "--copies", "2",
             "--poses", "2", "--only", "whole,mesh-both", "--out", "models.md")
check(text.strip() == read("models.md").strip() and text.count("###") == 2, f"two tables: {text}")
rows = [[cell.strip() for cell in line.strip("|").split("|")] for line in text.splitlines() if "MEAM |" in line or "mesh edges |" in line]
check(len(rows) == 4 and all(float(row[1].rstrip(" %")) >= 50 and float(row[5]) > 1000 for row in rows), f"{text}")

# ablation.py: a row for each decision, with a time where the online phase is as it was.
text = works("ablation.py", "data", "--parts", "1", "--scenes", "0", "--poses", "2", "--only", "none,near,edges,no-refinement")
rows = [[cell.strip() for cell in line.strip("|").split("|")] for line in text.splitlines()[4:] if line]
check([row[0] for row in rows] == ["nothing", "no near-symmetries", "edges alone, no surface", "no refinement"], text)
check(all(float(row[1].rstrip(" %")) >= 50 for row in rows) and [row[5] == "-" for row in rows] == [False, False, True, True],
      text)

# calibration.py: every pose is in one row; by edges and surface right poses are likely.
text = works("calibration.py", "data", "--parts", "1", "--scenes", "0", "--noise", "0")
tables = [[[cell.strip(" %") for cell in line.strip("|").split("|")] for line in table.splitlines()[4:] if line.startswith("|")]
          for table in text.split("### ")[1:]]
totals = [int(table.split("poses: ")[1].split()[0]) for table in text.split("### ")[1:]]
check([sum(int(row[1]) for row in table) for table in tables] == totals and len(totals) == 2 and totals[0] > 0, text)
check(float(tables[0][-1][2]) >= 50 and text.count("log(Certainty)") == 2, text)

# Bad input.
for name in ("empty.stl", "empty.ply", "empty.obj", "empty.pcd"):
    open(name, "w").close()
with open("junk.stl", "wb") as file:
    file.write(bytes(range(256)) * 4)
for name in ("junk.ply", "junk.obj", "junk.pcd", "junk.png", "junk.vtpc"):
    os.link("junk.stl", name)
with open("cut.stl", "wb") as file, open("part.stl", "rb") as whole:
    file.write(whole.read(5000))
with open("points.ply", "w") as file:
    file.write("ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
               "end_header\n0 0 0\n1 0 0\n0 1 0\n")
with open("cut.ply", "w") as file:
    file.write(read("points.ply")[:-4])
write_pcd("nan.pcd", numpy.full((12, 3), numpy.nan), 4, 3, "x y z")
write_pcd("none.pcd", numpy.zeros((0, 3)), 0, 1, "x y z")
write_pcd("metres.pcd", numpy.column_stack((places / 1000, grey)), W, H, "x y z intensity")
small = vtkImageData()
small.SetDimensions(30, 20, 1)
small.GetPointData().SetScalars(numpy_to_vtk(numpy.zeros(600, numpy.uint8), deep=True))
png.SetInputDataObject(small)
png.SetFileName("small.png")
png.Write()
out = ("--out", "o.csv", "--json", "o.json", "--matrices", "o.txt")
refuses("cannot read none.stl", "detect.py", "--cad", "none.stl", "--scene", "scan.pcd", *out)
for name in ("empty.stl", "empty.ply", "empty.obj", "junk.stl", "junk.ply", "junk.obj", "cut.stl", "cut.ply"):
    refuses(name, "detect.py", "--cad", name, "--scene", "scan.pcd", *out)
refuses("no faces", "detect.py", "--cad", "points.ply", "--scene", "scan.pcd", *out)
refuses("mesh with faces", "detect.py", "--cad", "scan.pcd", "--scene", "scan.pcd", *out)
refuses("positive", "detect.py", "--cad", "part.stl", "--scene", "scan.pcd", "--scene-scale", "0", *out)
refuses("unknown kind", "detect.py", "--cad", "image.png", "--scene", "scan.pcd", *out)
for name in ("nowhere.pcd", "empty.pcd", "junk.pcd"):
    refuses(name, "detect.py", "--cad", "part.stl", "--scene", name, *out)
refuses("NaN", "detect.py", "--cad", "part.stl", "--scene", "nan.pcd", *out)
refuses("no points", "detect.py", "--cad", "part.stl", "--scene", "none.pcd", *out)
refuses("1000", "detect.py", "--cad", "part.stl", "--scene", "metres.pcd", *out)
works("detect.py", "--cad", "part.stl", "--scene", "metres.pcd", "--scene-scale", "1000", "--poses", "2",
      "--matrices", "metres.txt")
for scaled in numpy.array(read("metres.txt").split(), float).reshape(-1, 4, 4):
    difference = min(numpy.abs(scaled - transform).max() for transform in transforms)
    check(difference < 0.2, f"metres, scaled: a pose differs by {difference} mm")
os.remove("metres.txt")
larger = script("detect.py", "--cad", "part.stl", "--cad-scale", "12", "--scene", "scan.pcd")
check(larger.returncode == 0 and larger.stderr.startswith("warning: ") and "likely factor is 10" in larger.stderr, larger.stderr)
refuses("no image", "detect.py", "--cad", "part.stl", "--scene", "plain.pcd", *out)
refuses("30 x 20", "detect.py", "--cad", "part.stl", "--scene", "plain.pcd", "--image", "small.png", *out)
refuses("not a PNG", "detect.py", "--cad", "part.stl", "--scene", "plain.pcd", "--image", "junk.png", *out)
refuses("boundary", "detect.py", "--cad", "part.stl", "--scene", "points.ply", *out)
refuses("junk.vtpc", "detect.py", "--model", "junk.vtpc", "--scene", "scan.pcd", *out)
refuses("cannot write", "detect.py", "--cad", "part.stl", "--scene", "scan.pcd", "--out", "no/such/folder.csv")
refuses("display", "detect.py", "--cad", "part.stl", "--scene", "scan.pcd", "--picture", "o.png", *out)
refuses("no faces", "train.py", "--cad", "points.ply", "--out", "o.vtpc")
refuses(".vtpc", "train.py", "--cad", "part.stl", "--out", "o.model")
refuses("cannot write", "train.py", "--cad", "part.stl", "--out", "o.vtpc", "--models-info", "no/such/folder.json")
refuses("display", "simulated_bin.py", "--picture", "o.png")
refuses("cannot read nowhere", "ablation.py", "nowhere")
refuses("cannot read nowhere", "compare_models.py", "--tohoku", "nowhere", "--out", "o.md")
result = script("evaluate.py", "tohoku", "nowhere", "--out", "o")
check(result.returncode == 1 and "cannot read nowhere" in result.stderr and not os.path.exists("o"), result.stderr)
os.remove("model/model_0_0.vtp")
refuses("model", "detect.py", "--model", "model.vtpc", "--scene", "scan.pcd", *out)
