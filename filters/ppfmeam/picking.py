# SPDX-License-Identifier: BSD-3-Clause
"""grasps() and pick(): where a gripper holds a part, and which of the poses that detect() found it can take there."""
import os

import numpy

from . import Error, _core, inputs, scripting
from .api import Detections, Model, Rows
from .choices import TABLE, Chosen, checked, checked_scale, takes, worded

PROPOSED = {"parallel": ("parallel",), "suction": ("suction",), "both": ("parallel", "suction"), "off": ()}
GRIPPERS = {"jaws": "parallel", "cup": "suction"}


class Grasps(Rows):
    """Where a gripper holds a part, rows of Grasp. In columns `transforms` (N x 4 x 4, the part's coordinates, mm: z the way in,
    x along which jaws close), `names`, `kinds` ("parallel" or "suction"), `widths` (mm, between the jaws), `free_turns` ("none",
    "approach" or "closing": the axis about which any turn holds as well) and `qualities`, from 0 to 1. `gripper`: the lengths
    that were given, by name."""
    COLUMNS = {"transforms": ("transform", (4, 4)), "names": ("name", None), "kinds": ("kind", None), "widths": ("width", ()),
               "free_turns": ("free_turn", None), "qualities": ("quality", ())}

    def __init__(self, rows, part, model, gripper):
        super().__init__(rows)
        self.part, self.model, self.gripper = part, model, gripper

    def __str__(self):
        return "\n".join(["kind      quality  width (mm)  name"] + [
            f"{grasp.kind:8s}  {grasp.quality:7.2f}  {grasp.width:10.2f}  {grasp.name}" for grasp in self])

    def save(self, path):
        """Writes the JSON that grasps() reads."""
        scripting.require_folder_of(path)
        _core.save_grasps(os.fspath(path), self.rows)


class Picks(Rows):
    """What a gripper can take, best first, and after it what it cannot, rows of Pick. In columns `possible`, `reasons` (what is
    against it; empty: nothing), `transforms` (N x 4 x 4, takes the gripper's coordinates to the scan's, mm: z the way in),
    `robot_transforms` (the same in the robot's frame, with a robot_frame; else None), `instances` (which pose, from 0), `parts`
    (which type of part, from 0), `grasps` (which grasp of that type, from 0), `names` (of the grasps), `widths` (mm),
    `clearances` and `reaches` (mm), `tilts` (degrees), `covered` and `scores` (from 0 to 1). `report` tells in a sentence what
    keeps the gripper from copies that cannot be picked, `advice` what to change for them (empty: all can be picked); `bin`: the
    one that was found or given; `found`: the Detections that it was made for, or None."""
    COLUMNS = {"possible": ("possible", ()), "reasons": ("reason", None), "transforms": ("transform", (4, 4)),
               "instances": ("instance", ()), "parts": ("part", ()), "grasps": ("grasp", ()), "names": ("name", None), "widths": ("width", ()),
               "clearances": ("clearance", ()), "reaches": ("reach", ()), "tilts": ("tilt", ()), "covered": ("covered", ()),
               "scores": ("score", ())}

    def __init__(self, plan, has_robot, found, sets, grippers):
        super().__init__(plan.picks)
        self.found, self.sets, self.grippers = found, sets, grippers
        self.report, self.advice, self.bin, self.seconds = plan.report, worded(plan.advice), plan.bin, plan.seconds
        self.robot_transforms = None
        if has_robot:
            self.robot_transforms = numpy.array([pick.robot_transform for pick in self]).reshape(-1, 4, 4)

    def __str__(self):
        return "\n".join(["pose  score  clearance (mm)  grasp or reason"] + [
            f"{pick.instance + 1:4d}  {pick.score:.3f}  {pick.clearance:14.1f}  {pick.name}" + (f": {pick.reason}" if pick.reason else "")
            for pick in self] + [self.report])

    def best(self):
        """Of each pose the row of its best pick, or else of one that is not possible."""
        _, first = numpy.unique(self.instances, return_index=True)
        return numpy.sort(first)

    def gripper(self, row):
        """The open gripper at a pick: vertices (N x 3, mm, in the scan's coordinates) and triangles (M x 3)."""
        pick = self[row]
        mesh = _core.gripper_mesh(self.grippers[pick.part], self.sets[pick.part][pick.grasp])
        return mesh.vertices @ pick.transform[:3, :3].T + pick.transform[:3, 3], mesh.triangles

    def save(self, path):
        """Writes .json, all picks with what is against them, or .html, the page of show()."""
        name = os.fspath(path).lower()
        if not name.endswith((".json", ".html", ".htm")):
            raise Error(f"{path} was not written: picks go to .json, or .html (the page of show()); choose one of these extensions")
        scripting.require_folder_of(path)
        if not name.endswith(".json"):
            return self.page().save(self.require_found(), path, self)
        return scripting.write_json(os.fspath(path), self.content())

    def content(self):
        """All picks, for JSON."""
        columns = [column for column in (*self.COLUMNS, "robot_transforms") if getattr(self, column) is not None]
        rows = [dict(zip(columns, row)) for row in zip(*(getattr(self, column) for column in columns))]
        return {"report": self.report, "advice": self.advice, "parts": self.part_names(), "picks": rows}

    def show(self):
        """Opens a page as Detections.show() does, with the gripper at the best pick of the pose that is chosen."""
        return self.page().show(self.require_found(), self)

    def parts_shown(self):
        """Of each type its name and mesh, for the page."""
        from .report import content
        return list(map(content.Part, self.part_names(), self.shapes()))

    def shapes(self):
        """The parts' meshes, of VTK."""
        return [inputs.vtk_mesh(each.part.vertices, each.part.triangles) for each in self.sets]

    def part_names(self):
        """Of the types of part; none of poses alone."""
        return [] if self.found is None else scripting.part_names([model.file or model.name for model in self.found.models])

    def require_found(self):
        if self.found is None:
            raise Error("a page shows the scan: give pick() the Detections of detect(), not poses alone")
        return self.found

    @staticmethod
    def page():
        from .report import notebook  # only now: it needs api.py
        return notebook


def gripper_model(lengths, kind, mesh=None):
    """The gripper of the C++ library."""
    gripper = lengths.apply(_core.GripperModel(), _core)
    if kind == "suction":
        gripper.use_cup()
    if mesh is not None:
        gripper.mesh = mesh
    return gripper


@takes(settings="propose", gripper="gripper", reading="read")
def grasps(cad, file=None, propose=None, scale=1.0, offset=(0.0, 0.0, 0.0), symmetries=None, *, settings, gripper, reading):
    """Where a gripper holds a part: the grasps of a `file` (JSON), and those proposed from its mesh, best first.

    cad, scale, offset: the part, as train() takes it. propose: parallel (the default without a file), suction, both, or off
    (the default with one); `grasps` of each kind at most. symmetries: the part's Model; of proposals that are equal one comes
    out. Returns Grasps.
    """
    wanted = propose or ("parallel" if file is None else "off")
    if wanted not in PROPOSED:
        raise Error(f"propose has to be one of {', '.join(map(repr, PROPOSED))}, not {propose!r}")
    part = _core.prepare_mesh(inputs.mesh_of(cad, reading), checked_scale("scale", scale), checked("offset", TABLE["train"]["offset"], offset))
    if not isinstance(symmetries, (Model, type(None))):
        raise Error(f"symmetries has to be the part's Model, not {symmetries!r}")
    model = _core.Model() if symmetries is None else symmetries.core
    found = _core.load_grasps(inputs.path_of(file)) if file is not None else []
    for kind in PROPOSED[wanted]:
        found += _core.propose_grasps(model, part, gripper_model(gripper, kind), settings.apply(_core.ProposeSettings(), _core))
    taken = set()
    for grasp in found:  # a second one of a name gets a number
        names = (grasp.name if k == 1 else f"{grasp.name} ({k})" for k in range(1, len(found) + 1))
        grasp.name = next(name for name in names if name not in taken)
        taken.add(grasp.name)
    return Grasps(found, part, model, gripper.given)


@takes(settings="plan", lengths="gripper")
def pick(found, grasps, scan=None, gripper=None, bin="detected", robot_frame=None, camera=None, scale=1.0, *, settings, lengths):
    """Which of the parts that were found a gripper can take, and what is against the others.

    found: Detections of detect(), or poses N x 4 x 4. grasps: those of the part, as grasps() returns them, or a list of those of
    each type of part, in the order of detect(), whose copies are all in the way; the gripper has their lengths, unless others
    are given. scan, camera, scale: as detect() takes them; without a scan only the other copies and the bin are in the way.
    gripper: jaws, cup, or a mesh (as train() takes it) as it stands open in the grasp's frame; without one a cup if all grasps
    are of suction, else jaws.
    bin: detected (by its rim, in the scan), none, or (T, length, width, height, wall): T, 4 x 4, takes the coordinates of the
    bin, whose z goes up from the middle of its floor, to the scan's; mm. robot_frame: a file of OpenCV or ROS with the
    camera in the robot's frame, or its matrix T_robot_camera, 4 x 4, mm. Returns Picks.
    """
    sets = grasps if isinstance(grasps, (list, tuple)) else [grasps]
    for each in sets:
        if not isinstance(each, Grasps):
            raise Error(f"the grasps have to be those of grasps(), not {type(each).__name__}")
    types = len(found.models) if isinstance(found, Detections) else 1
    if len(sets) != types:
        raise Error(f"give a list with the grasps of each type of part, in the order of detect(): found has {types} and grasps {len(sets)}")
    if not isinstance(found, Detections):
        transforms = numpy.asarray(found, float)
        if transforms.ndim != 3 or transforms.shape[1:] != (4, 4):
            raise Error(f"the poses have to be an array N x 4 x 4, not one with the shape {transforms.shape}")
        if not is_rotation(transforms[:, :3, :3]):
            raise Error("the poses have to be rotations and translations")
    poses = found.core if isinstance(found, Detections) else _core.Detections(transforms)
    if gripper is None:
        gripper = "cup" if {kind for each in sets for kind in each.kinds} == {"suction"} else "jaws"
    is_mesh = not (isinstance(gripper, str) and gripper in GRIPPERS)
    mesh = _core.prepare_mesh(inputs.mesh_of(gripper, Chosen("read", {})), 1.0, (0.0, 0.0, 0.0)) if is_mesh else None
    kind = None if is_mesh else GRIPPERS[gripper]
    shapes = [gripper_model(Chosen("gripper", {**each.gripper, **lengths.given}), kind, mesh) for each in sets]
    place = workplace(bin, robot_frame)
    if bin == "detected" and scan is None:
        raise Error("the bin is found in the scan: give one, or bin, which may be 'none'")
    seen = _core.Scan(numpy.zeros((0, 3), numpy.float32)) if scan is None else inputs.scan_of(scan, camera, scale)
    models, parts, rows = zip(*((each.model, each.part, each.rows) for each in sets))
    plan = _core.plan(models, parts, rows, shapes, settings.apply(_core.PlanSettings(), _core), poses, seen, place)
    return Picks(plan, robot_frame is not None, found if isinstance(found, Detections) else None, sets, shapes)


def is_rotation(turns):
    """Whether matrices are, up to three decimals."""
    return numpy.allclose(turns @ turns.swapaxes(-1, -2), numpy.eye(3), atol=2e-3) and (numpy.linalg.det(turns) > 0).all()


def workplace(bin, robot_frame):
    """Where the bin and the robot are."""
    place = _core.Workplace()
    if isinstance(bin, str) and bin in ("detected", "none"):
        place.has_bin = bin == "detected"
    elif not isinstance(bin, (tuple, list)) or len(bin) not in (4, 5):
        raise Error(f"bin has to be 'detected', 'none' or (T, length, width, height, wall), not {bin!r}")
    else:
        transform, length, width, height, *wall = bin
        frame = numpy.asarray(transform, float)
        if frame.shape != (4, 4):
            raise Error(f"the frame of the bin has to be a matrix of 4 x 4, not an array with the shape {frame.shape}")
        place.bin = _core.Bin(frame, (length, width, height), *(wall or [5.0]))
    if robot_frame is not None:
        place.set_robot_frame(frame_of(robot_frame))
    return place


def frame_of(robot_frame):
    """T_robot_camera of a file, or a matrix."""
    if isinstance(robot_frame, (str, os.PathLike)):
        return _core.load_robot_frame(inputs.path_of(robot_frame))
    try:
        frame = numpy.asarray(robot_frame, float)
    except (TypeError, ValueError):
        frame = numpy.zeros(0)
    if frame.shape != (4, 4) or not is_rotation(frame[:3, :3]) or (frame[3] != (0, 0, 0, 1)).any():
        raise Error(f"robot_frame has to be a file, or a matrix of 4 x 4 that is a rotation and a translation, mm, not {robot_frame!r}")
    return frame
