#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""A node of ROS 2: the poses and the best pick in each cloud that arrives.

    ros2_node.py --ros-args -p model:=part.meam -p cad:=part.stl -p grasps:=part.grasps.json -r cloud:=/camera/depth/points

Subscribes to `cloud` (sensor_msgs/PointCloud2), publishes `detections` (vision_msgs/Detection3DArray) and `pick`
(geometry_msgs/PoseStamped: where the gripper holds the part, z the way in, x along which jaws close). All in metres, in the
cloud's frame: tf2 takes them to the robot's, by the transform that `ppfmeam hand-eye pairs.json --out robot.yaml` writes."""
import json
import os
import tempfile

import numpy
import rclpy
from geometry_msgs.msg import PoseStamped
from rclpy.node import Node
from rosidl_runtime_py.set_message import set_message_fields
from sensor_msgs.msg import PointCloud2
from vision_msgs.msg import Detection3DArray
from vtkmodules.vtkCommonCore import vtkMath

import ppfmeam

GRIPPER = {"opening": 60, "finger_width": 8, "finger_thickness": 5}  # mm
PROBABILITY, TIME_LIMIT = 0.5, 2.0
METRE = 1000.0  # mm
FORMATS = {1: "i1", 2: "u1", 3: "i2", 4: "u2", 5: "i4", 6: "u4", 7: "f4", 8: "f8"}  # by PointField.datatype
COLORS = ("rgb", "rgba")  # packed into 32 bits, whatever the datatype says


def scan_of(cloud):
    """Points, mm, H x W x 3 or N x 3, and the colours of an organized cloud, or None."""
    order = ">" if cloud.is_bigendian else "<"
    formats = [order + ("u4" if field.name in COLORS else FORMATS[field.datatype]) for field in cloud.fields]
    layout = numpy.dtype({"names": [field.name for field in cloud.fields], "formats": formats,
                          "offsets": [field.offset for field in cloud.fields], "itemsize": cloud.point_step})
    rows = numpy.frombuffer(cloud.data, numpy.uint8).reshape(cloud.height, cloud.row_step)
    grid = numpy.ascontiguousarray(rows[:, :cloud.width * cloud.point_step]).view(layout)
    points = METRE * numpy.stack([grid[axis] for axis in "xyz"], -1).astype(numpy.float32)
    if cloud.height == 1:
        return points[0], None
    packed = next((grid[name] for name in COLORS if name in layout.names), None)
    if packed is None:
        return points, None
    return points, numpy.stack([packed >> shift & 255 for shift in (16, 8, 0)], -1).astype(numpy.uint8)


class PickingNode(Node):
    def __init__(self):
        super().__init__("ppfmeam")
        model, cad, grasps = (self.declare_parameter(name, default).value for name, default in (
            ("model", "part.meam"), ("cad", "part.stl"), ("grasps", "part.grasps.json")))
        self.model = ppfmeam.load(model)
        self.grasps = ppfmeam.grasps(cad, file=grasps, symmetries=self.model, **GRIPPER)
        self.detections = self.create_publisher(Detection3DArray, "detections", 1)
        self.picks = self.create_publisher(PoseStamped, "pick", 1)
        self.create_subscription(PointCloud2, "cloud", self.take, 1)  # of clouds that wait the newest

    def take(self, cloud):
        try:
            points, image = scan_of(cloud)
            found = ppfmeam.detect(self.model, points, image, poses=0, probability=PROBABILITY, time_limit=TIME_LIMIT)
            self.detections.publish(self.detections_of(found, cloud.header))
            picks = ppfmeam.pick(found, self.grasps, points) if len(found) else None
        except Exception as error:  # the next cloud is not to wait for it
            self.get_logger().error(str(error))
            return
        if picks and picks[0].possible:
            self.picks.publish(self.pick_of(picks[0].transform, cloud.header))
        else:
            self.get_logger().warning(f"no pick: {picks.report} {picks.advice}" if picks else "no part was found")

    @staticmethod
    def detections_of(found, header):
        message = Detection3DArray()
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "found.detections.json")  # it has the message's fields
            found.save(path)
            with open(path, encoding="utf-8") as file:
                set_message_fields(message, json.load(file))
        message.header = header
        for detection in message.detections:
            detection.header = header
        return message

    @staticmethod
    def pick_of(T, header):
        message, quaternion = PoseStamped(), [0.0] * 4
        vtkMath.Matrix3x3ToQuaternion(T[:3, :3].tolist(), quaternion)
        message.header = header
        for name, value in zip("xyz", T[:3, 3] / METRE):
            setattr(message.pose.position, name, float(value))
        for name, value in zip("wxyz", quaternion):
            setattr(message.pose.orientation, name, value)
        return message


def main():
    rclpy.init()
    rclpy.spin(PickingNode())


if __name__ == "__main__":
    main()
