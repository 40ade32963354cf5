# SPDX-License-Identifier: BSD-3-Clause
"""The page of what was found, `ppfmeam detect --report` and Detections.save(): one file, its numbers are those of the poses and of the
scan; how results show themselves in a notebook."""
import argparse
import base64
import html
import json
import os
import re
import warnings

import numpy
from vtkmodules.util.numpy_support import vtk_to_numpy

import ppfmeam
from ppfmeam.batch import pages
from ppfmeam.report import content, notebook, outlines, page, projection, told
from meamtest import box, check, read, rows_of, skip, write
from scripttest import H, W, refuses, scan_of_bin, script, works, write_pcd, write_stl

try:
    page.require_three()
except ppfmeam.Error as error:
    check("libjs-three" in str(error), f"the message names the package: {error}")
    skip(str(error))

MOST_BYTES = 10e6  # of a scan of 1.3 megapixels
RED, GREEN, CYAN = "#dc1e1e", "#28aa32", "#00d9d9"


def data_of(text):
    return json.loads(re.search('<script type="application/json" id="data">(.*?)</script>', text, re.S)[1])


def points_of(cloud):
    shares = numpy.frombuffer(base64.b64decode(cloud["positions"]), "<u2").reshape(-1, 3)
    return numpy.array(cloud["low"]) + shares * numpy.array(cloud["step"])


def outline_of(pose):
    return numpy.array(re.findall(r"[-\d.]+", pose["outline"]), float).reshape(-1, 2)


def is_alone(text):
    """Whether a page asks for nothing of others."""
    return not re.search(r'<link|<script[^>]* src=|@import|(src|href)="(?!data:)', text[:text.index("<!-- three.js")])


scan, truth, mesh = scan_of_bin()
points, grey = vtk_to_numpy(scan.GetPoints().GetData()), vtk_to_numpy(scan.GetPointData().GetArray("Intensity"))
write_stl("plate.stl", mesh)
write_stl("box.stl", box(90, 60, 30))
write_pcd("scan.pcd", numpy.column_stack((points, grey)), W, H, "x y z intensity")

# The command.
works("detect.py", "--cad", "plate.stl", "--scene", "scan.pcd", "--poses", "0", "--report", "found.html", "--matrices", "found.txt")
text = read("found.html")
data = data_of(text)
poses = numpy.loadtxt("found.txt").reshape(-1, 16)
check(len(poses) >= 2 and is_alone(text), f"{len(poses)} poses, and nothing from elsewhere")
check(len(text) < MOST_BYTES / 2, f"{len(text)} bytes of a sixth of a megapixel")
check(numpy.allclose([pose["transform"] for pose in data["poses"]], poses, atol=1e-4), "the poses of the file")
check([pose["color"] for pose in data["poses"][:2]] == [RED, GREEN], "the colors of the ranks")
shown, measured = points_of(data["scan"]), points[numpy.isfinite(points).all(axis=1)]
distances = numpy.abs(shown[::5000, None] - measured[None]).max(axis=2).min(axis=1)
check(len(shown) > 100000 and distances.max() < 0.05, f"{len(shown)} points of the scan, {distances.max()} mm off")
check(numpy.allclose(data["parts"][0]["size"], numpy.ptp(points_of(data["parts"][0]), axis=0), atol=0.01), "the part")
check(len(re.findall('<tr data-rank', text)) == len(re.findall('<path data-rank', text)) == len(poses), "a row and an outline for each")
for word in ("plate in scan.pcd", "ppfmeam detect --cad plate.stl", "detection", "poses</td>"):
    check(word in text, f"the page has {word}")
check(data["why"] == "ppfmeam why plate.stl scan.pcd --poses 0 --at {x} {y} {z}", data["why"])
check(all(re.match(r"Most for it: .*\n\nFor it, in .*\nAgainst it: ", pose["why"], re.DOTALL) for pose in data["poses"]), data["poses"][0]["why"])

# An outline is where the part is: around the pixels of its surface's points, no farther than they.
rows, columns = numpy.nonzero(numpy.isfinite(points.reshape(H, W, 3)).all(axis=2))
fitted = projection.Fitted(points.reshape(H, W, 3))
pixels, _ = fitted(points.reshape(H, W, 3)[rows, columns].astype(float))
check(numpy.abs(pixels - numpy.stack((columns, rows), axis=1)).max() < 0.1, "the camera of the scan")
part, best = content.Part("plate", mesh), data["poses"][0]
corners, _ = part.copy(numpy.array(best["transform"]).reshape(4, 4))
pixels, drawn = fitted(corners)[0], outline_of(best)
check(numpy.abs(pixels.min(axis=0) - drawn.min(axis=0)).max() < 3 and numpy.abs(pixels.max(axis=0) - drawn.max(axis=0)).max() < 3,
      f"the outline ends where the part does: {pixels.min(axis=0)}, {drawn.min(axis=0)}, {pixels.max(axis=0)}, {drawn.max(axis=0)}")

# What is hidden at first hides no outline, and has one.
copies = [part.copy(numpy.array(pose["transform"]).reshape(4, 4)) for pose in data["poses"]]
is_likely = [pose["place"] >= 0.5 for pose in data["poses"]]
check(0 < sum(is_likely) < len(copies) and all(pose["outline"] for pose in data["poses"]), f"likely and unlikely ones: {is_likely}")
some = [copy for copy, likely in zip(copies, is_likely) if likely]
of_all = [paths for paths, likely in zip(outlines.outlines(fitted, copies, is_likely), is_likely) if likely]
for one, other in zip(of_all, outlines.outlines(fitted, some, [True] * len(some))):
    check(len(one) == len(other) and all((a == b).all() for a, b in zip(one, other)), "an unlikely pose cuts an outline")

# The camera of an image beside the sensor, with a lens: as the calibration has it.
x, y, z = points_of(data["scan"])[::5000].T
lens = {"fx": 800, "fy": 790, "cx": 300, "cy": 250, "width": 640, "height": 480, "coeffs": [-0.3, 0.1, 0.001, -0.002, 0.02]}
write("lens.json", json.dumps(lens))
seen = ppfmeam._core.Scan(points.reshape(H, W, 3))
seen.image, seen.image_camera = numpy.zeros((480, 640), numpy.uint8), ppfmeam._core.load_camera("lens.json")
pixels, depth = content.Seen(seen).projection(numpy.stack((x, y, z), axis=1))
x, y, (k1, k2, p1, p2, k3) = x / z, y / z, lens["coeffs"]
r = x * x + y * y
radial = 1 + k1 * r + k2 * r ** 2 + k3 * r ** 3
wanted = numpy.stack((800 * (x * radial + 2 * p1 * x * y + p2 * (r + 2 * x * x)) + 300,
                      790 * (y * radial + p1 * (r + 2 * y * y) + 2 * p2 * x * y) + 250), axis=1)
check(numpy.allclose(pixels, wanted, atol=1e-6) and numpy.allclose(depth, z), f"{numpy.abs(pixels - wanted).max()} pixels off")

# Two types of part; a trained model without its mesh; a scan without an image; points alone.
works("train.py", "--cad", "plate.stl", "--out", "plate.meam")
region = ("--roi", "-1000", "1000", "-1000", "1000", "0", "3000")
works("detect.py", "--model", "plate.meam", "--scene", "scan.pcd", *region, "--report", "model.html")
model_data = data_of(read("model.html"))
check(model_data["why"] == f"ppfmeam why plate.meam scan.pcd {' '.join(region)} --at {{x}} {{y}} {{z}}", model_data["why"])
check("triangles" not in model_data["parts"][0] and all(pose["outline"] for pose in model_data["poses"]), "points of a model, outlined")
write_pcd("bare.pcd", points, W, H, "x y z")
check(script("detect.py", "--cad", "plate.stl", "--cad", "box.stl", "--scene", "bare.pcd", "--report", "two.html").returncode == 0, "two")
text = read("two.html")
check([part["name"] for part in data_of(text)["parts"]] == ["plate", "box"] and '<th class="text">part</th>' in text, "two parts")
why = data_of(text)["why"]
check(why == "ppfmeam why bare.pcd --cad plate.stl --cad box.stl --at {x} {y} {z}", why)
works("why.py", *why.format(x=0, y=0, z=5).split()[2:], "--report", "nothing.html")
numpy.savetxt("first.txt", numpy.reshape(data_of(text)["poses"][0]["transform"], (4, 4)))
works("why.py", *why.split()[2:-4], "--pose", "first.txt", "--report", "which.html")
rows = data_of(read("which.html"))
check(len(rows["parts"]) == 2 and rows["poses"][0]["part"] == data_of(text)["poses"][0]["part"], f"{rows['poses']}")
check("it has no image" in text, "the surface in place of an image")
few = measured[::3]
write_pcd("few.pcd", few, len(few), 1, "x y z")
works("detect.py", "--cad", "plate.stl", "--scene", "few.pcd", "--report", "few.html")
check(data_of(read("few.html"))["scan"]["looks"] == [0, 0, 1], "points alone in their sensor's frame")
floor = measured * (1, 1, -1) + (0, 0, measured[:, 2].max())
check((content.Seen(ppfmeam._core.Scan(floor.astype(numpy.float32))).looks == (0, 0, -1)).all(), "points above a floor")
refuses("no such folder", "detect.py", "--cad", "plate.stl", "--scene", "scan.pcd", "--report", "nowhere/found.html")

# The command that asks why has what the scan and the part are read with; a list of scans has other files than depth images, too.
options = argparse.Namespace(model=[], cad=["p.stl"], camera="c.json", image_camera="i.json", scene_scale=1, cad_scale=25.4, solid=1, roi=None,
                             viewpoint=None, depth_scale=0.1)
for scan_file, image, words in (("d.png", "i.png", "--image i.png --image-camera i.json --cad-scale 25.4 --solid 1 --depth-scale 0.1"),
                                ("d.ply", "", "--cad-scale 25.4 --solid 1")):
    command = told.why_command(options, scan_file, image)
    check(command == f"ppfmeam why p.stl {scan_file} --camera c.json {words} --at {{x}} {{y}} {{z}}", command)
# It searches as was searched; what is of the page alone is left out.
vars(options).update(poses=0, probability=0.25, image_edges=False, features="edges", threads=1, preset="paper", cad_offset=[0.0, 0.0, 5.0], depth_scale=None, solid=0)
searched = "--cad-offset 0.0 0.0 5.0 --poses 0 --probability 0.25 --no-image --preset paper --features edges"
command = told.why_command(options, "d.ply", "i.png")
check(command == f"ppfmeam why p.stl d.ply --camera c.json --cad-scale 25.4 {searched} --at {{x}} {{y}} {{z}}", command)
options.preset = "ppf"
check("--method ppf --features edges --at" in told.why_command(options, "d.ply"), told.why_command(options, "d.ply"))
options = argparse.Namespace(model=[], cad=[], camera="c.json", image_camera=None, scene_scale=1, cad_scale=1, solid=0, roi=None, viewpoint=None, depth_scale=None)
options.cad, options.objects = [], [3, 5]
command = told.why_command(options, "set/test/000002/000007")
check(command.startswith("ppfmeam why set/test/000002/000007 --cad 3 --cad 5 --camera"), command)

# A method without probabilities: the page does not speak of any, and all poses are shown.
printed = works("detect.py", "--cad", "plate.stl", "--scene", "scan.pcd", "--poses", "2", "--method", "ppf", "--report", "ppf.html")
text = read("ppf.html")
check(not any(name in pose for pose in data_of(text)["poses"] for name in ("place", "probability", "certainty")), "no probabilities")
works("why.py", *data_of(text)["why"].format(x=0, y=0, z=5).split()[2:])
check(len(data_of(text)["poses"]) == 2 and text.count("came out; the method does not tell how likely a copy is there.") == 2, "on the page")
check("likely there than not" not in printed + text and "2 poses came out; the method does not tell how likely" in printed, printed)

# Why: the part's points by what the scan shows there; a place without a part.
works("why.py", "plate.meam", "scan.pcd", "--pose", "found.txt:1", "--poses", "0", "--report", "why.html")
data = data_of(read("why.html"))
states = numpy.frombuffer(base64.b64decode(data["marks"]["states"]), numpy.uint8)
told = ppfmeam.why("plate.meam", "scan.pcd", pose=poses.reshape(-1, 4, 4)[0], fit=True, poses=0)
check(len(states) == len(told.points) + len(told.unexplained), f"{len(states)} points, {len(told.unexplained)} of the scan beside it")
check(data["legend"][0] == [f"explained: {(states == 0).sum()}", CYAN] and (states == 0).mean() > 0.5 and data["chosen"] == 1 and
      len(points_of(data["marks"])) == len(states) > 50, f"the points and their states: {data['legend']}")
check("Found as rank 1" in read("why.html") and "Numbers of the steps" in read("why.html"), "the answer and the numbers")
works("why.py", "plate.meam", "scan.pcd", "--cad", "plate.stl", "--pose", "found.txt:1", "--report", "faces.html")
check("triangles" in data_of(read("faces.html"))["parts"][0], "the faces of the model's part")
works("why.py", "plate.meam", "scan.pcd", "--at", "0", "0", "5", "--report", "nowhere.html")
check(data_of(read("nowhere.html"))["poses"] == [] and "No part there" in read("nowhere.html"), "no part at the place")

# A page for each scan of a batch, and their list.
for place in ("one", "scans"):
    os.mkdir(place)
    os.link("scan.pcd", f"{place}/a b.pcd")
write_pcd("scans/coarse.pcd", points.reshape(H, W, 3)[::5, ::5].reshape(-1, 3), W // 5, H // 5, "x y z")
write("scans/bad.pcd", "no cloud")
for most, place in (("2", "one"), ("0", "scans")):
    works("batch.py", place, "--model", "plate.meam", "--poses", most, "--out", "all.csv", "--report", "pages", *["--why"] * (most == "2"))
    data = data_of(read("pages/a b.pcd.html"))
    check(all(("For it, in" in pose["why"]) == (most == "2") for pose in data["poses"]), f"the reasons with --why alone: {data['poses'][0]['why']}")
    check(data["why"] == f"ppfmeam why plate.meam '{place}/a b.pcd' --poses {most} --at {{x}} {{y}} {{z}}", data["why"])
check(sorted(os.listdir("pages")) == ["a b.pcd.html", "coarse.pcd.html", "index.html"], f"{os.listdir('pages')}")
check(numpy.allclose([pose["transform"] for pose in data["poses"]], poses, atol=1e-4), "the same poses")
text, advice = read("pages/index.html"), [row["advice"] for row in rows_of("all.scans.csv")]
check(advice[:2] == ["", ""] and advice[2].startswith("The part is ") and f"<td>{html.escape(advice[2])}</td></tr>" in text and html.escape(advice[2]) in read("pages/coarse.pcd.html"),
      f"what to change first: {advice}")
check('<a href="a%20b.pcd.html">a b.pcd</a>' in text and "<tr class=failed><td>bad.pcd</td>" in text, text)

line = {"scan": "a b.pcd", "rows": [], "find_s": "1", "warning": "No part was found.", "failure": "", "advice": ""}
pages.write_index("pages", [line, {**line, "scan": "b.pcd", "failure": "no cloud"}])
check(read("pages/index.html").count("<td>nothing stands out: ") == 1, "nothing found, and no advice")
for name in ("scan.pcd", "pages.html"):
    refuses(f"cannot write {name}: give a folder for the pages", "batch.py", "scans", "--cad", "plate.stl", "--out", "o.csv", "--report", name)

# In Python and in a notebook.
model = ppfmeam.train("plate.stl")
check(re.fullmatch(r"<ppfmeam.Model of plate, [\d.]+ mm, [1-9]\d* views, [1-9]\d* pairs. Nearly the same after half a turn: .*>", repr(model)),
      repr(model))
found = ppfmeam.detect(model, "scan.pcd", poses=2)
cell = found._repr_html_()
check(cell.count("<path data-rank") == cell.count("<tr data-rank") == len(found) and len(cell) < 4e5, f"a cell of {len(cell)} bytes")
found.save("python.html")
data = data_of(read("python.html"))
check(numpy.allclose([pose["transform"] for pose in data["poses"]], found.poses.reshape(-1, 16)), "the poses")
check(data["why"] == "print(ppfmeam.why('plate.stl', 'scan.pcd', poses=2, at=({x}, {y}, {z})))", data["why"])
check("ppfmeam.detect(&#x27;plate.stl&#x27;, &#x27;scan.pcd&#x27;, poses=2)" in read("python.html"), "the call")
check(data_of(html.unescape(notebook.Frame(read("python.html"))._repr_html_())) == data, "a frame holds the page")
with warnings.catch_warnings(record=True):
    nothing = ppfmeam.detect(ppfmeam.train("box.stl"), "scan.pcd", probability=1.0)
nothing.save("nothing.html")
check("no part found" in nothing._repr_html_() and "No part was found." in read("nothing.html"), "nothing found")

# Picks: what can be picked, and of each pose the gripper at its best pick.
printed = works("pick.py", "--cad", "plate.stl", "--scene", "scan.pcd", "--no-bin", "--cup", "6", "--json", "picks.json", "--report", "picks.html",
                "--picture", "picks.png")
data, rows = data_of(read("picks.html")), json.loads(read("picks.json"))["picks"]
best = {row["instances"] + 1: row for row in reversed(rows)}
check({gripper["rank"]: gripper["possible"] for gripper in data["grippers"]} == {rank: row["possible"] for rank, row in best.items()}, f"{data['grippers']}")
for gripper in data["grippers"]:
    row = best[gripper["rank"]]
    axes = numpy.array(row["transforms"])
    corners = (points_of(gripper) - axes[:3, 3]) @ axes[:3, :3]
    check(abs(corners[:, 2].max()) < 0.1 and numpy.abs(corners[corners[:, 2] > -0.1, :2]).max() < 3.1, f"a cup of 6 mm ends there: {corners.max(axis=0)}")
    said = data["poses"][gripper["rank"] - 1]["why"].splitlines()[0]
    check(said.startswith("Pick " if row["possible"] else "No pick: ") and (row["reasons"] or row["names"]) in said, said)
check(data["chosen"] == (rows[0]["instances"] + 1 if rows[0]["possible"] else 0) and len(data["parts"][0]["triangles"]) > 0, f"{data['chosen']}")
check(html.escape(json.loads(read("picks.json"))["report"]) in read("picks.html") and "plate in scan.pcd" in read("picks.html"), "the report")
check("ppfmeam pick --cad plate.stl" in read("picks.html") and data["why"].startswith("ppfmeam why plate.stl scan.pcd"), data["why"])
check(os.path.getsize("picks.png") > 10000, "the picture")
works("pick.py", "plate.stl", "scan.pcd", "--no-bin", "--cup", "6", "--json", "picks.txt")
check(read("picks.txt") == read("picks.json"), "JSON under any name")

os.utime("scan.pcd", (0, 0))
try:
    found.save("other.html")
    check(False, "another scan is not shown with these poses")
except ppfmeam.Error as error:
    check("scan.pcd was written anew" in str(error), str(error))
os.rename("scan.pcd", "gone.pcd")
for path, words in (("other.html", "cannot read scan.pcd"), ("nowhere/other.html", "cannot write nowhere/other.html: no such folder")):
    try:
        found.save(path)
        check(False, "a scan or a folder that is not there")
    except ppfmeam.Error as error:
        check(words in str(error), str(error))
os.rename("gone.pcd", "scan.pcd")

# A grid of which every second point is there, as in a thinned scan: numbers alone.
thin = points.reshape(H, W, 3).copy()
thin[:, 1::2] = numpy.nan
spacing = content.Seen(ppfmeam._core.Scan(thin)).spacing
check(0.5 < spacing / content.Seen(ppfmeam._core.Scan(points.reshape(H, W, 3))).spacing < 3, f"{spacing} mm between points")

# Large data become small.
large = numpy.zeros((1000, 1300, 3), numpy.float32)
large[..., 0], large[..., 1] = numpy.meshgrid(numpy.arange(1300) * 0.2, numpy.arange(1000) * 0.2)
large[..., 2] = 600 + numpy.random.default_rng(1).normal(0, 1, (1000, 1300))
seen = ppfmeam._core.Scan(large)
seen.image = numpy.random.default_rng(2).integers(0, 255, (1000, 1300, 3), numpy.uint8)  # the hardest to compress
text = page.html(seen, found.data, notebook.parts_of(found), notebook.Told.of_python(found))
check(len(text) < MOST_BYTES, f"{len(text)} bytes of 1.3 megapixels")

# Without three.js a sentence names its package.
page.THREE = "/nowhere"
try:
    found.save("none.html")
    check(False, "no page without three.js")
except ppfmeam.Error as error:
    check("install the Debian package libjs-three" in str(error) and not os.path.exists("none.html"), str(error))
