# SPDX-License-Identifier: BSD-3-Clause
"""train(), detect() and why(): files, NumPy arrays or VTK's data objects in, NumPy arrays out. What goes wrong is raised as
ppfmeam.Error; what may be wrong is a warning. train() and detect() let other threads of Python run meanwhile."""
import collections.abc
import os
import warnings

import numpy
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkCommonDataModel import vtkDataObject, vtkPartitionedDataSetCollection, vtkPolyData

from . import Error, _core, dataset, filters, inputs, regions, scripting
from .choices import checked_scale, takes, worded

WIDTHS = {"Quaternion": 4, "Covariance": 36}  # of arrays that have several values of a pose, also of none


class Rows(collections.abc.Sequence):
    """Rows of the C++ library, and their values as columns; COLUMNS: of each the name of the value, and its shape, or None for
    a list."""
    COLUMNS = {}

    def __init__(self, rows):
        self.rows = list(rows)
        for column, (name, shape) in self.COLUMNS.items():
            values = [getattr(row, name) for row in self.rows]
            setattr(self, column, values if shape is None else numpy.array(values).reshape(-1, *shape))

    def __len__(self):
        return len(self.rows)

    def __getitem__(self, place):
        return self.rows[place]

    def __repr__(self):
        return str(self)


class Model:
    """What training makes of a part and detection needs to know of it. `file`: where the part came from, if from a file; `shape`:
    its mesh, or the points of its surface, a vtkPolyData."""

    def __init__(self, model, file=None, mesh=None):
        self.core = inputs.model_from_vtk(model) if isinstance(model, vtkDataObject) else model
        self.file, self.mesh = file, mesh

    def __repr__(self):
        data = self.data
        views = sum(data.GetMetaData(k).Get(data.NAME()).startswith("View") for k in range(data.GetNumberOfPartitionedDataSets()))
        pairs = sum(scripting.field(data, name) for name in ("NumberOfPairs", "NumberOfSurfacePairs"))
        return (f"<ppfmeam.Model of {self.name}, {self.diameter:.1f} mm, {views} views, {pairs:.0f} pairs. "
                f"{scripting.symmetry_conclusion(data)}>")

    @property
    def name(self):
        return scripting.part_names([self.file])[0] if self.file else "a part"

    @property
    def shape(self):
        return self.mesh or scripting.shape_of(self.data)

    @property
    def diameter(self):
        """The largest distance between two points of the part, mm."""
        return self.core.diameter

    @property
    def data(self):
        """VTK's data object, as the filters take it."""
        return inputs.model_to_vtk(self.core)

    def save(self, path):
        """Writes NAME.meam, one file, which C++ and ParaView read; or NAME.vtpc."""
        path = os.fspath(path)
        scripting.require_folder_of(path)
        if path.lower().endswith(".meam"):
            self.core.save(path)
        else:
            scripting.write_model(self.data, path)


class Detections(Rows):
    """The poses found, best first: found[0] is the best one, a Pose. In columns `poses` (N x 4 x 4, each takes the part's
    coordinates to the scan's, mm), `scores` (the share of what should be visible that is there), `place_probabilities` (that a
    copy is there, however it is turned), `probabilities` (that it is also turned like this), `certainties` (that no
    near-symmetry turns it) and `visible_fractions`, all from 0 to 1; `seconds`, without
    training; `is_cut_short`, that the time limit struck; `scan_quality`, what an organized scan shows of its sensor, by name as
    vtkMEAMSceneEdgeExtraction has it; `report`, what was assumed of the scan;
    `advice`, what to change first for more parts or surer ones."""
    COLUMNS = {"poses": ("transform", (4, 4)), "scores": ("score", ()),
               "place_probabilities": ("place_probability", ()), "probabilities": ("probability", ()),
               "certainties": ("certainty", ()), "visible_fractions": ("visible_fraction", ()), "parts": ("part", ())}

    def __init__(self, found, models, given, of_cad, settings):
        super().__init__(found.poses)
        self.inputs, self.of_cad, self.settings, self.age = given, of_cad, settings, inputs.age_of(given["scan"])
        self.core, self.models, self.model = found, models, models[0]
        self.seconds, self.scan_quality, self.is_cut_short = found.seconds, found.quality, found.is_cut_short
        self.report, self.advice = found.report, worded(found.advice)

    def of(self, part):
        """Those of one of several types of part, by its place among them, as pick() takes them."""
        self.require_part(part)
        found = Detections(self.core.of(part), [self.models[part]], self.inputs, self.of_cad, self.settings)
        found.age = self.age
        return found

    def why(self, at=None, rank=None, part=None):
        """Why a part was missed at a point of the scan, three numbers, mm, or why the pose of a rank, from 1, came out, as
        ppfmeam.why() tells: a Diagnosis. A point on one of the poses asks about that pose. `part`: of several types the one that is
        asked about at a point; None: that of the likely pose there, or else the one that has most evidence there."""
        if (at is None) == (rank is None):
            raise Error("give either at, a point on the part, or rank, of a pose that came out")
        if rank is not None and (isinstance(rank, bool) or rank not in range(1, len(self) + 1)):
            raise Error(f"there is no pose of rank {rank!r}: {len(self)} came out")
        if part is not None:
            self.require_part(part)
            if rank is not None and part != self[rank - 1].part:
                raise Error(f"the pose of rank {rank} is of part {self[rank - 1].part}, not of part {part}: leave part out")
        self.require_scan()
        poses = self.data if rank is None else dataset.points_where(self.data, "Rank", rank)
        said = why(self.models, at=at, pose=poses, part_id=part, **self.inputs, **self.settings.values)
        return said if rank is None else said[0]

    def require_part(self, part):
        """Raises an Error where there is no such type of part."""
        if isinstance(part, bool) or part not in range(len(self.models)):
            raise Error(f"there is no part {part!r}: {len(self.models)} were looked for, from 0")

    def require_scan(self):
        """Raises an Error where the scan's file is another one than the parts were found in."""
        if inputs.age_of(self.inputs["scan"]) != self.age:
            raise Error(f"{inputs.path_of(self.inputs['scan'])} was written anew since the parts were found in it: detect() again to see them")

    def scan(self):
        """The scan, from its file again: results do not hold it."""
        self.require_scan()
        return inputs.scan_of(**self.inputs)

    def __str__(self):
        several, is_known = len(self.models) > 1, bool(numpy.any(self.place_probabilities))
        lines = ["rank  " + "part  " * several + "likely  score   rotation  visible  translation (mm)"]
        lines += [f"{rank:4d}  " + f"{pose.part:4d}  " * several + (f"{100 * pose.place_probability:4.0f} %" if is_known else "     -") +
                  f"  {pose.score:.3f}  {100 * pose.certainty:7.0f} %  "
                  f"{100 * pose.visible_fraction:5.0f} %  {pose.transform[0, 3]:9.3f} {pose.transform[1, 3]:9.3f} "
                  f"{pose.transform[2, 3]:9.3f}" for rank, pose in enumerate(self, 1)]
        return "\n".join(lines if self.rows else lines + ["      no part found"])

    @property
    def data(self):
        """VTK's data object, as the filters take it."""
        data = scripting.poses_of(self.poses)
        columns = {"Rank": range(1, len(self) + 1)}
        if len(self.models) > 1:
            columns["PartId"] = [pose.part for pose in self]
        for name in ("quaternion", "score", "place_probability", "probability", "certainty", "visible_fraction", "votes", "view_id", "residual"):
            columns["".join(map(str.capitalize, name.split("_")))] = [getattr(pose, name) for pose in self]
        columns["Covariance"] = [pose.covariance.ravel("F") for pose in self]  # as the filters write it
        for name, values in columns.items():
            width = numpy.size(values) // len(self) if len(self) else WIDTHS.get(name, 1)
            data.GetPointData().AddArray(scripting.vtk_array(numpy.array(values).reshape(len(self), width), name))
        low, high = self.model.core.bounds
        fields = {"SecondsTotal": [self.seconds], "Diameter": [[model.diameter] for model in self.models]}
        if len(self.models) == 1:
            fields.update(PartBounds=[numpy.column_stack((low, high)).ravel()], PartMiddle=[self.model.core.middle])
        for name, values in fields.items():
            data.GetFieldData().AddArray(scripting.vtk_array(numpy.array(values).reshape(len(values), -1), name))
        return data

    def save(self, path):
        """Writes .csv (BOP results), .json, .detections.json (ROS 2), .txt (4x4 matrices), or .html, the page of show()."""
        name = os.fspath(path).lower()
        if name.endswith((".html", ".htm")):
            return self.notebook().save(self, path)
        if not name.endswith((".csv", ".bop", ".json", ".txt", ".poses")):
            raise Error(f"{path} was not written: poses go to .csv or .bop (BOP results), .json, .detections.json (ROS 2), .txt or .poses "
                        "(4x4 matrices), or .html (the page of show()); choose one of these extensions")
        scripting.write_with(filters.vtkMEAMPoseWriter(), self.data, path)

    def show(self):
        """Opens a page in the browser, or in a notebook below the cell: the scan and the parts in 3D, the image with their outlines,
        and of each pose what speaks for it and against it, which takes another detection. Returns the name of its file, or
        what the notebook shows."""
        return self.notebook().show(self)

    def _repr_html_(self):
        return self.notebook().cell(self)

    @staticmethod
    def notebook():
        from .report import notebook  # only now: it needs api.py
        return notebook


def calibrate(model, judged):
    """Fits what a model says of its poses to scans in which it is known which are right; returns the calibrated Model, and a
    report with `loss_before`, `loss_after` (mean logarithmic loss of a pose, nats; `after` on scans left out of the fit) and
    `classes` (of each `least` and `most` of what was said, `poses`, share that is `right`, mean said `before` and `after`), and
    `warning`, of verdicts that are likely exchanged. It takes the place of the model's calibration before.

    judged: of each scan, 5 or better a few dozen, a pair: its Detections by this model, and for each of them True (right), "turned" (a copy
    is there, and the pose is turned wrongly), False (wrong, or a second pose of a copy), or None (not known)."""
    poses = []
    for scene, (found, verdicts) in enumerate(judged):
        if len(found) != len(verdicts):
            raise Error(f"scan {scene + 1} has {len(found)} poses and {len(verdicts)} verdicts: give one for each")
        for pose, verdict in zip(found, verdicts):
            if verdict not in (True, False, None, "turned"):
                raise Error(f"a verdict is {verdict!r}, not True, 'turned', False or None")
            if verdict is not None:
                poses.append(_core.JudgedPose(pose.place_probability, pose.certainty, bool(verdict), verdict is True, scene))
    calibrated, report = _core.calibrate(model.core, poses)
    return Model(calibrated, model.file, model.mesh), report


class Diagnosis:
    """Why a part was missed at a place: `verdict` (a sentence), `main_reason` (what speaks most for the place and most against it),
    `advice` (what to change; both may be empty), `reasons` (what speaks for it and against it, the nearest other pose, a line
    each), `lost_in` (the stage; empty: it was found), `rank` (of the pose that came out there; 0: none), `part` (of several types
    the one that it is about), `pose` (4 x 4, the place, or None), `numbers` (of each a tuple: step, quantity, value, what it is
    out of or NaN), `points` (N x 3, those of the part that should be visible) and `states` (of each: "explained", "turned",
    "hidden", "not measured", "seen past", or of an edge "missing"), `unexplained` (M x 3, measured surface of the scan that goes
    on beside the part there, and is not it). `data` is the VTK data object of the points."""

    def __init__(self, data, table, beside):
        def text(name):
            return worded(data.GetFieldData().GetAbstractArray(name).GetValue(0))

        self.data = data
        self.verdict, self.main_reason, self.advice, self.reasons, self.lost_in = map(
            text, ("Verdict", "MainReason", "Advice", "Reasons", "LostIn"))
        self.rank = int(scripting.field(data, "Rank"))
        self.part = int(scripting.field(data, "PartId")) if data.GetFieldData().HasArray("PartId") else 0
        place = data.GetFieldData().GetArray("Transform")
        self.pose = vtk_to_numpy(place).reshape(4, 4).copy() if place else None
        columns = [table.GetColumnByName(name) for name in ("Step", "Quantity", "Value", "Of")]
        self.numbers = [tuple(column.GetValue(row) for column in columns) for row in range(table.GetNumberOfRows())]
        self.points, self.unexplained = (vtk_to_numpy(each.GetPoints().GetData()).copy() if each.GetNumberOfPoints() else numpy.zeros((0, 3))
                                         for each in (data, beside))
        self.states = scripting.texts(data, "StateName")

    def __repr__(self):
        return " ".join(filter(None, (self.verdict, self.main_reason, self.advice)))


@takes(settings="train", reading="read")
def train(cad, *, settings, reading):
    """Learns how a part looks from all sides; takes seconds. Returns a Model.

    cad: a .step, .iges, .stl, .obj, .ply or .off file; or a mesh: a vtkPolyData with faces, one of trimesh or Open3D, or a
    tuple of its vertices, N x 3, and its triangles, M x 3 indices of them.
    """
    mesh = inputs.mesh_of(cad, reading)
    corners = mesh.vertices * settings.scale + numpy.array(settings.offset)
    return Model(_core.train(mesh, settings.apply(_core.TrainSettings(), _core)), None if inputs.is_mesh(cad) else os.fspath(cad),
                 inputs.vtk_mesh(corners, mesh.triangles))


def load(path):
    """The model in a file that Model.save, or C++, wrote."""
    path = inputs.path_of(inputs.name_of(path, "the model has to be a file"))
    return Model(_core.load_model(path) if path.lower().endswith(".meam") else scripting.read_model(path), path)


@takes(settings="detect", sensor="sensor", reading="read")
def detect(part, scan, image=None, boundary=None, camera=None, image_camera=None, scale=1.0, cad_scale=1.0, region=None, *,
           settings, sensor, reading):
    """Finds the copies of a part in a scan; returns Detections.

    part: a Model; the file of one; or a CAD as train() takes it, which is trained every time (`cad_scale` brings it to mm). Or
    a list of these, of several types of part: `part` of each pose is its place in the list, and `of(k)` has the poses of one.
    Of poses that claim the same surface the best supported stays; parts that look alike are told apart only together.
    scan: a file (.pcd, .ply, a text of points, or a depth image with its `camera`), an array H x W x 3 of points in the sensor's frame (x
    right, y down, z the way it looks; NaN: not measured), an array N x 3 with a `boundary`, an array H x W of depths with their
    `camera` (0, NaN, and 65535 of 16 bits: not measured), or VTK's data object. Points are taken in single precision.
    image: a file or an array H x W (grey) or H x W x 3 (colours) of bytes, from the top; where the scan has none. It has a
    pixel for each point, unless `image_camera`, a calibration file, says which other camera took it.
    boundary: edge points, where they are known: a file, an array N x 3, or VTK's data object.
    camera: the calibration file of the sensor, or of an array of depths its camera matrix, 3 x 3; brings points alone back
    onto its pixels. scale: brings lengths to mm.
    region: where parts are looked for: six numbers, from and to along x, y and z of the scan, mm; or a mask, an array H x W of
    flags or an image file of the scan's size that is not black there. Parts whose middle lies elsewhere are not looked for.
    """
    given = {"scan": scan, "image": image, "boundary": boundary, "camera": camera, "image_camera": image_camera, "scale": scale,
             "region": region, **sensor.differing()}
    seen = inputs.scan_of(scan, camera, scale, image, boundary, image_camera, region, sensor.viewpoint)
    models = models_of(part, cad_scale, settings, reading)
    found = _core.detect([model.core for model in models], seen, settings.apply(_core.DetectSettings(), _core))
    if found.warning:
        warnings.warn(worded(found.warning), stacklevel=3)
    return Detections(found, models, given, {"cad_scale": cad_scale, **reading.differing()}, settings)


def is_model(part):
    """Whether it is a trained model, or the name of the file of one."""
    return isinstance(part, (Model, vtkPartitionedDataSetCollection)) or \
        isinstance(part, (str, os.PathLike)) and os.fspath(part).lower().endswith(scripting.MODELS)


def models_of(part, cad_scale, settings, reading):
    """The trained models of a part, or of several."""
    several = isinstance(part, (list, tuple)) and not inputs.is_mesh(part)
    parts, cad_scale = part if several else [part], checked_scale("cad_scale", cad_scale)
    given = "solid" if reading.solid else "cad_scale" if cad_scale != 1.0 else None
    if given and all(map(is_model, parts)):
        raise Error(f"{given} is of a CAD file: leave it out, a trained model has its own")
    return [part_of(each, cad_scale, settings, reading) for each in parts]


def part_of(part, scale, settings, reading, offset=(0.0, 0.0, 0.0)):
    """The trained model."""
    if isinstance(part, Model):
        return part
    if isinstance(part, vtkPartitionedDataSetCollection):
        return Model(part)
    if is_model(part):
        return load(part)
    if not inputs.is_mesh(part):
        inputs.name_of(part, "the part has to be a Model, a file, a mesh, or two arrays, vertices and triangles")
    return train(part, scale=scale, offset=offset, solid=reading.solid, **{name: settings.values[name] for name in ("preset", "features", "seed")})


@takes(settings="detect", sensor="sensor", reading="read")
def why(part, scan, at=None, pose=None, fit=False, image=None, boundary=None, camera=None, image_camera=None, scale=1.0,
        cad_scale=1.0, region=None, part_id=None, *, settings, sensor, reading):
    """Tells why a part of a scan was missed: which step lost it, and what to change.

    part, scan, image, boundary, cameras, scales and region: as detect() takes them. at: a point of the scan on the part, three
    numbers, mm; or pose: where the part lies, 4 x 4, or several, N x 4 x 4. fit: poses that are nearly right, laid by hand,
    are first fitted to the scan. Returns a Diagnosis; of several poses a list, which takes one detection.
    pose may also be VTK's data object of poses that came out, found.data: a list tells why they did. With `at`, too, it is about that
    one of them whose surface is at the point, as found.why() has it.
    part_id: of a list of parts the one that is asked about, as `part` of found.why().
    """
    came_out = pose if isinstance(pose, vtkDataObject) else None
    if (at is None) == (pose is None) and not (came_out and at is not None):
        raise Error("give either at, a point on the part, or pose, where the part lies")
    seen = inputs.scan_of(scan, camera, scale, image, boundary, image_camera, region, sensor.viewpoint)
    diagnosis = filters.vtkMEAMPoseDiagnosis()
    for model in models_of(part, cad_scale, settings, reading):
        diagnosis.AddInputDataObject(model.data)
    diagnosis.SetPartId(-1 if part_id is None else part_id)
    for port, data in enumerate(inputs.to_vtk(seen), 1):
        diagnosis.SetInputDataObject(port, data)
    diagnosis.SetRegion(*(regions.of(region)[0] or regions.EVERYWHERE))
    if isinstance(image, vtkDataObject):
        diagnosis.SetInputDataObject(3, image)
    if image_camera is not None:
        diagnosis.SetCameraFile(os.fspath(image_camera))
    settings.set(diagnosis)
    scripting.set_viewpoint(diagnosis, sensor.viewpoint, scale)
    diagnosis.SetFit(fit)
    if at is not None:
        try:
            place = numpy.asarray(at, float)
        except (TypeError, ValueError):
            place = numpy.zeros(0)
        if place.shape != (3,) or not numpy.isfinite(place).all():
            raise Error(f"the point has to be three finite numbers, not {at!r}")
        diagnosis.SetInputDataObject(4, came_out)
        diagnosis.SetPlaceToPoint()
        diagnosis.SetPosition(*place)
        return diagnosed(diagnosis)
    transforms = scripting.column(came_out, "Transform", 4, 4) if came_out else numpy.asarray(pose, float)
    if transforms.ndim not in (2, 3) or transforms.shape[-2:] != (4, 4):
        raise Error(f"the pose has to be a matrix of 4 x 4, or several, not an array with the shape {transforms.shape}")
    diagnosis.SetInputDataObject(4, came_out or scripting.poses_of(transforms.reshape(-1, 4, 4)))
    diagnosis.SetPlaceToRankedPose()
    said = []
    for rank in range(1, transforms.size // 16 + 1):
        diagnosis.SetRankOfPose(rank)
        said.append(diagnosed(diagnosis))
    return said if transforms.ndim == 3 else said[0]


def diagnosed(filter):
    scripting.update(filter)
    data = vtkPolyData()
    data.ShallowCopy(filter.GetOutput())
    return Diagnosis(data, filter.GetOutputDataObject(1), filter.GetOutputDataObject(4))
