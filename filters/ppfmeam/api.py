# SPDX-License-Identifier: BSD-3-Clause
"""train(), detect() and why(): files or NumPy arrays in, NumPy arrays out. What goes wrong is raised as ppfmeam.Error; what
may be wrong is a warning."""
import os

import numpy
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkPoints
from vtkmodules.vtkCommonDataModel import (vtkDataObject, vtkImageData, vtkPartitionedDataSetCollection, vtkPolyData,
                                           vtkStructuredGrid)

from . import Error, filters, scripting

MODELS = (".meam", ".vtpc")
DEPTH_IMAGES = (".png", ".tif", ".tiff")


class Model:
    """What training makes of a part and detection needs to know of it. `data` is the VTK data object."""

    def __init__(self, data):
        self.data = data

    @property
    def diameter(self):
        """The largest distance between two points of the part, mm."""
        return scripting.field(self.data, "Diameter")

    def save(self, path):
        """Writes NAME.meam, one file, which C++ and ParaView read; or NAME.vtpc."""
        scripting.require_folder_of(path)
        scripting.write_model(self.data, os.fspath(path))


class Detections:
    """The poses found, best first: `poses` (N x 4 x 4, each takes the part's coordinates to the scan's, mm), `scores` (the
    share of what should be visible that is there), `probabilities` (that a pose is right), `certainties` (that no
    near-symmetry turns it) and `visible_fractions`, all from 0 to 1; `seconds`, without training; `scan_quality`, what an
    organized scan shows of its sensor, by name as vtkMEAMSceneEdgeExtraction has it. `data` is the VTK data object with all
    that is known."""

    def __init__(self, data):
        self.data = data
        self.poses = scripting.column(data, "Transform", 4, 4)
        self.scores = scripting.column(data, "Score")
        self.probabilities = scripting.column(data, "Probability")
        self.certainties = scripting.column(data, "Certainty")
        self.visible_fractions = scripting.column(data, "VisibleFraction")
        self.seconds = scripting.field(data, "SecondsTotal") - scripting.field(data, "SecondsTraining")
        quality = data.GetFieldData().GetArray("ScanQuality")
        self.scan_quality = {quality.GetComponentName(i): quality.GetComponent(0, i)
                             for i in range(quality.GetNumberOfComponents())} if quality else {}

    def __len__(self):
        return len(self.poses)

    def save(self, path):
        """Writes .csv (BOP results), .json, or .txt (4x4 matrices)."""
        scripting.write_with(filters.vtkMEAMPoseWriter(), self.data, path)


class Diagnosis:
    """Why a part was missed at a place: `verdict` (a sentence), `advice` (what to change; may be empty), `lost_in` (the stage;
    empty: it was found), `rank` (of the pose that came out there; 0: none), `pose` (4 x 4, the place, or None), `numbers` (of
    each a tuple: step, quantity, value, what it is out of or NaN), `points` (N x 3, those of the part that should be visible)
    and `states` (of each: "matched", "turned", "hidden", "not measured" or "violated"). `data` is the VTK data object of the
    points."""

    def __init__(self, data, table):
        def text(name):
            return data.GetFieldData().GetAbstractArray(name).GetValue(0)

        self.data = data
        self.verdict, self.advice, self.lost_in = text("Verdict"), text("Advice"), text("LostIn")
        self.rank = int(scripting.field(data, "Rank"))
        place = data.GetFieldData().GetArray("Transform")
        self.pose = vtk_to_numpy(place).reshape(4, 4).copy() if place else None
        columns = [table.GetColumnByName(name) for name in ("Step", "Quantity", "Value", "Of")]
        self.numbers = [tuple(column.GetValue(row) for column in columns) for row in range(table.GetNumberOfRows())]
        count = data.GetNumberOfPoints()
        self.points = vtk_to_numpy(data.GetPoints().GetData()).copy() if count else numpy.zeros((0, 3))
        self.states = scripting.texts(data, "StateName")


def train(cad, scale=1.0, offset=(0.0, 0.0, 0.0), preset="recommended", features="both"):
    """Learns how a part looks from all sides; takes seconds. `cad`: a .stl, .obj, .ply or .off file, or a vtkPolyData with
    faces. `scale` brings its lengths to mm: 1000 for metres; `offset`, mm, is added after it. features: which points make pairs, edges
    (flat, thin and ribbed parts), surface (smooth, round and thick ones), or both. preset: recommended, paper, or what the
    paper compares itself with: without-meam, ppf, b2b."""
    if isinstance(cad, vtkDataObject):
        mesh = scripting.prepare_mesh(cad, offset, scale)
    else:
        mesh = scripting.read_mesh(os.fspath(cad), offset, scale)
    return Model(scripting.train(mesh, chosen("preset", preset, scripting.PRESETS), chosen("features", features, scripting.FEATURES)))


def load(path):
    """The model in a file that Model.save, or C++, wrote."""
    return Model(scripting.read_model(os.fspath(path)))


def detect(part, scan, image=None, boundary=None, camera=None, image_camera=None, scale=1.0, cad_scale=1.0, poses=5,
           probability=0.0, image_edges=True, depth_edges=True, creases=True, references=0.0, preset="recommended",
           features="both", seed=1, threads=0, present=False):
    """Finds the copies of a part in a scan.

    part: a Model; the file of one; or a CAD as train() takes it, which is trained every time (`cad_scale` brings it to mm).
    scan: a file (.pcd, .ply, or a depth image with its `camera`), an array H x W x 3 of points in the sensor's frame (x
    right, y down, z the way it looks; NaN: not measured), an array N x 3 with a `boundary`, or VTK's data object.
    image: a file or an array H x W (grey) or H x W x 3 (colours) of bytes, from the top; where the scan has none. It has a
    pixel for each point, unless `image_camera`, a calibration file, says which other camera took it.
    boundary: edge points, where they are known: a file, an array N x 3, or VTK's data object.
    camera: the calibration file of the sensor; brings a .ply back onto its pixels. scale: brings lengths to mm.
    poses: so many of the best ones, 0 for all; probability: of each at least, 0 to 1. present: the part is known to be in the
    scan, as in a cell that counts what it takes: no pose is less likely because it may be missing.
    image_edges, depth_edges, creases: where edges are looked for, the last two not with preset paper. references: the share
    of points that vote, 0: as many as the scene needs, by how many copies its edges would make. preset: recommended, paper, without-meam, ppf or b2b, the one that the part was trained with; the others than
    recommended have features of their own. features: edges, surface or both, as train() has them. threads: 0 for all cores.
    """
    estimation = filters.vtkMEAMPoseEstimation()
    set_inputs(estimation, part, scan, image, boundary, camera, image_camera, scale, cad_scale, poses, probability, image_edges,
               depth_edges, creases, references, preset, features, seed, threads, present)
    return Detections(scripting.update(estimation).GetOutput())


def why(part, scan, at=None, pose=None, fit=False, **options):
    """Tells why a part of a scan was missed: which step lost it, and what to change.

    part, scan and options: as detect() has them. at: a point of the scan on the part, three numbers, mm; or pose: where the
    part lies, 4 x 4, or several, N x 4 x 4. fit: poses that are nearly right, laid by hand, are first fitted to the scan.
    Returns a Diagnosis; of several poses a list, which takes one detection.
    """
    if (at is None) == (pose is None):
        raise Error("give either at, a point on the part, or pose, where the part lies")
    diagnosis = filters.vtkMEAMPoseDiagnosis()
    set_inputs(diagnosis, part, scan, **options)
    diagnosis.SetFit(fit)
    if pose is None:
        place = numpy.asarray(at, float)
        if place.shape != (3,) or not numpy.isfinite(place).all():
            raise Error(f"the point has to be three finite numbers, not {at!r}")
        diagnosis.SetPlaceToPoint()
        diagnosis.SetPosition(*place)
        return diagnosed(diagnosis)
    transforms = numpy.asarray(pose, float)
    if transforms.ndim not in (2, 3) or transforms.shape[-2:] != (4, 4):
        raise Error(f"the pose has to be a matrix of 4 x 4, or several, not an array with the shape {transforms.shape}")
    diagnosis.SetInputDataObject(4, scripting.poses_of(transforms.reshape(-1, 4, 4)))
    diagnosis.SetPlaceToRankedPose()
    found = []
    for rank in range(1, transforms.size // 16 + 1):
        diagnosis.SetRankOfPose(rank)
        found.append(diagnosed(diagnosis))
    return found if transforms.ndim == 3 else found[0]


def diagnosed(filter):
    scripting.update(filter)
    data = vtkPolyData()
    data.ShallowCopy(filter.GetOutput())
    return Diagnosis(data, filter.GetOutputDataObject(1))


def set_inputs(filter, part, scan, image=None, boundary=None, camera=None, image_camera=None, scale=1.0, cad_scale=1.0, poses=5,
               probability=0.0, image_edges=True, depth_edges=True, creases=True, references=0.0, preset="recommended",
               features="both", seed=1, threads=0, present=False):
    """The inputs and properties of a filter that detects."""
    filter.SetInputDataObject(part_of(part, cad_scale))
    filter.SetInputDataObject(1, scan_of(scan, camera, scale))
    if boundary is not None:
        filter.SetInputDataObject(2, points_of(boundary, scale, "boundary"))
    if image is not None:
        filter.SetInputDataObject(3, image_of(image))
    if image_camera is not None:
        scripting.require_file(os.fspath(image_camera))
        filter.SetCameraFile(os.fspath(image_camera))
    scripting.set_preset(filter, chosen("preset", preset, scripting.PRESETS))
    scripting.set_choice(filter, "Features", chosen("features", features, scripting.FEATURES))
    for name, value in dict(MaximumNumberOfPoses=poses, MinimumProbability=probability, PartIsPresent=present, ImageEdges=image_edges,
                            DepthEdges=depth_edges, Creases=creases, ReferenceShare=references, Seed=seed,
                            NumberOfThreads=threads).items():
        getattr(filter, "Set" + name)(value)


def chosen(name, value, choices):
    if value not in choices:
        raise Error(f"{name} has to be one of {', '.join(map(repr, choices))}, not {value!r}")
    return value


def part_of(part, scale):
    """The trained model, or the clean mesh in mm."""
    if isinstance(part, Model):
        return part.data
    if isinstance(part, vtkPartitionedDataSetCollection):
        return part
    if isinstance(part, vtkDataObject):
        return scripting.prepare_mesh(part, scale=scale)
    path = os.fspath(part)
    if path.lower().endswith(MODELS):
        return scripting.read_model(path)
    return scripting.read_mesh(path, scale=scale)


def scan_of(scan, camera, scale):
    if isinstance(scan, (vtkDataObject, numpy.ndarray)):
        return points_of(scan, scale, "scan")
    path = os.fspath(scan)
    camera = camera if camera is None else os.fspath(camera)
    if path.lower().endswith(DEPTH_IMAGES):
        if camera is None:
            raise Error(f"{path}: a depth image needs the calibration of its camera")
        return scripting.read_depth(path, camera)
    return scripting.read_scan(path, scale, camera)


def points_of(points, scale, what):
    """Points as VTK has them: those of a grid, when the array has rows and columns."""
    if isinstance(points, vtkDataObject):
        return scripting.scaled(points, scale, f"the {what}")
    if not isinstance(points, numpy.ndarray):
        return scripting.read(os.fspath(points), scale)
    if points.ndim not in (2, 3) or points.shape[-1] != 3 or points.dtype.kind != "f":
        raise Error(f"the {what} has to be an array of floats, H x W x 3 or N x 3, not {points.dtype} with the shape "
                    f"{points.shape}")
    kind = numpy.float64 if points.dtype == numpy.float64 else numpy.float32
    coordinates = vtkPoints()
    coordinates.SetData(numpy_to_vtk(numpy.ascontiguousarray(points.reshape(-1, 3), kind), deep=True))
    if points.ndim == 3:
        data = vtkStructuredGrid()
        data.SetDimensions(points.shape[1], points.shape[0], 1)
    else:
        data = vtkPolyData()
    data.SetPoints(coordinates)
    return scripting.scaled(data, scale, f"the {what}")


def image_of(image):
    if isinstance(image, vtkDataObject):
        return image
    if not isinstance(image, numpy.ndarray):
        return scripting.read_image(os.fspath(image))
    if image.dtype != numpy.uint8 or image.ndim not in (2, 3) or image.shape[2:] not in ((), (1,), (3,), (4,)):
        raise Error(f"the image has to be an array of bytes, H x W or H x W x 3, not {image.dtype} with the shape "
                    f"{image.shape}")
    data = vtkImageData()
    data.SetDimensions(image.shape[1], image.shape[0], 1)
    pixels = numpy.ascontiguousarray(image[::-1]).reshape(image.shape[0] * image.shape[1], -1)  # VTK's rows go upwards
    data.GetPointData().SetScalars(numpy_to_vtk(pixels, deep=True))
    return data
