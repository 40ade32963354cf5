# SPDX-License-Identifier: BSD-3-Clause
"""Six real scans of pipe elbows without true poses: of the best five, and of those likelier than not, so many agree with what
the sensor measured. A pose is right when its surface, as the sensor sees it, is there: nearly nothing of it was seen past,
most of what was measured at it is at its depth, on pixels of the part's colour; of two that share their pixels one counts."""
import os

import numpy
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkPoints
from vtkmodules.vtkCommonDataModel import vtkPolyData

from ppfmeam import filters, scripting
from meamtest import check, connect, skip

FOCAL = 422.25   # pixels
TOLERANCE = 6.0  # mm, between the depths
MARGIN = 150     # pixels about the image: what lies beyond it is predicted, too
BLUE = 45        # grey values that the part's blue is over its red
TOP, LIKELY = 5, 0.5
RIGHT_OF_BEST, RIGHT_FIRST, LIKELY_RIGHT, LIKELY_WRONG = 26, 6, 26, 2
RIGHT_OF_BARE = 24  # of the best of the points alone, without grid and image

folder = os.path.join(os.environ.get("PPFMEAM_DATA", ""), "pipes")
if not os.path.isdir(folder):
    skip(f"no scans at {folder}: set PPFMEAM_DATA")


def surface_points(mesh, spacing=0.35):
    """Points on the triangles, evenly spread, the same at each run."""
    corners = vtk_to_numpy(mesh.GetPoints().GetData()).astype(float)[
        vtk_to_numpy(mesh.GetPolys().GetConnectivityArray()).reshape(-1, 3)]
    a, ab, ac = corners[:, 0], corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]
    counts = numpy.ceil(numpy.linalg.norm(numpy.cross(ab, ac), axis=1) / 2 / spacing**2).astype(int)
    which = numpy.repeat(numpy.arange(len(corners)), counts)
    u, v = numpy.random.default_rng(0).random((2, len(which)))
    outside = u + v > 1
    u[outside], v[outside] = 1 - u[outside], 1 - v[outside]
    return a[which] + u[:, None] * ab[which] + v[:, None] * ac[which]


def inner(mask):
    """The pixels whose four neighbours are in the mask, too."""
    result = numpy.zeros_like(mask)
    result[1:-1, 1:-1] = mask[1:-1, 1:-1] & mask[:-2, 1:-1] & mask[2:, 1:-1] & mask[1:-1, :-2] & mask[1:-1, 2:]
    return result


class Scan:
    """The depths of a scan, which of its pixels are of the part's colour, and where its image begins."""

    def __init__(self, grid):
        size = [0, 0, 0]
        grid.GetDimensions(size)
        shape = (size[1], size[0])
        points = vtk_to_numpy(grid.GetPoints().GetData()).astype(float).reshape(*shape, 3)
        colours = vtk_to_numpy(grid.GetPointData().GetArray("RGB")).astype(int).reshape(*shape, 3)
        known = numpy.isfinite(points[..., 2])
        self.offsets = [int(numpy.median(numpy.rint(FOCAL * points[known][:, k] / points[known][:, 2]) - numpy.nonzero(known)[1 - k]))
                        for k in (0, 1)]
        self.depth = numpy.pad(points[..., 2], MARGIN, constant_values=numpy.nan)
        self.is_blue = numpy.pad(colours[..., 2] - colours[..., 0] > BLUE, MARGIN)

    def agreeing(self, points):
        """The pixels at which points of a part are where something was measured; None when these contradict it."""
        u, v = (numpy.rint(FOCAL * points[:, k] / points[:, 2]).astype(int) - self.offsets[k] + MARGIN for k in (0, 1))
        seen = (u >= 0) & (v >= 0) & (u < self.depth.shape[1]) & (v < self.depth.shape[0])
        predicted = numpy.full(self.depth.shape, numpy.inf)
        numpy.minimum.at(predicted, (v[seen], u[seen]), points[seen, 2])
        shown = inner(numpy.isfinite(predicted))
        with numpy.errstate(invalid="ignore"):
            agree = shown & (numpy.abs(self.depth - predicted) <= TOLERANCE)
            past = shown & (self.depth > predicted + TOLERANCE)
        count, measured = agree.sum(), (shown & numpy.isfinite(self.depth)).sum()
        is_right = (count >= 250 and count >= 0.92 * (count + past.sum()) and count >= 0.75 * measured
                    and measured >= 0.5 * shown.sum() and (agree & self.is_blue).sum() >= 0.7 * count)
        return agree if is_right else None


def judged(scan, part, poses):
    """Of each pose whether it is right."""
    taken, right = [], []
    for T in poses:
        agree = scan.agreeing(part @ T[:3, :3].T + T[:3, 3])
        is_new = agree is not None and not any((agree & other).sum() > 0.5 * agree.sum() for other in taken)
        if is_new:
            taken.append(agree)
        right.append(is_new)
    return right


mesh = scripting.read_mesh(os.path.join(folder, "elbow.stl"))
part, model = surface_points(mesh), scripting.train(mesh)
of_best = of_bare = first = likely_right = likely_wrong = 0
for name in sorted(name for name in os.listdir(folder) if name.endswith(".pcd")):
    grid = scripting.read_scan(os.path.join(folder, name))
    estimation = connect(filters.vtkMEAMPoseEstimation(), model, grid, MaximumNumberOfPoses=0)
    found = scripting.update(estimation).GetOutput()
    likely = scripting.column(found, "Probability") > LIKELY
    poses = scripting.column(found, "Transform", 4, 4)
    right = judged(Scan(grid), part, poses[:max(TOP, likely.sum())])
    print(f"{name}: {sum(right[:TOP])} of the best {TOP}, likelier than not {sum(right[:likely.sum()])} of {likely.sum()}")
    of_best += sum(right[:TOP])
    first += right[0]
    likely_right += sum(right[:likely.sum()])
    likely_wrong += likely.sum() - sum(right[:likely.sum()])
    bare = vtkPolyData()
    bare.SetPoints(vtkPoints())
    bare.GetPoints().SetData(numpy_to_vtk(vtk_to_numpy(grid.GetPoints().GetData())[::-1], deep=True))
    estimation.SetInputDataObject(1, bare)
    found = scripting.update(estimation).GetOutput()
    check("grid of a pinhole camera" in found.GetFieldData().GetAbstractArray("ScanReport").GetValue(0), f"{name}: the pixels of the points alone")
    of_bare += sum(judged(Scan(grid), part, scripting.column(found, "Transform", 4, 4)[:TOP]))
print(f"{of_best} right of the best {TOP}, {first} first; likelier than not {likely_right} right, {likely_wrong} wrong")
print(f"points alone: {of_bare} right of the best {TOP}")
check(of_bare >= RIGHT_OF_BARE, f"points alone: {of_bare} of the best {TOP} are right")
check(of_best >= RIGHT_OF_BEST and first >= RIGHT_FIRST, f"{of_best} of the best {TOP} are right, {first} first")
check(likely_right >= LIKELY_RIGHT and likely_wrong <= LIKELY_WRONG, f"likelier than not {likely_right} right, {likely_wrong} wrong")
