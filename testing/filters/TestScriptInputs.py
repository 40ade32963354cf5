# SPDX-License-Identifier: BSD-3-Clause
"""detect.py and evaluate.py on what sensors and datasets give: depth images, PLY clouds, images of any kind, BOP."""
import json
import os

import numpy
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkIOImage import vtkBMPWriter, vtkPNGWriter, vtkTIFFWriter
from vtkmodules.vtkIOPLY import vtkPLYWriter

import ppfmeam
from ppfmeam import scripting
from ppfmeam.filters import vtkMEAMPoseEstimation
from meamtest import check, connect, picture, pose_error, read, rows_of, run, tuples, write, written
from scripttest import H, W, scan_of_bin, script, works, write_pcd

def refuses(word, name, *arguments, status=1):
    result = script(name, *arguments)
    check(result.returncode == status and word in result.stderr, f"expected '{word}': {result.returncode}, {result.stderr}")


def write_json(path, content):
    os.makedirs(os.path.dirname(os.path.abspath(path)), exist_ok=True)
    write(path, json.dumps(content))


def write_image(path, pixels, writer=vtkPNGWriter):
    """H x W values from the top left."""
    os.makedirs(os.path.dirname(os.path.abspath(path)), exist_ok=True)
    written(path, picture(pixels, pixels.dtype), writer)


def write_ply(path, points, grey):
    """Binary, metres, grey values as intensities."""
    with open(path, "wb") as file:
        file.write(f"ply\nformat binary_little_endian 1.0\nelement vertex {len(points)}\nproperty float x\n"
                   "property float y\nproperty float z\nproperty float intensity\nend_header\n".encode())
        file.write(numpy.column_stack((points / 1000, grey)).astype("<f4").tobytes())


def matrices(path):
    return [tuple(row) for row in numpy.array(read(path).split(), float).reshape(-1, 16)]


def all_true(found, what, count=2, distance=1, angle=2):
    """Every pose is a true one."""
    check(len(found) == count, f"{what}: {len(found)} poses")
    for pose in found:
        errors = [pose_error(pose, t) for t in true]
        check(any(d < distance and a < angle for d, a in errors), f"{what}: {pose} is not a true pose, {min(errors)}")


SCALE = 0.05
scan, truth, mesh = scan_of_bin()
true = tuples(truth, "Transform")
points = vtk_to_numpy(scan.GetPoints().GetData())
grey = vtk_to_numpy(scan.GetPointData().GetArray("Intensity"))
valid = numpy.isfinite(points).all(axis=1)
fx, _, cx, _, fy, cy, *_ = scan.GetFieldData().GetArray("CameraMatrix").GetTuple(0)
depth = numpy.rint(numpy.nan_to_num(points[:, 2]) / SCALE).astype(numpy.uint16).reshape(H, W)
written("part.ply", mesh, vtkPLYWriter)
write_image("depth.png", depth)
write_image("image.png", grey.reshape(H, W))
write_json("camera.json", {"fx": fx, "fy": fy, "cx": cx, "cy": cy, "width": W, "height": H, "depth_scale": SCALE})

# detect.py with a depth image; the scale from the calibration or from the user, the image in any form.
CAD = ("--cad", "part.ply", "--poses", "2")
works("train.py", "--cad", "part.ply", "--out", "part.vtpc")
MODEL = ("--model", "part.vtpc", "--poses", "2")
works("detect.py", *CAD, "--depth", "depth.png", "--camera", "camera.json", "--image", "image.png", "--matrices", "a.txt")
all_true(matrices("a.txt"), "a depth image")
with open("camera.yaml", "w", encoding="utf-8") as file:
    file.write(f"%YAML:1.0\n---\nimage_width: {W}\nimage_height: {H}\ncamera_matrix: !!opencv-matrix\n   rows: 3\n   cols: 3\n"
               f"   dt: d\n   data: [ {fx}, 0., {cx}, 0., {fy}, {cy}, 0., 0., 1. ]\n")
for name, writer in (("image.tif", vtkTIFFWriter), ("image.bmp", vtkBMPWriter)):
    write_image(name, grey.reshape(H, W), writer)
    works("detect.py", *MODEL, "--depth", "depth.png", "--camera", "camera.yaml", "--depth-scale", str(SCALE),
          "--image", name, "--matrices", "b.txt")
    check(matrices("b.txt") == matrices("a.txt"), f"with {name} and OpenCV's calibration the poses differ")

# The same as PGM, and in metres as PFM, whose rows stand from the bottom.
with open("depth.pgm", "wb") as file:
    file.write(b"P5\n%d %d\n65535\n" % (W, H) + depth.astype(">u2").tobytes())
with open("metres.pfm", "wb") as file:
    file.write(b"Pf\n%d %d\n-1.0\n" % (W, H) + (depth[::-1] * SCALE / 1000).astype("<f4").tobytes())
works("detect.py", *MODEL, "--depth", "depth.pgm", "--camera", "camera.json", "--image", "image.png", "--matrices", "b.txt")
check(matrices("b.txt") == matrices("a.txt"), "with a PGM the poses differ")
works("detect.py", *MODEL, "--depth", "metres.pfm", "--camera", "camera.yaml", "--depth-scale", "1000", "--image", "image.png",
      "--matrices", "b.txt")
check(numpy.allclose(matrices("b.txt"), matrices("a.txt"), atol=1e-3), "with a PFM in metres the poses differ")
refuses("1000", "detect.py", *MODEL, "--depth", "metres.pfm", "--camera", "camera.yaml")
with open("depth.exr", "wb") as file:
    file.write(b"\x76\x2f\x31\x01")
refuses("OpenEXR image, which is not read", "detect.py", *MODEL, "--depth", "depth.exr", "--camera", "camera.json")

# A PLY cloud, in any order, comes back onto the grid of its camera.
order = numpy.random.default_rng(1).permutation(numpy.flatnonzero(valid))
write_ply("scan.ply", points[order], grey[order])
works("detect.py", *MODEL, "--scene", "scan.ply", "--scene-scale", "1000", "--camera", "camera.json", "--matrices", "c.txt")
all_true(matrices("c.txt"), "a PLY cloud")
told = works("detect.py", *MODEL, "--scene", "scan.ply", "--scene-scale", "1000", "--matrices", "c.txt")
check("lie on the grid of a pinhole camera" in told, told)
all_true(matrices("c.txt"), "a PLY cloud without its camera")
refuses("1000", "detect.py", *MODEL, "--scene", "scan.ply", "--camera", "camera.json")
refuses("only a cloud (.pcd, .ply, ", "detect.py", *MODEL, "--scene", "part.stl", "--camera", "camera.json")
refuses("--camera", "detect.py", *MODEL, "--depth", "depth.png", status=2)
for option, name, other in (("--out", "poses.json", "--json"), ("--json", "poses.csv", "--out"), ("--matrices", "found.html", "--report")):
    refuses(f"give {other} {name}", "detect.py", *MODEL, "--scene", "scan.ply", option, name, status=2)
refuses("scan.ply holds points alone: the part has to be a mesh", "detect.py", "--cad", "scan.ply", "--scene", "scan.ply")
refuses("is what is read: give another name", "detect.py", *MODEL, "--scene", "scan.ply", "--json", "scan.ply", status=2)
refuses("give one scan", "detect.py", *MODEL, "--depth", "depth.png", "--scene", "scan.ply", status=2)
refuses("a number from 0 to 1, not 2", "detect.py", *MODEL, "--scene", "scan.ply", "--references", "2", status=2)
refuses("a whole number, 0 or more, not few", "detect.py", *MODEL, "--scene", "scan.ply", "--poses", "few", status=2)
refuses("8 bits", "detect.py", *MODEL, "--depth", "image.png", "--camera", "camera.json")
refuses("--image-camera", "detect.py", *MODEL, "--scene", "scan.ply", "--image-camera", "camera.json", status=2)
refuses("--depth-scale", "detect.py", *MODEL, "--scene", "scan.ply", "--depth-scale", "0.1", status=2)
works("detect.py", *MODEL, "--depth", "depth.png", "--camera", "camera.yaml", "--scene-scale", str(SCALE), "--image", "image.png",
      "--matrices", "c.txt")
check(numpy.allclose(matrices("c.txt"), matrices("a.txt"), atol=1e-3), "the scale of a depth image")
check("no image" in works("detect.py", *MODEL, "--depth", "depth.png", "--camera", "camera.json"), "the scan says that it has no image")

# Points alone in a robot's frame, in metres, with their viewpoint: all doors find the same, with and without it not the same.
TURN = numpy.eye(4)
TURN[:3, :3] = numpy.array([[0, 0.6, 0.8], [1, 0, 0], [0, 0.8, -0.6]])
TURN[:3, 3] = -400, 150, 900
in_robot = points[order].astype(float) @ TURN[:3, :3].T + TURN[:3, 3]
write_ply("robot.ply", in_robot, grey[order])
VIEW = ("--viewpoint", *map(str, TURN[:3, 3] / 1000))
told = works("detect.py", *MODEL, "--scene", "robot.ply", "--scene-scale", "1000", *VIEW, "--matrices", "v.txt", "--report", "v.html")
check(len(matrices("v.txt")) == 2 and "the given viewpoint" in told, told)
for pose in matrices("v.txt"):
    back = (numpy.linalg.inv(TURN) @ numpy.reshape(pose, (4, 4))).ravel()
    errors = [pose_error(back, t) for t in true]
    check(any(d < 1 and a < 2 for d, a in errors), f"with a viewpoint: {min(errors)}")
told = script("detect.py", *MODEL, "--scene", "robot.ply", "--scene-scale", "1000").stdout
check("from where the fewest points hide others" in told and "the given viewpoint" not in told, told)
SEEN = {"scan": "robot.ply", "scale": 1000, "viewpoint": TURN[:3, 3] / 1000}
model = ppfmeam.load("part.vtpc")
found = ppfmeam.detect(model, **SEEN, poses=2)
in_numbers = [tuple(float(value) for value in pose.ravel()) for pose in found.poses]
check(in_numbers == matrices("v.txt"), f"Python finds {in_numbers} and the command {matrices('v.txt')}")
filter = connect(vtkMEAMPoseEstimation(), model.data, scripting.read_scan("robot.ply", 1000), MaximumNumberOfPoses=2)
filter.SetProjectionToPerspective()
filter.SetSensorPosition(TURN[:3, 3])
filter.SetViewDirection(0, 0, 0)
check(tuples(run(filter), "Transform") == matrices("v.txt"), "the filter finds other poses")

# A depth image as an array, with a calibration file or a camera matrix.
by_file = ppfmeam.detect(model, "depth.pgm", camera="camera.json", poses=2)
matrix = numpy.array([[fx, 0, cx], [0, fy, cy], [0, 0, 1]])
for array, camera, scale in ((depth, "camera.json", 1), (depth, matrix, SCALE), (depth / 1000, matrix.tolist(), 1000 * SCALE)):
    seen = ppfmeam.detect(model, array, camera=camera, scale=scale, poses=2)
    check(len(seen) == 2 and all(min(pose_error(pose.ravel(), t)[0] for t in true) < 1 for pose in seen.poses), f"{seen.poses}")
    check(array.dtype != numpy.uint16 or numpy.array_equal(seen.poses, by_file.poses), f"the file's poses: {by_file.poses}")
    seen.save("array.html")
    check(os.path.getsize("array.html") > 100000, "the page of a depth image")
    told = ppfmeam.why(model, array, camera=camera, scale=scale, pose=seen.poses[0])
    check("rank 1" in str(told), told)
for words, array, camera in (("needs its camera", depth, None), ("give array[:, :3]", numpy.zeros((50, 6)), None), ("give array.T", numpy.zeros((3, 50)), None), ("matrix of 3 x 3", depth, numpy.eye(4)), ("fx 0 cx", depth, matrix.T),
                             ("array of numbers", depth > 0, matrix), ("its camera has", depth[1:], "camera.json"),
                             ("focal lengths", depth, numpy.diag((0, 0, 1))), ("of an array of depths", "depth.png", matrix)):
    try:
        ppfmeam.detect(model, array, camera=camera)
        check(False, f"{words} was not said")
    except ppfmeam.Error as error:
        check(words in str(error), error)

os.makedirs("clouds")
os.rename("robot.ply", "clouds/0.ply")
works("batch.py", "clouds", *MODEL, "--scene-scale", "1000", *VIEW, "--out", "clouds.csv", "--report", "clouds_pages")
rows = rows_of("clouds.csv")
check([tuple(map(float, row["t"].split())) for row in rows] == [(p[3], p[7], p[11]) for p in matrices("v.txt")], f"batch finds {rows}")
told = works("why.py", "part.vtpc", "clouds/0.ply", "--scale", "1000", *VIEW, "--truth", "v.txt")
check(told.count("Found as rank") == 2, told)
why = ppfmeam.why(model, "clouds/0.ply", scale=1000, viewpoint=SEEN["viewpoint"], pose=found.poses[0])
check(why.rank == 1, why.verdict)
for text in (read("v.html"), read("clouds_pages/0.ply.html")):
    check("--viewpoint -0.4 0.15 0.9" in text, "the command of the page has no viewpoint")
refuses("--camera tells", "detect.py", *MODEL, "--scene", "scan.ply", "--camera", "camera.json", *VIEW, status=2)
refuses("--camera tells", "why.py", "part.vtpc", "scan.ply", "--camera", "camera.json", *VIEW, "--at", "0", "0", "600", status=2)

# Without an image by the edges of the depth alone; a folder of such scans, too.
works("detect.py", *MODEL, "--depth", "depth.png", "--camera", "camera.json", "--no-image", "--matrices", "d.txt")
all_true(matrices("d.txt"), "a depth image without an image")
for calibration in (("camera.json",), ("camera.yaml", "--depth-scale", str(SCALE))):
    told = works("why.py", "part.vtpc", "depth.png", "--camera", *calibration, "--truth", "d.txt", "--no-image")
    check(told.count("Found as rank") == 2, told)
# Edge points may come as a grid, too.
heights = numpy.nan_to_num(points[:, 2]).reshape(H, W)
jumps = valid & (abs(numpy.diff(heights, axis=1, prepend=0)) > 3).ravel()
write_pcd("grid.pcd", numpy.where(jumps[:, None], points, numpy.nan), W, H, "x y z")
write_pcd("edges.pcd", points[jumps], jumps.sum(), 1, "x y z")
for name in ("grid", "edges"):
    works("detect.py", *MODEL, "--depth", "depth.png", "--camera", "camera.json", "--boundary", f"{name}.pcd", "--matrices", f"{name}.txt")
check(numpy.allclose(matrices("grid.txt"), matrices("edges.txt"), atol=1e-3), "a grid of edge points")

# What is given is taken, or refused.
AT = ("--at", "0", "0", "600")
for wrong in ("0", "-0.1", "nan", "inf"):
    words = f"it has to be a number above 0, not {wrong}"
    refuses(words, "detect.py", *MODEL, "--depth", "depth.png", "--camera", "camera.json", "--depth-scale", wrong, status=2)
    refuses(words, "detect.py", *MODEL, "--scene", "scan.ply", "--scene-scale", wrong, status=2)
    refuses(words, "why.py", "part.vtpc", "scan.ply", "--scale", wrong, *AT, status=2)
refuses("it has to be a number, not nan", "detect.py", *MODEL, "--scene", "scan.ply", "--viewpoint", "0", "0", "nan", status=2)
for option in (("--solid", "3"), ("--cad-scale", "1000"), ("--cad-offset", "1", "2", "3")):
    refuses(f"{option[0]} is of a CAD file", "detect.py", *MODEL, "--scene", "scan.ply", *option, status=2)
refuses("--cad-scale is of a CAD file", "why.py", "part.vtpc", "scan.ply", "--cad-scale", "1000", *AT, status=2)
refuses("--cad-scale is of a CAD file", "batch.py", "clouds", *MODEL, "--cad-scale", "1000", "--out", "none.csv", status=2)
refuses("--depth-scale is of depth images", "batch.py", "clouds", *MODEL, "--depth-scale", "2", "--out", "none.csv", status=2)
for name, scene in (("detect.py", (*MODEL, "--scene", "scan.ply")), ("why.py", ("part.vtpc", "scan.ply", *AT))):
    refuses("--no-image leaves the image out", name, *scene, "--image", "image.png", "--no-image", status=2)
refuses("--depth-scale is of a depth image", "why.py", "part.vtpc", "scan.ply", "--depth-scale", "0.1", "--at", "0", "0", "600", status=2)
os.makedirs("depths")
os.rename("depth.png", "depths/0.png")
os.rename("depth.pgm", "depths/1.pgm")
BATCH = ("batch.py", "depths", *MODEL, "--camera", "camera.json", "--out", "depths.csv")
works(*BATCH, "--no-image")
rows = rows_of("depths.csv")
check([row["scan"] for row in rows] == ["0.png"] * 2 + ["1.pgm"] * 2 and not any(row["failure"] for row in rows), f"{rows}")
for scan in ("0.png", "1.pgm"):
    all_true([(*r[0:3], t[0], *r[3:6], t[1], *r[6:9], t[2], 0, 0, 0, 1)
              for r, t in (([float(x) for x in row["R"].split()], [float(x) for x in row["t"].split()])
                           for row in rows if row["scan"] == scan)], "a folder of depth images")
os.remove("depths.csv")
works(*BATCH)
check(not any(row["failure"] for row in rows_of("depths.csv")), "depth images without an image")

# evaluate.py on a dataset: object 3 is in the first image alone, object 8 in none; the second scene has no truth.
SCENE = {"cam_K": [fx, 0, cx, 0, fy, cy, 0, 0, 1], "depth_scale": SCALE}
R = [[*t[0:3], *t[4:7], *t[8:11]] for t in true]
for scene in (2, 5):
    write_image(f"set/test/{scene:06d}/depth/000007.png", depth)
    write_image(f"set/test/{scene:06d}/gray/000007.png", grey.reshape(H, W))
    write_json(f"set/test/{scene:06d}/scene_camera.json", {"7": SCENE})
write_json("set/test/000002/scene_gt.json", {
    "7": [{"obj_id": 3, "cam_R_m2c": r, "cam_t_m2c": [t[3], t[7], t[11]]} for r, t in zip(R, true)]})
write_json("set/test/000002/scene_gt_info.json", {
    "7": [{"visib_fract": f} for f, in tuples(truth, "VisibleFraction")]})
os.makedirs("set/models")
for number in (3, 8):
    os.link("part.ply", f"set/models/obj_{number:06d}.ply")
write_json("set/models/models_info.json", {"3": {"diameter": 1}})
text = works("evaluate.py", "bop", "set", "--objects", "3", "--poses", "2", "--out", "results.csv", "--json", "rates.json")
# Why, in an image of the dataset: of the object's true poses, of a pose of the results, as evaluate.py reads them.
told = works("why.py", "3", "set/test/000002/000007", "--truth", "--poses", "0").splitlines()
works("evaluate.py", "bop", "set", "--objects", "3", "--poses", "0", "--why", "lost.csv")
count = sum(row["found by"] != "" for row in rows_of("lost.csv"))
check(len(told) == len(true) + 1 and told[-1] == f"{count} of {len(true)} were found" and count > 1, f"{told} and {count}")
told = works("why.py", "set/models/obj_000003.ply", "set/test/000002/000007", "--pose", "results.csv", "--report", "image.html")
check(told.startswith("Found as rank 1"), told)
check("<title>obj_000003 in 000007</title>" in read("image.html"), "the page of an image")
told = works("why.py", "set/test/000002/000007", "--cad", "3", "--cad", "8", "--pose", "results.csv", "--report", "image.html")
check(told.startswith("object 3: Found as rank 1"), f"of objects that are alike the first: {told}")
check("<title>object 3 and object 8 in 000007</title>" in read("image.html"), "the page of two objects")
works("why.py", "3", "set/test/000002/000007", "--pose", "results.csv", "--report", "image.html")
check("<title>object 3 in 000007</title>" in read("image.html"), "the page of an object")
refuses("has no image 8: its images are 7", "why.py", "3", "set/test/000002/000008", "--truth")
refuses("--truth needs a file", "why.py", "3", "set/test/000005/000007", "--truth")
refuses("--truth needs a file", "why.py", "part.ply", "scan.ply", "--truth")
refuses("leave --camera", "why.py", "3", "set/test/000002/000007", "--camera", "camera.json", "--truth")
works("batch.py", "set", "--objects", "3", "--out", "set.csv", "--report", "set_pages")
check("ppfmeam why 3 set/test/000002/000007 --at" in read("set_pages/000002_000007.html"), "the command of a page of a dataset")
rates = json.loads(read("rates.json"))
check(rates["failed"] == 0 and [row["part"] for row in rates["objects"]] == [3] and 0 <= rates["objects"][0]["strict"] <= 100, f"{rates}")
table = [line.split() for line in text.splitlines()]
check(table[0][0] == "obj." and table[1][:3] == ["3", "1", "2"], f"an object in one image: {text}")
check(float(table[1][4]) == 100 and float(table[1][5]) == 100, f"strict and top1: {text}")
check(read("results.csv").startswith("scene_id,im_id,obj_id,score,R,t,time\n"), "the header of the benchmark")
rows = rows_of("results.csv")
check([(row["scene_id"], row["im_id"], row["obj_id"]) for row in rows] == [("2", "7", "3")] * 2 + [("5", "7", "3")] * 2,
      "two poses of each image")
for row in rows:
    r, t = [float(v) for v in row["R"].split()], [float(v) for v in row["t"].split()]
    all_true([(*r[0:3], t[0], *r[3:6], t[1], *r[6:9], t[2], 0, 0, 0, 1)], "a result", 1)
    check(0 < float(row["time"]) < 60 and 0 < float(row["score"]) <= 1, f"time and score: {row}")
check(len({row["time"] for row in rows[:2]}) == 1, "the time is that of the image")
text = works("evaluate.py", "bop", "set", "--scenes", "5", "--poses", "1", "--out", "other.csv")
check([row["obj_id"] for row in rows_of("other.csv")] == ["3", "8"], "all objects, no figures without truth")
check(text == "", f"no table without truth: {text}")

refuses("no folder val", "evaluate.py", "bop", "set", "--split", "val", "--out", "o.csv")
refuses("obj_000004.ply", "evaluate.py", "bop", "set", "--objects", "4", "--out", "o.csv")
refuses("cannot write", "evaluate.py", "bop", "set", "--out", "no/such/folder.csv")
refuses("no scene", "evaluate.py", "bop", "set", "--objects", "3", "--scenes", "9", "--out", "o.csv")
os.remove("set/test/000002/depth/000007.png")
refuses("failed", "evaluate.py", "bop", "set", "--objects", "3", "--out", "o.csv")
