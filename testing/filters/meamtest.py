# SPDX-License-Identifier: BSD-3-Clause
"""What the filter tests share: error collection, small inputs, a trained part, comparisons. Not a test."""
import csv
import math
import os
import sys
import tempfile

import numpy
from vtkmodules.util.numpy_support import numpy_to_vtk
from vtkmodules.vtkCommonCore import vtkDoubleArray, vtkPoints
from vtkmodules.vtkCommonDataModel import vtkCellArray, vtkImageData, vtkPartitionedDataSetCollection, vtkPolyData, vtkStructuredGrid
from vtkmodules.vtkCommonTransforms import vtkTransform
from vtkmodules.vtkFiltersGeneral import vtkTransformFilter
from vtkmodules.vtkIOImage import vtkPNGWriter

from ppfmeam import filters

sys.path.append(os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "evaluation"))  # chains and the like

SKIPPED = 77
LONG = "--long" in sys.argv  # all of it, not a small part


def check(condition, message):
    """An assertion that also holds under python3 -O."""
    if not condition:
        raise AssertionError(message)


def skip(message):
    print("skipped:", message)
    sys.exit(SKIPPED)


class Folder:
    """A temporary folder: folder(name) is the path of a file in it, which is written when there is a content."""

    def __init__(self):
        self.folder = tempfile.TemporaryDirectory()
        self.name = self.folder.name

    def __call__(self, name, content=None):
        path = os.path.join(self.name, name)
        if content is not None:
            os.makedirs(os.path.dirname(path), exist_ok=True)
            write(path, content)
        return path

    def text(self, name):
        return read(self(name))


def write(path, content):
    """Text, or bytes."""
    with open(path, "wb") as file:
        file.write(content.encode() if isinstance(content, str) else content)


def read(path):
    with open(path, encoding="utf-8") as file:
        return file.read()


def rows_of(path):
    """Of a CSV file."""
    return list(csv.DictReader(read(path).splitlines()))


def concrete_classes():
    """Ours that are algorithms."""
    for name in dir(filters):
        kind = getattr(filters, name)
        if name.startswith("vtkMEAM") and hasattr(kind, "GetOutputPort"):
            try:
                kind()
            except (TypeError, NotImplementedError):
                continue  # abstract
            yield kind


class Errors:
    """Collects what an algorithm and its pipeline report on the error channel."""
    EVENT = "ErrorEvent"

    def __init__(self, algorithm):
        self.algorithm, self.messages = algorithm, []

        def collect(caller, event, text):
            self.messages.append(text)

        collect.CallDataType = "string0"
        for source in (algorithm, algorithm.GetExecutive()):
            source.AddObserver(self.EVENT, collect)

    def __str__(self):
        return "\n".join(self.messages)


class Warnings(Errors):
    """Collects what an algorithm warns of, and keeps it from the console."""
    EVENT = "WarningEvent"


def run(algorithm):
    """Brings the algorithm up to date; fails on any error. Returns the output."""
    errors = Errors(algorithm)
    algorithm.Update()
    check(not errors.messages, f"{algorithm.GetClassName()}: {errors}")
    return algorithm.GetOutputDataObject(0)


def is_empty(data):
    if data.IsA("vtkPartitionedDataSetCollection"):
        return data.GetNumberOfPartitionedDataSets() == 0
    if data.IsA("vtkTable"):
        return data.GetNumberOfRows() == 0
    return data.GetNumberOfPoints() == 0 and data.GetNumberOfCells() == 0


def fails(algorithm, *words):
    """The algorithm must report an error with all of these words and leave its output empty."""
    errors = Errors(algorithm)
    algorithm.Update()
    text = str(errors)
    check(text, f"{algorithm.GetClassName()} reported nothing, expected: {words}")
    for word in words:
        check(word.lower() in text.lower(), f"{algorithm.GetClassName()} does not say '{word}': {text}")
    output = algorithm.GetOutputDataObject(0)
    check(output is None or is_empty(output), f"{algorithm.GetClassName()} failed but its output is not empty")


def cloud(points, **arrays):
    """vtkPolyData of vertices with point arrays given as lists of tuples or numbers."""
    data = vtkPolyData()
    coordinates = vtkPoints()
    vertices = vtkCellArray()
    for i, point in enumerate(points):
        coordinates.InsertNextPoint(point)
        vertices.InsertNextCell(1, [i])
    data.SetPoints(coordinates)
    data.SetVerts(vertices)
    for name, values in arrays.items():
        array = vtkDoubleArray()
        array.SetName(name)
        rows = [v if isinstance(v, (tuple, list)) else (v,) for v in values]
        array.SetNumberOfComponents(len(rows[0]) if rows else 1)
        for value in rows:
            array.InsertNextTuple(value)
        data.GetPointData().AddArray(array)
    return data


def mesh(points, faces):
    """vtkPolyData of polygons."""
    data = vtkPolyData()
    coordinates = vtkPoints()
    for point in points:
        coordinates.InsertNextPoint(point)
    polys = vtkCellArray()
    for face in faces:
        polys.InsertNextCell(len(face), face)
    data.SetPoints(coordinates)
    data.SetPolys(polys)
    return data


def box(x, y, z, origin=(0, 0, 0)):
    """A closed box as twelve triangles that face outwards."""
    ox, oy, oz = origin
    points = [(ox + i * x, oy + j * y, oz + k * z) for k in (0, 1) for j in (0, 1) for i in (0, 1)]
    quads = [(0, 2, 3, 1), (4, 5, 7, 6), (0, 1, 5, 4), (2, 6, 7, 3), (0, 4, 6, 2), (1, 3, 7, 5)]
    return mesh(points, [t for a, b, c, d in quads for t in ((a, b, c), (a, c, d))])


def bracket():
    """An L of 40 x 25 mm, 6 mm thick, 15 mm wide: no rotation takes it to itself. Its caps are hexagons."""
    outline = [(0, 0), (40, 0), (40, 6), (6, 6), (6, 25), (0, 25)]
    n = len(outline)
    corners = [(x, y, z) for z in (0, 15) for x, y in outline]
    faces = [list(range(n - 1, -1, -1)), list(range(n, 2 * n))]
    faces += [[i, (i + 1) % n, n + (i + 1) % n, n + i] for i in range(n)]
    return mesh(corners, faces)


def plate():
    """The sample part that is soon trained."""
    return run(connect(filters.vtkMEAMSamplePartSource(), Part=filters.vtkMEAMSamplePartSource.HolePlate))


def scaled(data, factor):
    """Data in another unit."""
    transform = vtkTransform()
    transform.Scale(factor, factor, factor)
    return run(connect(vtkTransformFilter(), data, Transform=transform))


def connect(algorithm, *inputs, **properties):
    """Connects the output of each input to the port of its place, where it is not None, and sets the properties."""
    for port, source in enumerate(inputs):
        if source is not None and source.IsA("vtkAlgorithm"):
            algorithm.SetInputConnection(port, source.GetOutputPort())
        elif source is not None:
            algorithm.SetInputDataObject(port, source)
    for name, value in properties.items():
        getattr(algorithm, "Set" + name)(value)
    return algorithm


class Trained:
    """The offline phase: every step, and the model."""

    def __init__(self, part):
        self.prepared = connect(filters.vtkMEAMMeshPreparation(), part)
        self.samples = connect(filters.vtkMEAMSurfaceSampling(), self.prepared)
        self.views = connect(filters.vtkMEAMVisibilityExtraction(), self.samples)
        self.edges = connect(filters.vtkMEAMBoundaryExtraction(), self.views)
        self.tangents = connect(filters.vtkMEAMTangentEstimation(), self.edges)
        self.symmetries = connect(filters.vtkMEAMSymmetryDetection(), self.samples)
        self.model = connect(filters.vtkMEAMHashing(), self.tangents, self.symmetries)


class MovedView:
    """What a sensor sees of a trained part: one view's edges and surface, moved by a known motion."""

    def __init__(self, trained, view=0):
        motion = vtkTransform()
        motion.Translate(110.0, -35.0, 60.0)
        motion.RotateWXYZ(71.0, 0.3, -0.5, 0.8)
        matrix = motion.GetMatrix()
        self.transform = tuple(matrix.GetElement(r, c) for r in range(4) for c in range(4))
        self.edges = self.moved(partitions(run(trained.edges))[view][1], motion)
        self.surface = self.moved(partitions(run(trained.views))[view][1], motion)
        direction = field(partitions(run(trained.edges))[view][1], "ViewDirection")[0]
        self.looking = [-c for c in motion.TransformVector(direction)]

    @staticmethod
    def moved(data, motion):
        return run(connect(vtkTransformFilter(), data, Transform=motion))

    def shifted(self, x=0.0, y=0.0, z=0.0, turned=False):
        """The true pose, moved; `turned`: upside down about the middle of the bracket (y -> 25 - y, z -> 15 - z)."""
        t = list(self.transform)
        for row in range(3) if turned else ():
            t[4 * row + 3] += 25 * t[4 * row + 1] + 15 * t[4 * row + 2]
            t[4 * row + 1] *= -1
            t[4 * row + 2] *= -1
        for k, d in zip((3, 7, 11), (x, y, z)):
            t[k] += d
        return tuple(t)


def trained_bracket():
    """The bracket trained, its model, what a sensor sees of it, and that one's edges with tangents."""
    trained = Trained(bracket())
    model, scene = run(trained.model), MovedView(trained)
    return trained, model, scene, run(connect(filters.vtkMEAMTangentEstimation(), scene.edges, model))


def collection(*pieces, **fields):
    """vtkPartitionedDataSetCollection of (name, data) with numbers as field data."""
    result = vtkPartitionedDataSetCollection()
    for i, (name, data) in enumerate(pieces):
        result.SetPartition(i, 0, data)
        result.GetMetaData(i).Set(result.NAME(), name)
    set_fields(result, **fields)
    return result


def set_fields(data, **fields):
    """Field data of one tuple each, from a number or a tuple."""
    for name, value in fields.items():
        array = vtkDoubleArray()
        array.SetName(name)
        values = value if isinstance(value, (tuple, list)) else (value,)
        array.SetNumberOfComponents(len(values))
        array.InsertNextTuple(values)
        data.GetFieldData().AddArray(array)
    return data


def poses(*transforms):
    """Poses as they come from a file: nothing but `Transform`."""
    return cloud([(t[3], t[7], t[11]) for t in transforms], Transform=transforms)


def image(width=4, height=3):
    """Something that is of the wrong type for most inputs."""
    data = vtkImageData()
    data.SetDimensions(width, height, 1)
    return data


def picture(rows, dtype="uint8"):
    """An image of rows of pixels, from the top left; a pixel is a number or a tuple."""
    pixels = numpy.asarray(rows, dtype)[::-1]
    data = image(pixels.shape[1], pixels.shape[0])
    data.GetPointData().SetScalars(numpy_to_vtk(pixels.reshape(pixels.shape[0] * pixels.shape[1], -1), deep=True))
    return data


def png(path, rows, *dtype):
    """Writes it as a PNG file. Returns the path."""
    return written(path, picture(rows, *dtype), vtkPNGWriter)


def grid(width, height, places, layers=1):
    """An organized scan."""
    data, coordinates = vtkStructuredGrid(), vtkPoints()
    coordinates.SetData(numpy_to_vtk(numpy.asarray(places, "float32"), deep=True))
    data.SetDimensions(width, height, layers)
    data.SetPoints(coordinates)
    return data


def written(path, data, kind):
    """Writes the data with a writer of that kind. Returns the path."""
    connect(kind(), data, FileName=path).Write()
    return path


def tuples(data, name):
    """A point array as a list of tuples."""
    array = data.GetPointData().GetArray(name)
    check(array is not None, f"the output has no point array {name}")
    return [array.GetTuple(i) for i in range(array.GetNumberOfTuples())]


def field(data, name):
    """The values of a field data array."""
    array = data.GetFieldData().GetArray(name)
    check(array is not None, f"no field data {name}")
    return [array.GetTuple(i) for i in range(array.GetNumberOfTuples())]


def text(data, name):
    """The string of a field data array."""
    return data.GetFieldData().GetAbstractArray(name).GetValue(0)


def texts(data, name):
    """A point array of strings."""
    array = data.GetPointData().GetAbstractArray(name)
    return [array.GetValue(i) for i in range(array.GetNumberOfValues())]


def points(data):
    return [data.GetPoint(i) for i in range(data.GetNumberOfPoints())]


def partitions(collection):
    """Name and data of each partition."""
    result = []
    for i in range(collection.GetNumberOfPartitionedDataSets()):
        info = collection.GetMetaData(i)
        name = info.Get(collection.NAME()) if info else None
        pieces = collection.GetPartitionedDataSet(i)
        result.append((name, pieces.GetPartition(0) if pieces.GetNumberOfPartitions() else None))
    return result


def distance(a, b):
    return math.dist(a, b)


def pose_error(a, b):
    """Distance in mm of the origins and rotation in degrees between two row-major 4 x 4 transforms."""
    trace = sum(a[4 * i + k] * b[4 * i + k] for i in range(3) for k in range(3))
    angle = math.degrees(math.acos(max(-1.0, min(1.0, 0.5 * (trace - 1.0)))))
    return math.dist((a[3], a[7], a[11]), (b[3], b[7], b[11])), angle


def is_rotation(transform):
    """Whether the rows of a row-major 4 x 4 transform are at right angles and unit to 1e-9."""
    rows = [transform[4 * i:4 * i + 3] for i in range(3)]
    return all(abs(sum(x * y for x, y in zip(rows[i], rows[k])) - (i == k)) < 1e-9 for i in range(3) for k in range(3))


def close(a, b, tolerance=1e-5):
    return len(a) == len(b) and all(abs(x - y) <= tolerance for x, y in zip(a, b))
