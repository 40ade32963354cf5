# SPDX-License-Identifier: BSD-3-Clause
"""The node of ROS 2, examples/cell/ros2_node.py, without ROS: its messages may have the fields of the definitions below and no
other, and are those of the poses and the pick that Python finds."""
import os
import sys
import tempfile
import types

import numpy
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkIOGeometry import vtkSTLWriter

import ppfmeam
from ppfmeam import filters, scripting
from meamtest import check, connect

# What the definitions of ROS 2 say (builtin_interfaces, std_msgs, geometry_msgs, sensor_msgs; vision_msgs from version 4 on),
# in words of our own: a field is NAME:TYPE, a list of them NAME:TYPE[], and without a type a number, a text or bytes.
DEFINITIONS = """
Time: sec nanosec
Header: stamp:Time frame_id
Point: x y z
Vector3: x y z
Quaternion: x y z w
Pose: position:Point orientation:Quaternion
PoseStamped: header:Header pose:Pose
PoseWithCovariance: pose:Pose covariance
PointField: name offset datatype count
PointCloud2: header:Header height width fields:PointField[] is_bigendian point_step row_step data is_dense
ObjectHypothesis: class_id score
ObjectHypothesisWithPose: hypothesis:ObjectHypothesis pose:PoseWithCovariance
BoundingBox3D: center:Pose size:Vector3
Detection3D: header:Header results:ObjectHypothesisWithPose[] bbox:BoundingBox3D id
Detection3DArray: header:Header detections:Detection3D[]
"""
MESSAGES = {}
for definition in DEFINITIONS.strip().splitlines():
    name, fields = definition.split(": ")
    types_of = dict(field.split(":") if ":" in field else (field, None) for field in fields.split())

    def init(self, types_of=types_of):
        for field, kind in types_of.items():
            setattr(self, field, None if kind is None else [] if kind.endswith("[]") else MESSAGES[kind]())

    MESSAGES[name] = type(name, (), {"__slots__": tuple(types_of), "__init__": init, "TYPES": types_of})


def set_message_fields(message, values):
    """As rosidl_runtime_py has it; a field that a message does not have is an AttributeError."""
    for field, value in values.items():
        kind = message.TYPES.get(field)
        if kind and kind.endswith("[]"):
            items = [MESSAGES[kind[:-2]]() for _ in value]
            for item, each in zip(items, value):
                set_message_fields(item, each)
            setattr(message, field, items)
        elif kind:
            set_message_fields(getattr(message, field), value)
        else:
            setattr(message, field, value)


def is_whole(message):
    """Whether all that the definition says is there."""
    return all((getattr(message, field) is not None) if kind is None else all(map(is_whole, getattr(message, field)))
               if kind.endswith("[]") else is_whole(getattr(message, field)) for field, kind in message.TYPES.items())


class Node:
    def __init__(self, name):
        self.sent, self.words, self.callbacks = {}, [], {}

    def declare_parameter(self, name, default):
        return types.SimpleNamespace(value=default)

    def create_publisher(self, kind, topic, depth):
        def publish(message):
            check(type(message) is kind and is_whole(message), f"{topic}: not a whole {kind.__name__}")
            self.sent.setdefault(topic, []).append(message)
        return types.SimpleNamespace(publish=publish)

    def create_subscription(self, kind, topic, callback, depth):
        self.callbacks[topic] = callback

    def get_logger(self):
        return types.SimpleNamespace(error=self.words.append, warning=self.words.append)


def module(name, **members):
    sys.modules[name] = types.ModuleType(name)
    vars(sys.modules[name]).update(members)


for package, names in (("geometry_msgs", ["PoseStamped"]), ("sensor_msgs", ["PointCloud2"]), ("vision_msgs", ["Detection3DArray"])):
    module(package)
    module(f"{package}.msg", **{name: MESSAGES[name] for name in names})
module("rclpy")
module("rclpy.node", Node=Node)
module("rosidl_runtime_py")
module("rosidl_runtime_py.set_message", set_message_fields=set_message_fields)
sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", "examples", "cell"))
import ros2_node

folder = tempfile.TemporaryDirectory()
os.chdir(folder.name)
W, H, STEP = 640, 480, 20
source = connect(filters.vtkMEAMBinSceneSource(), Copies=5, Width=W, Height=H)
scripting.update(source)
scan, mesh = source.GetOutputDataObject(0), source.GetOutputDataObject(2)
model = ppfmeam.train(mesh)
model.save("part.meam")
connect(vtkSTLWriter(), mesh, FileName="part.stl", FileType=2).Write()  # binary
grasps = ppfmeam.grasps("part.stl", symmetries=model, grasps=100, **ros2_node.GRIPPER)
grasps.save("part.grasps.json")
points = vtk_to_numpy(scan.GetPoints().GetData()).reshape(H, W, 3)
grey = vtk_to_numpy(scan.GetPointData().GetArray("Intensity")).astype(numpy.uint32).reshape(H, W)


def cloud_of(points, colors):
    """A cloud as drivers of cameras have it, in metres, with 16 bytes of padding in a row."""
    height, width = points.shape[:2]
    grid = numpy.zeros((height, width), {"names": ["x", "y", "z", "rgb"], "formats": ["<f4", "<f4", "<f4", "<u4"],
                                         "offsets": [0, 4, 8, 16], "itemsize": STEP})
    for k, axis in enumerate("xyz"):
        grid[axis] = points[..., k] / 1000
    grid["rgb"] = colors << 16 | colors << 8 | colors
    cloud = MESSAGES["PointCloud2"]()
    set_message_fields(cloud, {
        "header": {"stamp": {"sec": 12, "nanosec": 34}, "frame_id": "camera_optical"}, "height": height, "width": width,
        "fields": [{"name": name, "offset": offset, "datatype": 7, "count": 1} for name, offset in
                   (("x", 0), ("y", 4), ("z", 8), ("rgb", 16))],
        "is_bigendian": False, "point_step": STEP, "row_step": STEP * width + 16, "is_dense": False,
        "data": b"".join(row.tobytes() + bytes(16) for row in grid)})
    return cloud


node = ros2_node.PickingNode()
node.callbacks["cloud"](cloud_of(points, grey))
check(not node.words, f"it says {node.words}")
metres = (points / 1000).astype(numpy.float32) * numpy.float32(1000)
found = ppfmeam.detect(model, metres, numpy.repeat(grey[..., None], 3, 2).astype(numpy.uint8), poses=0, probability=0.5)
check(len(found) >= 2, f"{len(found)} poses to compare with")
array = node.sent["detections"][0]
check(len(array.detections) == len(found), f"{len(array.detections)} detections of {len(found)} poses")
for detection, pose in zip(array.detections, found.poses):
    check(detection.header.frame_id == "camera_optical" and detection.header.stamp.nanosec == 34, "another header")
    place = detection.results[0].pose.pose.position
    check(numpy.allclose([place.x, place.y, place.z], pose[:3, 3] / 1000, atol=1e-6), "it is elsewhere")
picks = ppfmeam.pick(found, grasps, metres)
check(picks[0].possible, f"nothing can be picked: {picks.report}")
pick = node.sent["pick"][0]
place, turn = pick.pose.position, pick.pose.orientation
check(pick.header.frame_id == "camera_optical", "the pick has another frame")
check(numpy.allclose([place.x, place.y, place.z], picks[0].transform[:3, 3] / 1000, atol=1e-6), "the pick is elsewhere")
way_in = [2 * (turn.x * turn.z + turn.y * turn.w), 2 * (turn.y * turn.z - turn.x * turn.w), 1 - 2 * (turn.x ** 2 + turn.y ** 2)]
check(numpy.allclose(way_in, picks[0].transform[:3, 2], atol=1e-6), "the pick is turned")

# Points alone, an empty cloud and one that is damaged: the node lives on.
alone = cloud_of(points.reshape(1, -1, 3), grey.reshape(1, -1))
check(ros2_node.scan_of(alone)[0].shape == (W * H, 3) and ros2_node.scan_of(alone)[1] is None, "points alone")
damaged = cloud_of(points, grey)
damaged.data = damaged.data[:1000]
node.callbacks["cloud"](damaged)
node.callbacks["cloud"](cloud_of(numpy.full((H, W, 3), numpy.nan), grey))
check(len(node.words) == 2 and len(node.sent["pick"]) == 1, f"{node.words}")
node.callbacks["cloud"](cloud_of(points, grey))
check(len(node.sent["pick"]) == 2, "it has stopped")
