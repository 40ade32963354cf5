# SPDX-License-Identifier: BSD-3-Clause
"""A small BOP dataset: images as time steps, scans, images and true poses; damaged ones."""
import json
import os
import shutil

from vtkmodules.vtkCommonExecutionModel import vtkStreamingDemandDrivenPipeline

from ppfmeam.filters import vtkMEAMBOPReader
from meamtest import Errors, Folder, check, close, connect, fails, field, is_empty, png, points, run, tuples

folder = Folder()
CAMERA = {"cam_K": [100, 0, 1, 0, 200, 0.5, 0, 0, 1], "depth_scale": 0.1}
TURNED = {"obj_id": 5, "cam_R_m2c": [0, -1, 0, 1, 0, 0, 0, 0, 1], "cam_t_m2c": [1, 2, 300]}
STRAIGHT = {"obj_id": 6, "cam_R_m2c": [1, 0, 0, 0, 1, 0, 0, 0, 1], "cam_t_m2c": [0, 0, 400]}


def write(name, content):
    return folder(name, json.dumps(content))


def image(name, rows, *kind):
    return png(folder(name, b""), rows, *kind)


def reader(path, **properties):
    return connect(vtkMEAMBOPReader(), FileName=path, **properties)


root = write("camera.json", {})
write("test/000003/scene_camera.json", {"10": CAMERA, "2": CAMERA})
write("test/000003/scene_gt.json", {"2": [TURNED, STRAIGHT, TURNED], "10": []})
write("test/000003/scene_gt_info.json", {"2": [{"visib_fract": v} for v in (0.75, 1, 0)]})
image("test/000003/depth/000002.png", [[(0,), (5000,), (6000,)]] * 2, "uint16")
image("test/000003/depth/000010.png", [[(7000,)] * 3] * 2, "uint16")
image("test/000003/rgb/000002.png", [[(1, 2, 3)] * 3] * 2)
image("test/000003/gray/000010.png", [[(9,)] * 3] * 2)
write("test/000012/scene_camera.json", {"0": CAMERA})
image("test/000012/depth/000000.png", [[(8000,)] * 3] * 2, "uint16")
write("train/000000/scene_camera.json", {"0": CAMERA})
image("train/000000/depth/000000.png", [[(9000,)] * 3] * 2, "uint16")

# The images of all scenes are the time steps.
data = reader(folder.name)
data.UpdateInformation()
for port in range(2):
    info = data.GetOutputInformation(port)
    check(info.Get(vtkStreamingDemandDrivenPipeline.TIME_STEPS()) == (0, 1, 2), "a time step for each image")
    check(info.Get(vtkStreamingDemandDrivenPipeline.TIME_RANGE()) == (0, 2), "the range of the time steps")
scan, truth = run(data), data.GetOutputDataObject(1)
check(close(points(scan)[1], (0, -1.25, 500), 1e-3), f"the second point is {points(scan)[1]}")
check([scan.IsPointVisible(i) for i in range(6)] == [0, 1, 1, 0, 1, 1], "points without depth are blanked")
check(tuples(scan, "RGB")[0] == (1, 2, 3), "colours")
check(field(scan, "SceneId") == [(3,)] and field(scan, "ImageId") == [(2,)], "scene and image are named")
check(tuples(truth, "ObjectId") == [(5,), (6,), (5,)], "the objects are named")
check(tuples(truth, "VisibleFraction") == [(0.75,), (1,), (0,)], "visible fractions")
check(tuples(truth, "Transform")[0] == (0, -1, 0, 1, 1, 0, 0, 2, 0, 0, 1, 300, 0, 0, 0, 1), "poses are row-major")
for time, scene, number, depth in ((1, 3, 10, 700), (2, 12, 0, 800), (0.2, 3, 2, 500), (-5, 3, 2, 500), (99, 12, 0, 800)):
    data.UpdateTimeStep(time)
    scan = data.GetOutputDataObject(0)
    check(field(scan, "SceneId") == [(scene,)] and field(scan, "ImageId") == [(number,)], f"time {time}: another image")
    check(abs(points(scan)[1][2] - depth) < 1e-3, f"time {time}: the depth is {points(scan)[1][2]}")
data.UpdateTimeStep(1)
check(tuples(data.GetOutputDataObject(0), "Intensity") == [(9,)] * 6, "a grey image")
check(data.GetOutputDataObject(0).GetPointData().GetArray("RGB") is None, "nothing is left of the image before")
check(data.GetOutputDataObject(1).GetNumberOfPoints() == 0, "an image without objects")
data.UpdateTimeStep(2)
check(data.GetOutputDataObject(0).GetPointData().GetArray("Intensity") is None, "no image is no error")

# One object, one scene, one split.
one = reader(os.path.join(folder.name, "test"), ObjectId=5)
run(one)
check(tuples(one.GetOutputDataObject(1), "ObjectId") == [(5,), (5,)], "the poses of one object")
scene = os.path.join(folder.name, "test", "000012")
for path in (scene, os.path.join(scene, "scene_camera.json")):
    check(field(run(reader(path)), "SceneId") == [(12,)], f"{path}: one scene")
check(abs(points(run(reader(folder.name, Split="train")))[0][2] - 900) < 1e-3, "another split")

check(vtkMEAMBOPReader().CanReadFile(root) == 1, "the camera of a dataset can be read")

fails(reader(folder.name, Split="val"), "'val'")
image("test/000012/depth/000000.png", [[(8000,)]], "uint16")
data = reader(folder.name)
run(data)
errors = Errors(data)
data.UpdateTimeStep(2)
check("another size" in str(errors) and is_empty(data.GetOutputDataObject(0)), f"images of different sizes: {errors}")
write("test/000003/scene_gt.json", {"2": [{"obj_id": 5}] * 3})
fails(reader(folder.name), "cam_R_m2c")
shutil.rmtree(os.path.join(folder.name, "test", "000003", "depth"))
fails(reader(folder.name), "depth image number 2")
folder("test/000003/scene_camera.json", '{"2": ')
fails(reader(folder.name), "not JSON")
