# SPDX-License-Identifier: BSD-3-Clause
"""ppfmeam's functions: files and NumPy arrays in, rows and NumPy arrays out, the same as of the filters; exceptions and nothing
on the console; threads and signals of Python while they work; the files of a trained model hold the same."""
import json
import math
import os
import shutil
import signal
import sys
import tempfile
import threading
import time
import warnings

import numpy
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkIOGeometry import vtkSTLWriter

import ppfmeam
from ppfmeam import _core, filters, inputs, scripting
from meamtest import Folder, box, check, connect, fails, field, partitions, plate, read, run, text, tuples, write, written

WIDTH, HEIGHT, COPIES = 480, 360, 3
FIELDS = ("Diameter", "Feature", "DistanceStep", "AngleStep", "ViewMerging", "VoxelSize", "LeafSize",
          "CoVisibilityDirections", "ViewDirections", "NumberOfPairs", "FormatVersion", "SymmetriesDiscrete",
          "SymmetriesContinuous", "NearSymmetries", "NearSymmetryOverlap", "NearSymmetryDeviation")


class Quiet:
    """Fails when anything is printed on the console, also by C++."""

    def __enter__(self):
        sys.stdout.flush()
        sys.stderr.flush()
        self.file = tempfile.TemporaryFile()
        self.before = [os.dup(descriptor) for descriptor in (1, 2)]
        for descriptor in (1, 2):
            os.dup2(self.file.fileno(), descriptor)

    def __exit__(self, *error):
        sys.stdout.flush()
        sys.stderr.flush()
        for descriptor, before in zip((1, 2), self.before):
            os.dup2(before, descriptor)
            os.close(before)
        self.file.seek(0)
        shown = self.file.read()
        check(not shown, f"the console shows {shown}")


def raises(words, function, *arguments, **options):
    """The call must raise ppfmeam.Error with these words."""
    try:
        with Quiet():
            function(*arguments, **options)
    except ppfmeam.Error as error:
        check(words.lower() in str(error).lower(), f"the error does not say '{words}': {error}")
    else:
        check(False, f"no error: {words}")


def same_model(a, b):
    """All that a trained model holds, bit by bit."""
    check([name for name, _ in partitions(a)] == [name for name, _ in partitions(b)], "other partitions")
    for (name, one), (_, other) in zip(partitions(a), partitions(b)):
        check(one.GetNumberOfPoints() == other.GetNumberOfPoints(), f"{name} has another length")
        if one.IsA("vtkPolyData"):
            check((vtk_to_numpy(one.GetPoints().GetData()) == vtk_to_numpy(other.GetPoints().GetData())).all(), name)
        data = one.GetPointData()
        check(data.GetNumberOfArrays() == other.GetPointData().GetNumberOfArrays(), f"{name} has other arrays")
        for i in range(data.GetNumberOfArrays()):
            array, twin = data.GetArray(i), other.GetPointData().GetArray(data.GetArrayName(i))
            check((vtk_to_numpy(array) == vtk_to_numpy(twin)).all(), f"{name}: {data.GetArrayName(i)} differs")
    for name in FIELDS:
        check(field(a, name) == field(b, name), f"{name} differs")
    digests = [text(model, "Digest") for model in (a, b)]
    check(digests[0] == digests[1] != "", f"the digests are {digests}")


def same(a, b):
    check(len(a) == len(b) > 0 and (a.poses == b.poses).all() and (a.probabilities == b.probabilities).all(),
          "the poses differ")


def in_threads(count, work):
    threads = [threading.Thread(target=work) for _ in range(count)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()


def check_threads(call):
    """Python goes on while the library works: two calls overlap, and signals are handled meanwhile."""
    running, most, interval = [], [], sys.getswitchinterval()

    def work():
        running.append(None)
        most.append(len(running))
        call()
        running.pop()

    sys.setswitchinterval(1000)  # only where the lock is given away another thread goes on
    try:
        in_threads(2, work)
    finally:
        sys.setswitchinterval(interval)
    check(max(most) == 2, "two calls do not overlap")

    handled, done = [], threading.Event()

    def send():
        while not done.wait(0.1):
            os.kill(os.getpid(), signal.SIGINT)

    def count(*_):
        handled.append(time.monotonic())
        if len(handled) == 3:
            raise KeyboardInterrupt

    before, sender = signal.signal(signal.SIGINT, count), threading.Thread(target=send)
    sender.start()
    spans, begun = [], 0.0
    try:
        while True:
            begun = time.monotonic()
            call()
            spans.append((begun, time.monotonic()))
    except KeyboardInterrupt:
        within = any(start < at < end - 0.005 for at in handled for start, end in spans)
        check(within or sum(at > begun for at in handled) > 1, "signals wait until the call ends")
    finally:
        done.set()
        sender.join()
        signal.signal(signal.SIGINT, before)


part = plate()
source = connect(filters.vtkMEAMBinSceneSource(), part, Copies=COPIES, Width=WIDTH, Height=HEIGHT)
scan = run(source)
truth = [numpy.array(row).reshape(4, 4) for row in tuples(source.GetOutputDataObject(1), "Transform")]
points = vtk_to_numpy(scan.GetPoints().GetData()).reshape(HEIGHT, WIDTH, 3)
grey = vtk_to_numpy(scan.GetPointData().GetArray("Intensity")).reshape(HEIGHT, WIDTH)

folder = Folder()
os.chdir(folder.name)
written("part.stl", part, vtkSTLWriter)

with Quiet():
    model = ppfmeam.train("part.stl")
    found = ppfmeam.detect(model, points, grey)
check(abs(model.diameter - 84.5) < 1, f"the diameter is {model.diameter}")
check(found.poses.shape == (len(found), 4, 4) and found.poses.dtype == numpy.float64, f"{found.poses.shape}")
for column in (found.scores, found.place_probabilities, found.probabilities, found.certainties, found.visible_fractions):
    check(column.shape == (len(found),) and (column >= 0).all() and (column <= 1).all(), f"{column}")
check(found.seconds > 0, "no time")
check(0.1 < found.scan_quality["PointDistance"] < 2 and 0 < found.scan_quality["Noise"] < 1, f"{found.scan_quality}")
nearest = min(numpy.linalg.norm(found.poses[0, :3, 3] - T[:3, 3]) for T in truth)
print(f"the best of {len(found)} poses is {nearest:.2f} mm from a true one, probability {found.probabilities[0]:.2f}")
check(nearest < 1 and found.probabilities[0] > 0.5, "the best pose is wrong")

# Rows and a table.
pose = found[0]
check((pose.transform == found.poses[0]).all() and pose.probability == found.probabilities[0], "the first row")
check([row.score for row in found] == list(found.scores) and found[-1].score == found.scores[-1], "rows in their order")
check(len(str(found).splitlines()) == 1 + len(found) and f"{100 * pose.place_probability:.0f} %" in str(found), str(found))
check(abs(pose.probability - pose.place_probability * pose.certainty) < 1e-12, "the rotation stands beside the place")
shares = [share for _, share in pose.alternatives]
check(shares == sorted(shares, reverse=True) and sum(shares) + pose.certainty < 1 + 1e-9, f"other rotations {shares}")
check(not any(numpy.allclose(turned, pose.transform) for turned, _ in pose.alternatives), "they are others")
check(pose.covariance.shape == (6, 6) and (numpy.linalg.eigvalsh(pose.covariance) > 0).all(), "the covariance")
try:
    found[len(found)]
    check(False, "an index that is out of range")
except IndexError:
    pass
check({"detect", "train", "load", "why", "grasps", "pick", "Error", "filters"} <= set(dir(ppfmeam)), f"{dir(ppfmeam)}")
check(all(getattr(ppfmeam, name) is not None for name in dir(ppfmeam)), "a name that is not there")

# The same bits as of the filters.
same_model(model.data, scripting.train(scripting.read_mesh("part.stl")))
estimation = connect(filters.vtkMEAMPoseEstimation(), model.data, scan)
poses = run(estimation)
for name, column in (("Transform", found.poses.reshape(-1, 16)), ("Score", found.scores),
                     ("PlaceProbability", found.place_probabilities), ("Probability", found.probabilities),
                     ("Certainty", found.certainties), ("VisibleFraction", found.visible_fractions)):
    check((vtk_to_numpy(poses.GetPointData().GetArray(name)) == column).all(), f"{name} is another one than of the filter")
for name in ("Quaternion", "Votes", "ViewId", "Residual", "Covariance"):
    check((vtk_to_numpy(poses.GetPointData().GetArray(name)) == vtk_to_numpy(found.data.GetPointData().GetArray(name))).all(), name)
for name in ("PartBounds", "PartMiddle", "Diameter"):
    check(field(poses, name) == field(found.data, name), name)

# Several threads, and signals.
settings = _core.DetectSettings()
settings.threads, settings.referenceShare = 1, 1.0
seen = inputs.scan_of(scan)
check_threads(lambda: _core.detect([model.core], seen, settings))
mesh = _core.load_cad("part.stl")
corners, triangles = mesh.vertices.astype(float), mesh.triangles


class Faces:
    """As trimesh has it; Open3D has `triangles`."""
    vertices, faces = corners.tolist(), triangles.tolist()


for each in ((corners, triangles), Faces()):
    same_model(ppfmeam.train(each).data, model.data)
check(len(ppfmeam.detect((corners, triangles), scan, poses=1)) == 1, "the arrays of one part are no two parts")
rows = numpy.ones((HEIGHT, WIDTH), bool)
check(len(ppfmeam.detect(model, scan, poses=1, region=rows)) == 1, "a mask of all")
raises(f"the mask of the region has {HEIGHT} x {WIDTH} pixels, and the scan {WIDTH} x {HEIGHT} points", ppfmeam.detect, model, scan, region=rows.T)
raises("or a mask, not an array with the shape (7,)", ppfmeam.detect, model, scan, region=numpy.ones(7))
raises("or a mask, not 7 values", ppfmeam.detect, model, scan, region=[1] * 7)
raises("vertices have to be finite numbers N x 3, not float64 (3, 2)", ppfmeam.train, (corners[:3, :2], triangles))
raises("triangles have to be whole numbers M x 3, not float64", ppfmeam.train, (corners, corners))
raises("triangles have to be of its 4 vertices", ppfmeam.train, (corners[:4], triangles))
raises("the part has no triangles", ppfmeam.train, (corners, triangles[:0]))
raises("or two arrays, vertices and triangles, not tuple", ppfmeam.train, (corners.tolist(), triangles.tolist()))
raises("solid is chosen from a STEP or IGES file", ppfmeam.train, (corners, triangles), solid=1)
check_threads(lambda: _core.train(mesh, _core.TrainSettings()))

# The model comes back from both kinds of file as it was.
for name in ("model.meam", "model.vtpc"):
    model.save(name)
    same_model(ppfmeam.load(name).data, model.data)
for mine, other in (("model.meam", scan), ("model.vtpc", scan), (ppfmeam.load("model.meam"), points)):
    same(ppfmeam.detect(mine, other, grey if other is points else None), found)
ppfmeam.train(box(60, 40, 20), preset="paper").save("paper.meam")
ppfmeam.load("paper.meam").save("paper.vtpc")
same_model(ppfmeam.load("paper.vtpc").data, ppfmeam.load("paper.meam").data)
reader = filters.vtkMEAMModelReader()
check(reader.CanReadFile("model.meam") == 1 and reader.CanReadFile("part.stl") == 0, "CanReadFile")

# Other ways to give the same.
same(ppfmeam.detect(model, points.astype(numpy.float64) / 1000, numpy.repeat(grey[..., None], 3, axis=2), scale=1000,
                    poses=1), ppfmeam.detect(model, points.astype(numpy.float64) / 1000 * 1000, grey, poses=1))
check(len(ppfmeam.detect("part.stl", scan, poses=2)) == 2, "a CAD in the model's place")
check(len(ppfmeam.detect(part, scan, poses=1, preset="paper")) == 1, "a mesh in the model's place")
placed, turned = (ppfmeam.detect(model, scan, poses=0, probability=0.9, rotation_counts=counts, threads=1)
                  for counts in (False, True))
check(len(turned) <= len(placed) <= COPIES, "likely ones only")
check((placed.place_probabilities >= 0.9).all() and (turned.probabilities >= 0.9).all(), "the rotation counts where it is to")
edges = vtk_to_numpy(run(connect(filters.vtkMEAMSceneEdgeExtraction(), scan)).GetPoints().GetData())
cloudy = ppfmeam.detect(model, points.reshape(-1, 3), boundary=edges, poses=1)
check(len(cloudy) == 1, "points that are not organized, with their edges")

# Results as files.
found.save("poses.txt")
matrices = numpy.loadtxt("poses.txt", comments="#").reshape(-1, 4, 4)
check((matrices == found.poses).all(), "the matrices in the file")

# Grasps of the part, to a file and back.
with Quiet():
    grasps = ppfmeam.grasps("part.stl", propose="both", grasps=3, symmetries=model, opening=40, cup_diameter=8)
    grasps.save("part.grasps.json")
    again = ppfmeam.grasps("part.stl", file="part.grasps.json")
check(len(grasps) == 6 and grasps.kinds == ["parallel"] * 3 + ["suction"] * 3, f"{grasps.kinds}")
check(again.names == grasps.names and numpy.allclose(again.transforms, grasps.transforms, atol=1e-12), "the same grasps")
check((grasps.widths[:3] <= 40 - 2 * 3).all() and (grasps.qualities > 0).all(), f"{grasps.widths} {grasps.qualities}")
check(grasps.free_turns[3:] == ["approach"] * 3, f"{grasps.free_turns}")
raises("no such file", ppfmeam.grasps, "part.stl", file="missing.json")
raises("opening", ppfmeam.grasps, "part.stl", opening="wide")
raises("propose", ppfmeam.grasps, "part.stl", propose="magnet")

# What the gripper can take of what was found.
with Quiet():
    picks = ppfmeam.pick(found, grasps, scan, opening=60)
    cup = ppfmeam.pick(found.poses[found.place_probabilities > 0.5], grasps, points, gripper="cup", bin="none")  # nothing lies on these
    place = numpy.diag((1.0, -1.0, -1.0, 1.0))
    place[:3, 3] = picks.bin.transform[:3, 3]
    deep = ppfmeam.pick(found, grasps, bin=(place, 200, 200, 50, 4))
check(len(picks) == len(found) * len(grasps) and picks.transforms.shape == (len(picks), 4, 4), f"{len(picks)} picks")
check((picks.possible == [reason == "" for reason in picks.reasons]).all() and picks.report.endswith("."), picks.report)
check((picks.advice == "") == (set(picks.instances) == set(picks.instances[picks.possible])), f"{picks.report} {picks.advice}")
check((numpy.diff(picks.possible.astype(int)) <= 0).all(), "possible ones come first")
check((numpy.sort(picks.instances * len(grasps) + picks.grasps) == numpy.arange(len(picks))).all(), "each grasp of each pose")
for row in numpy.flatnonzero(picks.possible)[:3]:
    held = found.poses[picks.instances[row]] @ grasps.transforms[picks.grasps[row]]
    check(numpy.linalg.norm(held[:3, 3] - picks.transforms[row][:3, 3]) < 1e-6, "the gripper stands at the grasp")
check(all(("kind of gripper" in reason) == (grasps.kinds[k] == "parallel") for k, reason in zip(cup.grasps, cup.reasons)),
      f"a cup needs grasps for a cup: {cup.reasons}")
check((deep.bin.transform == place).all() and (*deep.bin.size, deep.bin.wall) == (200, 200, 50, 4), "the bin given")
check(len(str(picks).splitlines()) == 2 + len(picks) and picks.report in str(picks), str(picks))
check([row.name for row in grasps] == grasps.names and "suction" in str(grasps), str(grasps))
first = int(picks.best()[0])
vertices, triangles = picks.gripper(first)
in_gripper = (vertices - picks.transforms[first][:3, 3]) @ picks.transforms[first][:3, :3]
check(triangles.shape == (36, 3) and numpy.allclose(in_gripper.max(axis=0), (38, 30, 6), atol=1e-3), f"{in_gripper.max(axis=0)}")
check(picks.instances[picks.best()].tolist() == list(dict.fromkeys(picks.instances)), "the best pick of each pose comes first")
picks.save("picks.json")
stored = json.loads(read("picks.json"))
check(stored["report"] == picks.report and [row["scores"] for row in stored["picks"]] == picks.scores.tolist(), "all picks")
raises("picks go to .json", picks.save, "picks.csv")
raises("give pick() the Detections", cup.save, "cup.html")
check(deep.robot_transforms is None and len(deep.clearances) == len(deep), "no robot")
raises("bin", ppfmeam.pick, found, grasps, scan, bin="box")
raises("4 x 4", ppfmeam.pick, found, grasps, scan, bin=(numpy.eye(3), 1, 1, 1))
raises("bin has to be 'detected', 'none' or (T, length, width, height, wall), not 3", ppfmeam.pick, found, grasps, scan, bin=3)
raises("N x 4 x 4", ppfmeam.pick, numpy.eye(4), grasps, scan)
raises("no such file", ppfmeam.pick, found, grasps, scan, gripper="hook.stl")
raises("bin is found in the scan", ppfmeam.pick, found, grasps)
raises("tilt has to be a number from 0 to 180, not 500", ppfmeam.pick, found, grasps, scan, tilt=500)
raises("opening has to be a number, 0 or more, not -1", ppfmeam.pick, found, grasps, scan, opening=-1)

robot = numpy.array([[0, -1, 0, 500], [1, 0, 0, 20], [0, 0, 1, 900], [0, 0, 0, 1]])
of_matrix = ppfmeam.pick(found, grasps, opening=60, bin="none", robot_frame=robot.tolist())
check(numpy.allclose(of_matrix.robot_transforms, robot @ of_matrix.transforms), "a robot frame as a matrix")
for frame in (robot[:3], 2 * robot, 3, {}, robot.T, robot * [-1, 1, 1, 1]):
    raises("robot_frame has to be a file, or a matrix of 4 x 4", ppfmeam.pick, found, grasps, bin="none", robot_frame=frame)

# Of the filters the same grasps and picks.
definition = connect(filters.vtkMEAMGraspDefinition(), scripting.read_mesh("part.stl"), model.data, MaximumNumberOfGrasps=3, Opening=40,
                     CupDiameter=8)
definition.SetProposeToBoth()
given = run(definition).GetPointData()
check((vtk_to_numpy(given.GetArray("Transform")).reshape(-1, 4, 4) == grasps.transforms).all(), "other grasps")
check(scripting.texts(definition.GetOutput(), "GraspName") == grasps.names, "grasps of other names")
planning = connect(filters.vtkMEAMPickPlanning(), found.data, scripting.read_mesh("part.stl"), definition.GetOutput(), scan,
                   Opening=60, CupDiameter=8)
planned = run(planning).GetPointData()
for name, column in (("Transform", picks.transforms.reshape(-1, 16)), ("Possible", picks.possible), ("Score", picks.scores),
                     ("Clearance", picks.clearances), ("Tilt", picks.tilts), ("Covered", picks.covered), ("Reach", picks.reaches),
                     ("Width", picks.widths), ("Instance", picks.instances + 1), ("Grasp", picks.grasps + 1)):
    check((vtk_to_numpy(planned.GetArray(name)) == column).all(), f"{name} of a pick is another one than of the filter")

# What is wrong is an exception, what may be wrong a warning.
flat = points.reshape(-1, 3)
raises("no such file", ppfmeam.train, "missing.stl")
raises("unknown kind of file", ppfmeam.train, __file__)
raises("is a scan: the part has to be a mesh", ppfmeam.train, "scan.pcd")
raises("the part has to be a file, a mesh, or two arrays, vertices and triangles, not ndarray", ppfmeam.train, flat)
raises("the model has to be a file, not NoneType", ppfmeam.load, None)
raises("the part has to be a Model, a file, a mesh, or two arrays, vertices and triangles, not dict", ppfmeam.why, {}, scan, at=(0, 0, 600))
raises("the scan has to be a file, an array of points, or VTK's data object, not Model", ppfmeam.detect, "part.stl", model)
raises("scale has to be a number above 0, not '1000'", ppfmeam.detect, model, scan, scale="1000")
raises("cad_scale has to be a number above 0, not nan", ppfmeam.detect, "part.stl", scan, cad_scale=math.nan)
raises("scale has to be a number above 0, not 0", ppfmeam.grasps, "part.stl", scale=0)
raises("cad_scale is of a CAD file", ppfmeam.detect, model, scan, cad_scale=1000)
raises("solid is of a CAD file", ppfmeam.why, [model, "model.meam"], scan, solid=3, at=(0, 0, 600))
raises("three finite numbers, not 'here'", ppfmeam.why, model, scan, at="here")
raises("symmetries has to be the part's Model, not 'part.meam'", ppfmeam.grasps, "part.stl", symmetries="part.meam")
raises("the grasps have to be those of grasps(), not Model", ppfmeam.pick, found, model, scan)
raises("scale has to be a number above 0, not -1", ppfmeam.train, "part.stl", scale=-1)
raises("preset", ppfmeam.train, "part.stl", preset="best")
raises("no such file", ppfmeam.load, "missing.meam")
raises("no such file", ppfmeam.detect, "missing.meam", scan)
raises("no such file", ppfmeam.detect, model, "missing.pcd")
raises("calibration", ppfmeam.detect, model, "depth.png")
raises("H x W x 3", ppfmeam.detect, model, points[..., :2])
raises("H x W", ppfmeam.detect, model, points, grey / 255)
raises("give a file", ppfmeam.detect, model, points, camera="camera.json")
raises("give that, too", ppfmeam.detect, model, points, image_camera="camera.json")
raises("width and the height of the scan's grid are swapped", ppfmeam.detect, model, points.reshape(WIDTH, HEIGHT, 3))


class Picture:
    """As PIL has it."""

    def __init__(self, pixels, mode):
        self.__array_interface__, self.pixels, self.mode = pixels.__array_interface__, pixels, mode


check((inputs.scan_of(points, image=Picture(grey, "L")).image == grey).all(), "an image of PIL")
raises("PIL's mode P: give image.convert('RGB')", ppfmeam.detect, model, points, Picture(grey, "P"))
raises("the image has to be a file, an array of bytes, or a vtkImageData, not dict", ppfmeam.detect, model, points, {})
raises("the image's camera has to be a calibration file, not dict", ppfmeam.detect, model, points, grey, image_camera={})

# What NumPy masks was not measured.
hidden = numpy.arange(HEIGHT * WIDTH).reshape(HEIGHT, WIDTH) % 7 == 0
lost = numpy.repeat(hidden[..., None], 3, axis=2)
one = lost & (numpy.arange(3) == 1)
for mask in (lost, one):
    check((numpy.isnan(inputs.scan_of(numpy.ma.array(points, mask=mask)).points) == lost | numpy.isnan(points)).all(), "masked points")
check((inputs.scan_of(numpy.ma.array(points)).points[~lost] == points[~lost]).sum() == numpy.isfinite(points[~lost]).sum(), "no mask")
depths = numpy.full((HEIGHT, WIDTH), 500, numpy.uint16)
seen = inputs.scan_of(numpy.ma.array(depths, mask=hidden), numpy.array([[500, 0, 80], [0, 500, 60], [0, 0, 1]])).points
check((numpy.isnan(seen[..., 2]) == hidden).all(), "masked depths")
raises("the image has masked pixels", ppfmeam.detect, model, points, numpy.ma.array(grey, mask=hidden))
check((inputs.scan_of(points, region=numpy.ma.array(rows, mask=hidden)).region_mask.reshape(hidden.shape) == ~hidden).all(), "a masked region")

bare, alone = ppfmeam.detect(model, points), ppfmeam.detect(model, flat)
check("no image" in bare.report and "the grid of a pinhole camera" in alone.report, f"{bare.report} {alone.report}")
check(numpy.allclose(bare.poses, alone.poses, atol=1e-3), "points alone, on the grid that they lie on")
write("points.obj", "# a scan\n" + "".join(f"v {x:.6f} {y:.6f} {z:.6f}\n" for x, y, z in flat[numpy.isfinite(flat).all(axis=1)]))
check(numpy.allclose(ppfmeam.detect(model, "points.obj").poses, alone.poses, atol=1e-3), "the vertices of an OBJ")
check(scripting.read_scan("points.obj", 2.0).GetNumberOfPoints() == numpy.isfinite(flat).all(axis=1).sum(), "and for the commands")
raises("has no faces", ppfmeam.train, "points.obj")
raises(str(WIDTH), ppfmeam.detect, model, points, grey[:-1])
raises("ends in .meam", model.save, "model.stl")
raises("no such folder", model.save, "no/model.meam")
raises(".html (the page of show())", found.save, "poses.png")
shutil.copy("model.meam", "cut.meam")
os.truncate("cut.meam", os.path.getsize("cut.meam") - 100)
raises("train the model again", ppfmeam.load, "cut.meam")
reader.SetFileName("cut.meam")
fails(reader, "cut off")
check(connect(filters.vtkMEAMModelWriter(), model.data, FileName="no/model.meam").Write() == 0, "written to a folder that is not there")
with warnings.catch_warnings(record=True) as caught:
    warnings.simplefilter("always")
    with Quiet():
        ppfmeam.detect(model, points / 10, grey, poses=1)
check(any("factor" in str(warning.message) for warning in caught), f"{[str(w.message) for w in caught]}")
