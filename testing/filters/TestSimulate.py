# SPDX-License-Identifier: BSD-3-Clause
"""simulate.py writes datasets whose depth, image, masks and truth fit each other; evaluate.py finds the parts in them."""
import contextlib
import csv
import html
import io
import json
import os
import re
import shutil
from unittest import mock

import numpy
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkIOImage import vtkPNGReader
from vtkmodules.vtkIOPLY import vtkPLYReader

from ppfmeam import dataset, evaluation, scripting
from ppfmeam.commands import evaluate
from ppfmeam.report import judged, page
from meamtest import check, close, connect, plate, read, rows_of, run, write
from scripttest import EXAMPLES, script

PART = os.path.join(EXAMPLES, "parts", "hole_plate.stl")
COPIES = 4
HAS_THREE = all(os.path.exists(os.path.join(page.THREE, name)) for name in page.LIBRARIES)


def simulate(*arguments):
    return script("simulate.py", *arguments)


def load(*path):
    return json.loads(read(os.path.join(*path)))


def pixels(*path):
    reader = connect(vtkPNGReader(), FileName=os.path.join(*path))
    check(reader.CanReadFile(reader.GetFileName()), f"{reader.GetFileName()} is not there")
    image = run(reader)
    width, height, _ = image.GetDimensions()
    return vtk_to_numpy(image.GetPointData().GetScalars()).reshape(height, width, -1)[::-1]


done = simulate("--cad", PART, "--copies", str(COPIES), "--scenes", "2", "--seed", "5", "--out", "plates", "--json", "told.json")
check(done.returncode == 0, done.stderr)
told = load("told.json")["scenes"]
check("".join("scene {scene}: {half_visible} of {copies} copies are at least half visible\n".format(**row) for row in told) == done.stdout
      and [row["copies"] for row in told] == [COPIES, COPIES], f"{told} of {done.stdout}")
check(sorted(os.listdir("plates")) == ["camera.json", "models", "test"], f"{os.listdir('plates')}")
check(sorted(os.listdir("plates/test")) == ["000000", "000001"], "two scenes")

# The part.
part = plate()
ply = connect(vtkPLYReader(), FileName="plates/models/obj_000001.ply")
check(close(run(ply).GetBounds(), part.GetBounds()), "the model is not the part")
info = load("plates/models/models_info.json")["1"]
check(abs(info["diameter"] - 84.5) < 0.5 and close([info["size_x"]], [74]), f"{info}")
check("symmetries_discrete" not in info, "the plate has no symmetry")

# The scenes.
K = load("plates/camera.json")
for scene in ("plates/test/000000", "plates/test/000001"):
    camera = load(scene, "scene_camera.json")["0"]
    check(close(camera["cam_K"], [K["fx"], 0, K["cx"], 0, K["fy"], K["cy"], 0, 0, 1]), "one camera")
    scale = camera["depth_scale"]
    raw = pixels(scene, "depth", "000000.png")
    depth = scale * raw[..., 0]
    check(raw.dtype == numpy.uint16 and depth.shape == (K["height"], K["width"]) and scale <= 0.05, "16 bits of depth")
    grey = pixels(scene, "gray", "000000.png")
    check(grey.shape == raw.shape and grey.dtype == numpy.uint8 and grey.std() > 10, "a grey image")
    truth, infos = load(scene, "scene_gt.json")["0"], load(scene, "scene_gt_info.json")["0"]
    check(len(truth) == len(infos) == COPIES, f"{len(truth)} copies")
    union = numpy.zeros(depth.shape, int)
    for i, (pose, entry) in enumerate(zip(truth, infos)):
        whole = pixels(scene, "mask", f"000000_{i:06d}.png")[..., 0] == 255
        visible = pixels(scene, "mask_visib", f"000000_{i:06d}.png")[..., 0] == 255
        union += visible
        check(not (visible & ~whole).any(), "what is seen is part of the whole")
        check(entry["px_count_all"] == whole.sum() and entry["px_count_visib"] == visible.sum(), f"{entry}")
        check(close([entry["visib_fract"]], [visible.sum() / whole.sum()]), f"{entry}")
        check(entry["px_count_valid"] == (whole & (depth > 0)).sum() > 0.5 * whole.sum(), f"{entry}")
        left, top, width, height = entry["bbox_obj"]
        check(whole[top:top + height, left:left + width].sum() == whole.sum(), "the box holds all of it")
        check(whole[top].any() and whole[top + height - 1].any() and whole[:, left].any(), "the box is narrow")
        # Measured points of the copy are within the part's bounds, where its pose is undone.
        rows, columns = numpy.nonzero(visible & (depth > 0))
        z = depth[rows, columns]
        points = numpy.stack(((columns - K["cx"]) / K["fx"] * z, (rows - K["cy"]) / K["fy"] * z, z))
        R, t = numpy.reshape(pose["cam_R_m2c"], (3, 3)), numpy.reshape(pose["cam_t_m2c"], (3, 1))
        check(numpy.allclose(R @ R.T, numpy.eye(3), atol=1e-6) and numpy.linalg.det(R) > 0, "a rotation")
        inside = R.T @ (points - t)
        low, high = numpy.reshape(part.GetBounds(), (3, 2)).T[..., None]
        check(((inside > low - 2) & (inside < high + 2)).all(), "points of the copy are not on the part")
    check(union.max() == 1, "a pixel shows one copy")
check(load("plates/test/000000/scene_gt.json") != load("plates/test/000001/scene_gt.json"), "another seed, another bin")

# A camera beside the sensor; the same seed again, with other noise.
done = simulate("--cad", PART, "--copies", str(COPIES), "--seed", "6", "--noise", "0", "--camera", "beside",
                "--baseline", "90", "--colored", "--out", "beside")
check(done.returncode == 0, done.stderr)
check(load("beside/test/000000/scene_gt.json") == load("plates/test/000001/scene_gt.json"), "the same bin")
check(not os.path.exists("beside/test/000000/rgb"), "an image that is not registered")
check(pixels("beside/test/000000/rgb_beside/000000.png").shape[2] == 3, "in colour")
calibration = load("beside/image_camera.json")
T = numpy.reshape(calibration["T_camera_scene"]["data"], (4, 4))
check(close([numpy.linalg.norm(T[:3, 3])], [90]), f"{T}")

# Another sensor: the same bin with as many pixels as that has.
done = simulate("--cad", PART, "--copies", str(COPIES), "--seed", "5", "--sensor", "time-of-flight", "--out", "flight")
check(done.returncode == 0, done.stderr)
check((load("flight/camera.json")["width"], load("flight/camera.json")["height"]) == (640, 480), "pixels of the sensor")
check(load("flight/test/000000/scene_gt.json") == load("plates/test/000000/scene_gt.json"), "the same bin")

for arguments in (["--out", "plates"], ["--out", "new", "--copies", "0"], ["--out", "new", "--noise", "-1"]):
    done = simulate("--cad", PART, *arguments)
    check(done.returncode != 0 and "Traceback" not in done.stderr and done.stderr, f"{arguments}: {done.stderr}")
check(simulate("--cad", "nothing.stl", "--out", "new").returncode == 1, "a file that is not there")

# What is found in them, and as the benchmark measures it.
done = script("evaluate.py", "bop", "plates", "--poses", "0", "--out", "plates.csv")
check(done.returncode == 0, done.stderr)
lines = done.stdout.splitlines()
at = next(i for i, line in enumerate(lines) if "recall of" in line)
check(lines[at].split()[-6:] == ["ADD", "ADI", "MSSD", "MSPD", "VSD", "AR"], lines[at])
recalls = [float(word) for word in lines[at + 1].split()[1:]]
check(len(recalls) == 6 and all(50 < recall <= 100 for recall in recalls[1:]), lines[at + 1])
check(abs(recalls[5] - sum(recalls[2:5]) / 3) < 0.2, "AR is the mean of three")
found = rows_of("plates.csv")
check(len(found) >= 6, "poses of both bins")
check(0 < float(lines[1].split()[8]) <= 100 and lines[0].split()[8] == "AP2-20", lines[0])
check(0 < float(lines[1].split()[9]) <= 100 and lines[0].split()[9] == "R@99", lines[0])

# The same poses, judged from that file, worst first, and from files of matrices, best first; the order of all is in the file alone.
with open("back.csv", "w", newline="", encoding="utf-8") as table:
    rows = csv.DictWriter(table, list(found[0]))
    rows.writeheader()
    rows.writerows(found[::-1])
os.makedirs("matrices/obj_000001")
for row in found:
    R, t = (row[name].split() for name in "Rt")
    with open(f"matrices/obj_000001/{int(row['scene_id']):06d}_000000.txt", "a", encoding="utf-8") as file:
        file.write(" ".join((*R[0:3], t[0], *R[3:6], t[1], *R[6:9], t[2], "0 0 0 1\n")))
for name in ("back.csv", "matrices"):
    again = script("evaluate.py", "bop", "plates", "--poses", "0", "--found", name)
    check(again.returncode == 0, again.stderr)
    figures, recalled = again.stdout.splitlines()[1].split(), again.stdout.splitlines()[4]
    where = slice(1, 9 if name == "back.csv" else 7)  # AP is of the order of all
    check(figures[where] == lines[1].split()[where] and recalled == lines[at + 1], f"{name}: {again.stdout} {done.stdout}")
with open("other.csv", "w", encoding="utf-8") as file:  # of another part
    file.write(open("back.csv", encoding="utf-8").read().replace(",0,1,", ",0,7,"))
os.makedirs("empty")
for name, words in (("other.csv", "its objects are 7"), ("empty", "folders such as obj_000001")):
    done = script("evaluate.py", "bop", "plates", "--found", name)
    check(done.returncode == 1 and done.stderr == f"evaluate.py: {name} has no poses of object 1: {words if name == 'other.csv' else 'it needs ' + words}\n",
          done.stderr)
# True poses of another bin: said of each image, and nothing counts as found; why each instance was missed.
shutil.copytree("plates", "swapped")
for name in ("scene_gt.json", "scene_gt_info.json"):
    shutil.copy(f"plates/test/000001/{name}", f"swapped/test/000000/{name}")
done = script("evaluate.py", "bop", "swapped", "--scenes", "0", "--found", "back.csv")
check(done.returncode == 1 and "scene 0, image 0, object 1: the true poses fit" in done.stderr and "another part or another scene" in done.stderr,
      done.stderr)
check(done.stdout.splitlines()[1].split()[4] == "0.0", done.stdout)
REPORT = ("--report", "found.html") if HAS_THREE else ()
done = script("evaluate.py", "bop", "plates", "--scenes", "0", "--poses", "0", "--why", "why.csv", *REPORT)
check(done.returncode == 0, done.stderr)
rows = rows_of("why.csv")
check(len(rows) == COPIES and all((row["found by"] == "") == (row["why"] != "") and row["visible"] for row in rows), f"{rows}")
def of_page(path):
    """The texts, the cells of each row, and of each image what it shows."""
    text = read(path)
    cells = [re.findall("<td>(.*?)</td>", row) for row in re.findall("<tr[^>]*>(.*?)</tr>", text[:text.index("<iframe")])[1:]]
    return text, cells, {place: json.loads(data) for place, data in re.findall('id="(image\\d+)">(.*?)</script>', text)}


def counts_of(cells, data):
    """The row of an image, found, missed and wrong, has the poses that its page shows."""
    poses = data["poses"]
    kinds = [pose["judged"] for pose in poses if pose["judged"] != "wrong" or pose.get("place", 1) >= 0.5]
    right, missed, wrong = map(kinds.count, ("right", "missed", "wrong"))
    check(int(cells[1]) == int(cells[2]) + missed and int(cells[2]) <= right and cells[3:5] == [str(missed), str(wrong)], f"{cells} {kinds}")
    check([pose["rank"] for pose in poses] == list(range(1, len(poses) + 1)), "each pose has a number of its own")
    return right, missed, wrong


# The page: the figures as they are printed, and of each image the poses that are right or wrong and the copies that were missed.
if HAS_THREE:
    text, cells, images = of_page("found.html")
    check(html.escape(done.stdout.rstrip()) in text and "@PICTURE@" in text and list(images) == ["image0"], "the figures and the page of an image")
    right, missed, wrong = counts_of(cells[0], images["image0"]["DATA"])
    check(right == sum(row["found by"] != "" for row in rows) > 0, f"{right} are right: {rows}")
    done = script("evaluate.py", "bop", "swapped", "--scenes", "0", "--found", "back.csv", "--report", "swapped.html")
    _, cells, images = of_page("swapped.html")
    check(done.returncode == 1 and cells[0][5] == "object 1 failed" and counts_of(cells[0], images["image0"]["DATA"])[0] == 0, f"{cells}")
    # One pose is left out, one is moved, one is there twice.
    x, y, z = found[1]["t"].split()
    changed = [{**found[0], "score": 1}, {**found[0], "score": 0.9}, {**found[1], "score": 0.5, "t": f"{float(x) + 40} {y} {z}"}]
    with open("changed.csv", "w", newline="", encoding="utf-8") as table:
        rows = csv.DictWriter(table, list(found[0]))
        rows.writeheader()
        rows.writerows(changed)
    done = script("evaluate.py", "bop", "plates", "--found", "changed.csv", "--report", "changed.html")
    text, cells, images = of_page("changed.html")
    check(counts_of(cells[0], images["image0"]["DATA"]) == (1, int(cells[0][1]) - 1, 2), f"{cells}")
    poses = images["image0"]["DATA"]["poses"]
    reasons = [pose["why"] for pose in poses]
    check(reasons[0].startswith("Right: ") and reasons[1] == "A better pose has the same copy." and reasons[2].startswith("No copy is here: the nearest is "),
          f"{reasons}")
    check(poses[-1]["tag"] == "missed" and "The nearest pose, rank " in poses[-1]["why"] and len(poses[-1]["outline"]) > 0, f"{poses[-1]}")
    poses = images["image1"]["DATA"]["poses"]
    check(counts_of(cells[1], images["image1"]["DATA"])[0] == 0 and poses[0]["why"] == "No pose came out.", f"{cells[1]}")
    # Where the page would be too large the images with the most errors stay.
    judged.MOST_BYTES = 1.5 * len(json.dumps(images["image0"]))
    data = dataset.Dataset("plates")
    options = mock.Mock(folder="plates", spec=["folder"])
    shown, run_ = judged.Images({1: data.mesh(1)}, 2), evaluation.Evaluation(data.train(1, "recommended"))
    stored = dataset.Found("changed.csv", [1])
    for scene in (0, 1):
        image = data.scene(scene).image(0)
        truth, poses = image.truth_of(1), stored.poses(image, 1)
        shown.add(str(scene), image, None, {1: (poses, truth, run_.judged_image(poses, truth), {})}, [], options)
    shown.add_failed("2", "cannot read it")
    write("few.html", shown.html("plates", "figures"))
    text, cells, images = of_page("few.html")
    worst = max((0, 1), key=lambda place: int(cells[place][3]) + int(cells[place][4]))
    check(list(images) == [f"image{worst}"] and "the scans of 1 images with" in text and len(cells) == 3 and cells[2][5] == "cannot read it", f"{cells}")

# A diagnosis that fails is told of, once; what is found still counts.
class Undiagnosed:
    def add(self, *_, **__):
        raise scripting.Failure("no diagnosis")


data = dataset.Dataset("plates")
model, mesh = data.train(1, "recommended"), data.mesh(1)
whole = data.scene(0).image(0)
poses = {1: dataset.Found("back.csv", [1]).poses(whole, 1)}
figures = []
for lost in (None, Undiagnosed()):
    run_, benchmark, failed, errors = evaluation.Evaluation(model, mesh=mesh), dataset.BOPFigures(mesh, model), set(), io.StringIO()
    with contextlib.redirect_stderr(errors):
        evaluate.judge(whole, poses, {1: run_}, {1: benchmark}, None, lost, failed)
    told = "scene 0, image 0, object 1"
    check(failed == ({told} if lost else set()) and errors.getvalue() == (f"{told}: no diagnosis\n" if lost else ""), errors.getvalue())
    figures.append((run_.figures()["recall"], benchmark.recalls()))
check(figures[0] == figures[1] and figures[0][0] > 0, f"{figures}")
# An object that fails twice is one that failed.
failed = set()
with contextlib.redirect_stderr(io.StringIO()) as errors:
    for _ in range(2):
        with evaluate.told("here", failed):
            raise scripting.Failure("no")
check(len(failed) == 1 and errors.getvalue() == "here: no\n" * 2, errors.getvalue())
done = script("evaluate.py", "bop", "plates", "--found", "nowhere")
check(done.returncode == 1 and done.stderr == "evaluate.py: cannot read nowhere: No such file or directory\n", done.stderr)
