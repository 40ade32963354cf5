# SPDX-License-Identifier: BSD-3-Clause
"""The outlines of the parts in an image: which pixel shows which pose, by a depth buffer, and the borders of these regions."""
import numpy
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkFiltersCore import vtkFlyingEdges2D, vtkStripper

from .. import scripting

MOST_CELLS = 800  # of the buffer along its longer side: an outline is drawn finer than a screen's pixel
CLOSED = 4  # cells, half the width of the largest gaps between the points of a part without faces
AROUND = range(-CLOSED, CLOSED + 1)
DISK = numpy.array([(x, y) for x in AROUND for y in AROUND if x * x + y * y <= CLOSED * CLOSED])


class Buffer:
    """The pose that is nearest to the camera in each cell, -1 for none."""

    def __init__(self, projection):
        width, height = projection.size
        self.projection, self.scale = projection, min(1.0, MOST_CELLS / max(width, height))
        self.shape = max(1, round(height * self.scale)), max(1, round(width * self.scale))
        self.depth = numpy.full(self.shape, numpy.inf)
        self.pose = numpy.full(self.shape, -1, numpy.int32)

    def draw(self, number, corners, triangles=None):
        """Puts in a part, in the scan's frame: triangles, or without them points."""
        pixels, depth = self.projection(corners)
        seen = numpy.column_stack(((pixels + 0.5) * self.scale, depth))
        samples = seen if triangles is None else samples_of(seen[triangles], self.shape)
        samples = samples[numpy.isfinite(samples).all(axis=1)]
        if triangles is None:
            samples = (samples[:, None] + numpy.column_stack((DISK, numpy.zeros(len(DISK))))).reshape(-1, 3)
        columns, rows = numpy.floor(samples[:, :2]).astype(int).T
        inside = (columns >= 0) & (columns < self.shape[1]) & (rows >= 0) & (rows < self.shape[0])
        cells, depth = rows[inside] * self.shape[1] + columns[inside], samples[inside, 2]
        farthest_first = numpy.argsort(-depth, kind="stable")
        own = numpy.full(self.depth.size, numpy.inf)
        own[cells[farthest_first]] = depth[farthest_first]
        own = own.reshape(self.shape)
        if triangles is None:
            own[~eroded(numpy.isfinite(own))] = numpy.inf
        nearer = own < self.depth
        self.depth[nearer] = own[nearer]
        self.pose[nearer] = number

    def paths(self, number):
        """The borders of a pose's region: polylines, N x 2, in pixels of the image."""
        rows, columns = numpy.nonzero(self.pose == number)
        if not len(rows):
            return []
        low = numpy.array((columns.min(), rows.min())) - 1
        high = numpy.array((columns.max(), rows.max())) + 2
        mask = numpy.zeros((high[1] - low[1], high[0] - low[0]), numpy.float32)
        mask[rows - low[1], columns - low[0]] = 1
        contour, lines = vtkFlyingEdges2D(), vtkStripper()
        contour.SetInputData(scripting.vtk_image(smooth(mask)))
        contour.SetValue(0, 0.5)
        lines.SetInputConnection(contour.GetOutputPort())
        lines.SetMaximumLength(100000)
        lines.JoinContiguousSegmentsOn()
        drawn = scripting.update(lines).GetOutput()
        if not drawn.GetNumberOfLines():
            return []
        points = (vtk_to_numpy(drawn.GetPoints().GetData())[:, :2] + low + 0.5) / self.scale - 0.5
        order = vtk_to_numpy(drawn.GetLines().GetConnectivityArray())
        starts = vtk_to_numpy(drawn.GetLines().GetOffsetsArray())
        return [points[order[a:b]] for a, b in zip(starts, starts[1:])]


def eroded(mask):
    """What stays when as much is taken from the border as DISK adds to it."""
    height, width = mask.shape
    wide, left = numpy.pad(mask, CLOSED), mask.copy()
    for x, y in DISK + CLOSED:
        left &= wide[y:y + height, x:x + width]
    return left


def smooth(mask):
    """The mean with the four neighbours, so that slanted borders have no stairs."""
    wide = numpy.pad(mask, 1)
    return (2 * mask + wide[:-2, 1:-1] + wide[2:, 1:-1] + wide[1:-1, :-2] + wide[1:-1, 2:]) / 6


def samples_of(triangles, shape):
    """The centres of the cells that triangles, N x 3 x 3 in cells, cover, with the depth there: row by row, from edge to edge."""
    triangles = triangles[numpy.isfinite(triangles).all(axis=(1, 2))]
    heights = triangles[:, :, 1]
    of, rows = spans(heights.min(axis=1), heights.max(axis=1), shape[0])
    y = rows + 0.5
    corners, following = triangles[of], numpy.roll(triangles, -1, axis=1)[of]
    rise = following[:, :, 1] - corners[:, :, 1]
    with numpy.errstate(divide="ignore", invalid="ignore"):
        share = (y[:, None] - corners[:, :, 1]) / rise
        x = corners[:, :, 0] + share * (following[:, :, 0] - corners[:, :, 0])
    crossed = (share >= 0) & (share <= 1)
    left, right = numpy.where(crossed, x, numpy.inf).min(axis=1), numpy.where(crossed, x, -numpy.inf).max(axis=1)
    span, columns = spans(numpy.nan_to_num(left), numpy.nan_to_num(right), shape[1])
    normals = numpy.cross(triangles[:, 1] - triangles[:, 0], triangles[:, 2] - triangles[:, 0])
    of, x, y = of[span], columns + 0.5, y[span]
    normal, origin = normals[of], triangles[of, 0]
    with numpy.errstate(divide="ignore", invalid="ignore"):
        depth = origin[:, 2] - (normal[:, 0] * (x - origin[:, 0]) + normal[:, 1] * (y - origin[:, 1])) / normal[:, 2]
    return numpy.stack((x, y, depth), axis=1)


def spans(low, high, size):
    """Of each range the cells, of so many, whose centres lie in it: which range, and which cell."""
    low, high = (numpy.clip(numpy.ceil(limit - 0.5), 0, size).astype(int) for limit in (low, high))
    lengths = numpy.maximum(high - low, 0)
    of = numpy.repeat(numpy.arange(len(low)), lengths)
    return of, numpy.arange(len(of)) - numpy.repeat(numpy.cumsum(lengths) - lengths, lengths) + low[of]


def outlines(projection, copies, is_likely):
    """For each copy, (corners in the scan's frame, triangles or None), its polylines in the image. Likely ones hide each other, of the
    others each is whole."""
    together, paths = Buffer(projection), {}
    for number, copy in enumerate(copies):
        buffer = together if is_likely[number] else Buffer(projection)
        buffer.draw(number, *copy)
        if buffer is not together:
            paths[number] = buffer.paths(number)
    return [paths[number] if number in paths else together.paths(number) for number in range(len(copies))]
