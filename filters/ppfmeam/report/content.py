# SPDX-License-Identifier: BSD-3-Clause
"""What a page shows of a scan and the parts that were found in it, as plain values for JSON: coordinates in 16 bits, pictures as
JPEG, both in base64."""
import base64

import numpy
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkCommonDataModel import vtkPolyData
from vtkmodules.vtkFiltersCore import vtkPolyDataNormals, vtkQuadricDecimation, vtkTriangleFilter
from vtkmodules.vtkIOImage import vtkJPEGWriter

from .. import filters, scripting
from .markup import LIKELY
from .outlines import outlines
from .projection import Fitted, FromAbove, Pinhole

MOST_POINTS = 350000  # of a scan: 3 MB, finer than a screen shows them
MOST_TRIANGLES = 20000  # of a part: 1 MB, and a graphics card of a laptop turns a hundred of them
MOST_PIXELS = 1600  # along the picture's longer side
QUALITY = 85  # of its JPEG
CREASE = 30  # degrees between faces that are shaded as one
STATES = {"explained": "#00d9d9", "turned": "#f2d9a6", "hidden": "#8c5c33", "not measured": "#bfb3ff",
          "seen past": "#ff00d9", "missing": "#0d0d0d", "unexplained": "#b3ff1a"}  # as in ParaView
STRAY = 0.2, 99.8  # percentiles
FLOOR = 0.1  # share of the depths that the farthest surface has
AWAY = 0.3  # share of the largest distance that nothing is nearer than to a sensor; above a floor there are points at 0
FARTHEST = 1.0  # what lies farther outside of the scan's bulk than this share of it is left out: it would make the rest small


def base64_of(values, kind):
    """Little-endian numbers of a kind such as "<u2"."""
    return base64.b64encode(numpy.ascontiguousarray(values, kind).tobytes()).decode()


def quantized(points):
    """Coordinates as shares of their box, in 16 bits."""
    low, high = (points.min(axis=0), points.max(axis=0)) if len(points) else (numpy.zeros(3), numpy.zeros(3))
    step = numpy.maximum((high - low) / 65535, 1e-9)
    return {"count": len(points), "low": low.tolist(), "step": step.tolist(),
            "positions": base64_of(numpy.rint((points - low) / step), "<u2")}


def points_of(data):
    return vtk_to_numpy(data.GetPoints().GetData()).astype(float)


def triangles_of(data):
    return vtk_to_numpy(data.GetPolys().GetConnectivityArray()).reshape(-1, 3)


class Part:
    """A type of part: its name, and its mesh or, of a trained model, the points of its surface."""

    def __init__(self, name, shape, most=MOST_TRIANGLES):
        self.name, self.mesh = name, None
        if shape.GetNumberOfPolys():
            faces = vtkTriangleFilter()
            faces.SetInputData(shape)
            faces.PassLinesOff()
            faces.PassVertsOff()
            self.mesh = scripting.update(faces).GetOutput()
            if self.mesh.GetNumberOfPolys() > most:
                fewer = vtkQuadricDecimation()
                fewer.SetInputData(self.mesh)
                fewer.SetTargetReduction(1 - most / self.mesh.GetNumberOfPolys())
                self.mesh = scripting.update(fewer).GetOutput()
        self.points = points_of(self.mesh or shape)

    def copy(self, transform):
        """Its corners at a pose, and its triangles."""
        return self.points @ transform[:3, :3].T + transform[:3, 3], triangles_of(self.mesh) if self.mesh else None

    def content(self):
        low, high = self.points.min(axis=0), self.points.max(axis=0)
        told = {"name": self.name, "middle": ((low + high) / 2).tolist(), "size": (high - low).tolist()}
        if not self.mesh:
            return {**told, **quantized(self.points)}
        normals = vtkPolyDataNormals()
        normals.SetInputData(self.mesh)
        normals.SetFeatureAngle(CREASE)
        mesh = scripting.update(normals).GetOutput()
        directions = vtk_to_numpy(mesh.GetPointData().GetNormals())
        return {**told, **quantized(points_of(mesh)), "normals": base64_of(numpy.rint(127 * directions), "<i1"),
                "triangles": base64_of(triangles_of(mesh), "<u4")}


def gripper(rank, possible, vertices, triangles):
    """The gripper that takes a pose of this rank: its corners, of each triangle its own, so that faces are flat."""
    return {"rank": rank, "possible": bool(possible), **quantized(numpy.asarray(vertices, float)[numpy.asarray(triangles).ravel()])}


class Seen:
    """A scan for the eye: its points with their grey values or colours, and the picture beside it with its camera. `what` the
    picture is: "image", "surface" or "map"."""

    def __init__(self, scan, most=MOST_POINTS):
        points, image, camera = scan.points, scan.image, scan.image_camera
        self.is_grid = points.ndim == 3
        measured = numpy.isfinite(points).all(axis=-1)
        if not measured.any():
            raise scripting.Failure("the scan has no measured point to show")
        self.looks = numpy.array((0, 0, 1 if self.is_grid or is_before_sensor(points[measured]) else -1), float)
        if image is not None and image.shape[:2] != points.shape[:2] and camera is None:
            image = None
        shades = image if image is not None and camera is None else shaded(points, measured) if self.is_grid else None
        if image is not None and camera is not None:
            self.what, self.picture, self.projection = "image", image, Pinhole(camera, image.shape[1::-1])
        elif self.is_grid:
            self.what = "surface" if image is None else "image"
            self.picture, self.projection = shades, Fitted(points)
        else:
            self.what, self.projection = "map", FromAbove(points[measured].astype(float), self.looks)
            self.picture = self.map(points[measured].astype(float))
        self.total = int(measured.sum())
        self.points, self.shades, self.spacing = self.thinned(points, measured, shades, most)

    def thinned(self, points, measured, shades, most):
        """Every second, third... point of each row and column, or of the list, without those far away; and how far they are apart."""
        share = self.total / most
        step = max(1, int(numpy.ceil(share ** 0.5 if self.is_grid else share)))
        few = (slice(None, None, step),) * (points.ndim - 1)
        kept = points[few][measured[few]].astype(float)
        if shades is None:
            shades = heights(kept, self.looks)
        else:
            shades = shades[few][measured[few]]
        low, high = numpy.percentile(kept, (1, 99), axis=0)
        room = FARTHEST * (high - low).max()
        near = ((kept > low - room) & (kept < high + room)).all(axis=1)
        return kept[near], shades[near], self.distance(points[few], kept[near])

    def distance(self, points, kept):
        steps = numpy.linalg.norm(numpy.diff(points.astype(float), axis=1), axis=-1) if self.is_grid else numpy.array([])
        if numpy.isfinite(steps).any():
            return float(numpy.nanmedian(steps))
        across = kept[:, :2].max(axis=0) - kept[:, :2].min(axis=0)  # no two of them are neighbors of a grid
        return float((across.prod() / len(kept)) ** 0.5)

    def bulk(self):
        """The box that is shown at first: of what lies in the bin, not of the floor around it, without a few stray points."""
        depths = self.points @ self.looks
        near, far = numpy.percentile(depths, STRAY)
        return numpy.percentile(self.points[depths <= far - FLOOR * (far - near)], STRAY, axis=0)

    def map(self, points):
        pixels, depth = self.projection(points)
        columns, rows = numpy.rint(pixels).astype(int).T
        farthest_first = numpy.argsort(-depth, kind="stable")
        picture = numpy.zeros(self.projection.size[::-1], numpy.uint8)
        picture[rows[farthest_first], columns[farthest_first]] = heights(points, self.looks)[farthest_first]
        return picture

    def content(self):
        grey = self.shades.ndim == 1 or self.shades.shape[1] == 1
        low, high = self.bulk()
        return {**quantized(self.points), "low_of_bulk": low.tolist(), "high_of_bulk": high.tolist(),
                "shades": base64_of(self.shades if grey else self.shades[:, :3], "<u1"),
                "channels": 1 if grey else 3, "spacing": self.spacing, "looks": self.looks.tolist()}

    def picture_content(self, most=MOST_PIXELS):
        height, width = self.picture.shape[:2]
        return {"jpeg": jpeg(self.picture, most), "width": width, "height": height, "what": self.what}


def is_before_sensor(points):
    """Whether points that are not organized are as their sensor has them, which is the origin and looks along +z, and not above a
    floor: they are all far from the origin."""
    near, far = numpy.percentile(points[:, 2], STRAY)
    return near > AWAY * far > 0


def heights(points, looks):
    """The nearer to the sensor the brighter, 40 to 230."""
    near = -points @ looks
    low, high = numpy.percentile(near, (1, 99))
    return (40 + 190 * numpy.clip((near - low) / max(high - low, 1e-9), 0, 1)).astype(numpy.uint8)


def shaded(points, measured):
    """A grid as its surface looks with a lamp at the sensor: bright where it faces it; 0 where nothing was measured."""
    with numpy.errstate(invalid="ignore", divide="ignore"):
        along, down = numpy.gradient(points.astype(float), axis=1), numpy.gradient(points.astype(float), axis=0)
        normals = numpy.cross(along, down)
        slope = numpy.abs(normals[..., 2]) / numpy.linalg.norm(normals, axis=-1)
    shades = 50 + 180 * numpy.nan_to_num(slope, nan=0.5)
    return numpy.where(measured, shades, 0).astype(numpy.uint8)


def jpeg(pixels, most):
    """An image of bytes, H x W or H x W x 3, every second, third... pixel of a large one, as JPEG in base64."""
    step = -(-max(pixels.shape[:2]) // most)
    height, width = (size // step for size in pixels.shape[:2])
    cut = pixels[:height * step, :width * step].reshape(height, step, width, step, -1)
    small = cut.mean(axis=(1, 3)).astype(numpy.uint8)[::-1, :, :3]  # VTK's rows go upwards
    writer = vtkJPEGWriter()
    writer.SetInputData(scripting.vtk_image(small))
    writer.SetQuality(QUALITY)
    return base64.b64encode(scripting.bytes_of(writer)).decode()


def marks(diagnosis):
    """The points of the part at the place of a Diagnosis, by what the scan shows there, and those of the scan beside it."""
    of = diagnosis.states + ["unexplained"] * len(diagnosis.unexplained)
    names = sorted(set(of), key=list(STATES).index)
    states = [names.index(state) for state in of]
    return {**quantized(numpy.concatenate((diagnosis.points, diagnosis.unexplained))), "states": base64_of(states, "<u1"),
            "legend": [(f"{name}: {of.count(name)}", STATES[name]) for name in names]}


def rank_colors(poses):
    """The colour of each pose, #rrggbb, as ParaView has it."""
    if not poses.GetNumberOfPoints():
        return []
    instances, point = filters.vtkMEAMPoseInstances(), vtkPolyData()
    point.SetPoints(scripting.poses_of(numpy.eye(4)[None]).GetPoints())
    instances.SetInputDataObject(0, scripting.poses_of(scripting.column(poses, "Transform", 4, 4)))  # of whatever types
    instances.SetInputDataObject(1, point)
    colors = vtk_to_numpy(scripting.update(instances).GetOutput().GetPointData().GetArray("RankColor"))
    return ["#{:02x}{:02x}{:02x}".format(*color) for color in colors]


def drawn(projection, parts, poses):
    """The outline of each pose in the picture, as the path of an SVG."""
    transforms, of = scripting.column(poses, "Transform", 4, 4), parts_of(poses)
    places = scripting.column(poses, "PlaceProbability")
    is_likely = numpy.ones(len(of), bool) if places is None or not places.any() else places.ravel() >= LIKELY
    paths = outlines(projection, [parts[part].copy(transform) for part, transform in zip(of, transforms)], is_likely)
    return ["".join("M" + "L".join(f"{x:.1f} {y:.1f}" for x, y in line) for line in lines) for lines in paths]


def parts_of(poses):
    """The place of each pose's part among several."""
    numbers = scripting.column(poses, "PartId")
    return [0] * poses.GetNumberOfPoints() if numbers is None else numbers.astype(int).ravel().tolist()


NUMBERS = {"score": "Score", "place": "PlaceProbability", "probability": "Probability", "certainty": "Certainty",
           "visible": "VisibleFraction", "residual": "Residual"}


def pose_rows(seen, parts, poses, reasons=None):
    """Of each pose its numbers, its colour, its outline, and what speaks for it."""
    columns = {name: scripting.column(poses, array) for name, array in NUMBERS.items()}
    columns = {name: values.ravel().tolist() for name, values in columns.items() if values is not None}
    if not any(columns.get("place", ())):  # methods that have scores alone
        columns = {name: values for name, values in columns.items() if name not in ("place", "probability", "certainty")}
    shown = zip(scripting.column(poses, "Transform", 16), parts_of(poses), rank_colors(poses), drawn(seen.projection, parts, poses))
    rows = []
    for k, (transform, part, color, path) in enumerate(shown):
        rows.append({"rank": k + 1, "part": part, "color": color, "outline": path, "transform": transform.tolist(),
                     "why": reasons[k] if reasons else "",
                     **{name: values[k] for name, values in columns.items()}})
    return rows
