# SPDX-License-Identifier: BSD-3-Clause
"""The real scan of rings: every tenth pixel of a structured-light sensor, as a PLY cloud in metres, comes back onto a
grid of a quarter of its resolution; and the real scan with intensities, which has no grid."""
import os

import numpy
from vtkmodules.util.numpy_support import vtk_to_numpy

from ppfmeam.filters import vtkMEAMPLYReader, vtkMEAMSceneEdgeExtraction
from meamtest import check, connect, run, skip

DATA = os.environ.get("PPFMEAM_DATA", "")
RINGS = os.path.join(DATA, "rings", "triangles_scene.ply")
SCANNER = os.path.join(DATA, "scanner", "data.ply")
if not DATA or not os.path.exists(RINGS) or not os.path.exists(SCANNER):
    skip("PPFMEAM_DATA names no folder with rings/ and scanner/")

# With this focal length x / z of all points is whole pixels; a point in front of the first column is not there.
FOCAL, CENTRE, SIZE = 3567.5, (497.577, 405.57), (936, 778)


def rings(step):
    """The scan on a grid that is `step` times coarser than the sensor's."""
    reader = connect(vtkMEAMPLYReader(), FileName=RINGS, Scale=1000, FocalLength=(FOCAL / step, FOCAL / step))
    reader.SetPrincipalPoint(*((c + 0.5) / step - 0.5 for c in CENTRE))
    reader.SetImageSize(*(-(-size // step) for size in SIZE))
    return reader


def shape(reader):
    """The points of the grid, rows x columns x 3."""
    grid = run(reader)
    size = [0, 0, 0]
    grid.GetDimensions(size)
    width, height, _ = size
    return vtk_to_numpy(grid.GetPoints().GetData()).reshape(height, width, 3)


# The sensor's own pixels: hardly two points fall into one, and in a row they are at whole pixels.
whole = shape(rings(1))
valid = numpy.isfinite(whole).all(axis=2)
check(valid.sum() > 50400, f"{valid.sum()} of 50551 points have pixels of their own")
columns = whole[..., 0] / whole[..., 2] * FOCAL + CENTRE[0] - numpy.arange(SIZE[0])
check(numpy.nanstd(columns) < 0.06, f"points are {numpy.nanstd(columns):.3f} pixels beside their columns")

# A quarter of them: a surface, with an image that shows the edges of the rings.
quarter = rings(4)
valid = numpy.isfinite(shape(quarter)).all(axis=2)
check(0.6 < valid.mean() < 0.65, f"{100 * valid.mean():.1f} % of the pixels have points")
check(valid[60:100, 120:200].mean() > 0.8, "among the rings hardly a pixel is empty")
colours = vtk_to_numpy(run(quarter).GetPointData().GetArray("RGB"))
check((colours[:, 0] == colours[:, 1]).all() and colours.min() >= 10, "grey everywhere, without black holes")
edges = run(connect(vtkMEAMSceneEdgeExtraction(), quarter))
check(2000 < edges.GetNumberOfPoints() < 8000, f"{edges.GetNumberOfPoints()} edge points")

cloud = run(connect(vtkMEAMPLYReader(), FileName=SCANNER))
check(cloud.GetNumberOfPoints() == 24397, f"{cloud.GetNumberOfPoints()} points")
check(len(set(vtk_to_numpy(cloud.GetPointData().GetArray("Intensity")))) > 20, "intensities are spread")
