# SPDX-License-Identifier: BSD-3-Clause
"""grasps() and pick(): where a gripper holds a part, and which of the poses that detect() found it can take there."""
import os

import numpy
from vtkmodules.vtkCommonDataModel import vtkDataObject
from vtkmodules.vtkCommonTransforms import vtkTransform

from . import Error, filters, scripting
from .api import chosen, scan_of
from .simulation import camel

GRASPS_PROPOSED = {"parallel": "ParallelJaws", "suction": "Suction", "both": "Both", "off": "Off"}
GRIPPER_LENGTHS = ("opening", "jaw_clearance", "finger_width", "finger_thickness", "finger_length", "tip_length",
                   "body_length", "body_width", "cup_diameter", "cup_length")
GRIPPERS = {"jaws": "ParallelJaws", "cup": "SuctionCup"}
BINS = {"detected": "Detected", "none": "None"}


class Grasps:
    """Where a gripper holds a part: `transforms` (N x 4 x 4, the part's coordinates, mm: z the way in, x along which jaws
    close), `names`, `kinds` ("parallel" or "suction"), `widths` (mm, between the jaws), `free_turns` ("none", "approach" or
    "closing": the axis about which any turn holds as well) and `qualities`, from 0 to 1. `data` is the VTK data object, `part`
    that of the part's mesh, and `gripper` the lengths that were given, by name."""

    def __init__(self, data, part, gripper):
        self.data, self.part, self.gripper = data, part, gripper
        self.transforms = scripting.column(data, "Transform", 4, 4)
        self.names = scripting.texts(data, "GraspName")
        self.kinds = [("parallel", "suction")[k] for k in scripting.column(data, "Kind")]
        self.widths = scripting.column(data, "Width")
        self.free_turns = [("none", "approach", "closing")[k] for k in scripting.column(data, "FreeTurn")]
        self.qualities = scripting.column(data, "Quality")

    def __len__(self):
        return len(self.names)

    def save(self, path):
        """Writes the JSON that grasps() reads."""
        scripting.write_with(filters.vtkMEAMGraspWriter(), self.data, path)


class Picks:
    """What a gripper can take, best first, and after it what it cannot: `possible` (of each), `reasons` (what is against it; empty:
    nothing), `transforms` (N x 4 x 4, takes the gripper's coordinates to the scan's, mm: z the way in), `robot_transforms`
    (the same in the robot's frame, with a robot_frame; else None), `instances` (which pose, from 0), `grasps` (which grasp, from
    0), `names` (of the grasps), `widths` (mm), `clearances` and `reaches` (mm), `tilts` (degrees), `covered` and `scores` (from 0
    to 1). `report` tells in a sentence what keeps the gripper from copies that cannot be picked, `advice` what to change for
    them (empty: all can be picked); `data` is the VTK data object."""

    def __init__(self, data):
        def column(name, *shape):
            return scripting.column(data, name, *shape)

        self.data = data
        self.report, self.advice = (data.GetFieldData().GetAbstractArray(name).GetValue(0) for name in ("PickReport", "PickAdvice"))
        self.possible = column("Possible").astype(bool)
        self.reasons, self.names = scripting.texts(data, "Reason"), scripting.texts(data, "GraspName")
        self.transforms, self.robot_transforms = column("Transform", 4, 4), column("RobotTransform", 4, 4)
        self.instances, self.grasps = column("Instance") - 1, column("Grasp") - 1
        self.widths, self.clearances, self.reaches = column("Width"), column("Clearance"), column("Reach")
        self.tilts, self.covered, self.scores = column("Tilt"), column("Covered"), column("Score")

    def __len__(self):
        return len(self.names)


def grasps(cad, file=None, propose=None, scale=1.0, offset=(0.0, 0.0, 0.0), grasps=20, symmetries=None, **gripper):
    """Where a gripper holds a part: the grasps of a `file` (JSON), and those proposed from its mesh, best first.

    cad, scale, offset: the part, as train() takes it. propose: parallel (the default without a file), suction, both, or off
    (the default with one); `grasps` of each kind at most. symmetries: the part's Model; of proposals that are equal one comes
    out. gripper: lengths in mm, opening, jaw_clearance, finger_width, finger_thickness, finger_length, tip_length,
    body_length, body_width, cup_diameter, cup_length, as vtkMEAMGraspDefinition has them. Returns Grasps.
    """
    definition = filters.vtkMEAMGraspDefinition()
    if isinstance(cad, vtkDataObject):
        part = scripting.prepare_mesh(cad, offset, scale)
    else:
        part = scripting.read_mesh(os.fspath(cad), offset, scale)
    definition.SetInputDataObject(part)
    if symmetries is not None:
        definition.SetInputDataObject(1, symmetries.data)
    if file is not None:
        scripting.require_file(os.fspath(file))
        definition.SetFileName(os.fspath(file))
    wanted = chosen("propose", propose or ("parallel" if file is None else "off"), GRASPS_PROPOSED)
    scripting.set_choice(definition, "Propose", GRASPS_PROPOSED[wanted])
    definition.SetMaximumNumberOfGrasps(grasps)
    set_lengths(definition, gripper)
    return Grasps(scripting.update(definition).GetOutput(), part, gripper)


def set_lengths(filter, lengths):
    """The lengths of a gripper, mm, by name."""
    for name, length in lengths.items():
        if name not in GRIPPER_LENGTHS:
            raise Error(f"a gripper has no length {name!r}; it has {', '.join(GRIPPER_LENGTHS)}")
        getattr(filter, "Set" + camel(name))(length)


def pick(found, grasps, scan=None, gripper="jaws", bin="detected", robot_frame=None, probability=0.5, tilt=60.0, covered=20.0,
         margin=2.0, way_in=80.0, camera=None, scale=1.0, **lengths):
    """Which of the parts that were found a gripper can take, and what is against the others.

    found: Detections of detect(), or poses N x 4 x 4. grasps: those of the part, as grasps() returns them; the gripper has their
    lengths, unless others are given. scan, camera, scale: as detect() takes them; without a scan only the other copies and the
    bin are in the way. gripper: jaws, cup, or a mesh (a file or a vtkPolyData) as it stands open in the grasp's frame.
    bin: detected (by its rim, in the scan), none, or (T, length, width, height, wall): T, 4 x 4, takes the coordinates of the
    bin, whose z goes up from the middle of its floor, to the scan's; mm. robot_frame: a file of OpenCV or ROS with the
    camera in the robot's frame. probability: of a pose at least. tilt: degrees at most. covered: % of the part from
    above at most. margin: mm that the gripper keeps from all but the part. way_in: mm that are free before the grasp.
    Returns Picks.
    """
    planning = filters.vtkMEAMPickPlanning()
    poses = found.data if hasattr(found, "data") and isinstance(found.data, vtkDataObject) else numpy.asarray(found, float)
    if isinstance(poses, numpy.ndarray):
        if poses.ndim != 3 or poses.shape[1:] != (4, 4):
            raise Error(f"the poses have to be an array N x 4 x 4, not one with the shape {poses.shape}")
        poses = scripting.poses_of(poses)
    planning.SetInputDataObject(poses)
    planning.SetInputDataObject(1, grasps.part)
    planning.SetInputDataObject(2, grasps.data)
    if scan is not None:
        planning.SetInputDataObject(3, scan_of(scan, camera, scale))
    if isinstance(gripper, str) and gripper in GRIPPERS:
        scripting.set_choice(planning, "Gripper", GRIPPERS[gripper])
    elif isinstance(gripper, vtkDataObject):
        planning.SetInputDataObject(4, gripper)
    else:
        planning.SetInputDataObject(4, scripting.read_mesh(os.fspath(gripper)))
    set_lengths(planning, {**grasps.gripper, **lengths})
    if isinstance(bin, str):
        scripting.set_choice(planning, "Bin", BINS[chosen("bin", bin, BINS)])
    else:
        set_bin(planning, *bin)
    if robot_frame is not None:
        scripting.require_file(os.fspath(robot_frame))
        planning.SetRobotFrameFile(os.fspath(robot_frame))
    for name, value in dict(MinimumProbability=probability, MaximumTilt=tilt, MaximumCovered=covered, SafetyMargin=margin,
                            WayIn=way_in).items():
        getattr(planning, "Set" + name)(value)
    return Picks(scripting.update(planning).GetOutput())


def set_bin(planning, transform, length, width, height, wall=5.0):
    """A bin that is given by its frame and its sizes, mm."""
    frame = numpy.asarray(transform, float)
    if frame.shape != (4, 4):
        raise Error(f"the frame of the bin has to be a matrix of 4 x 4, not an array with the shape {frame.shape}")
    turn = vtkTransform()
    turn.SetMatrix(frame.ravel())
    planning.SetBinToGiven()
    planning.SetBinPosition(*frame[:3, 3])
    planning.SetBinRotation(*turn.GetOrientation())
    planning.SetBinSize(length, width, height)
    planning.SetBinWall(wall)
