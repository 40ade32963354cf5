# SPDX-License-Identifier: BSD-3-Clause
"""The benchmark's recalls of a few poses of a plate before a wall."""
import math

import numpy
from vtkmodules.vtkCommonDataModel import vtkPolyData, vtkStructuredGrid

from ppfmeam.filters import vtkMEAMBOPEvaluation
from meamtest import box, check, connect, fails, field, grid, poses, run


def at(x, y):
    return (1, 0, 0, x, 0, 1, 0, y, 0, 0, 1, 500, 0, 0, 0, 1)


def wall(depth=600.0, width=320, height=240, focal=300.0):
    """What a camera sees of a wall across its view."""
    v, u = numpy.mgrid[0:height, 0:width].reshape(2, -1)
    z = numpy.full(u.shape, depth)
    return grid(width, height, numpy.stack(((u - 150) / focal * z, (v - 110) / focal * z, z), axis=1))


mesh = box(40, 40, 10)
truths = poses(at(-60, -50), at(20, 20))
filter = connect(vtkMEAMBOPEvaluation(), poses(at(-60, -50), at(26, 20)), truths, mesh, wall())
table = run(filter)
diameter = math.sqrt(40 ** 2 + 40 ** 2 + 10 ** 2)
columns = {name: [table.GetColumnByName(name).GetValue(k) for k in range(10)]
           for name in ("Threshold", "ADD", "ADI", "MSSD", "MSPD", "VSD")}
check(numpy.allclose(columns["Threshold"], numpy.arange(1, 11) / 20), "thresholds")
# 6 mm are more than 10 % of the diameter and less than 15 %.
expected = [1 + (6 < k / 20 * diameter) for k in range(1, 11)]
check(columns["ADD"] == expected and columns["MSSD"] == expected, f"{columns['ADD']}, {columns['MSSD']}")
check(columns["ADI"][0] >= 1 and columns["ADI"][9] == 2, "the nearest vertex is no farther")
check(columns["MSPD"][0] == 1 and columns["MSPD"][1] == 2, "3.7 pixels against 2.5 and 5 of an image half as wide as 640")
check(field(table, "Targets")[0][0] == 2 and field(table, "ADDRecall")[0][0] == 50, "one of two")
recalls = [field(table, name)[0][0] for name in ("MSSDRecall", "MSPDRecall", "VSDRecall")]
check(math.isclose(recalls[0], 10 * sum(expected) / 2) and math.isclose(recalls[1], 95), f"{recalls}")
check(math.isclose(field(table, "AverageRecall")[0][0], sum(recalls) / 3), "the mean of the three")
check(math.isnan(field(run(connect(vtkMEAMBOPEvaluation(), truths, poses(), mesh, wall())), "AverageRecall")[0][0]), "no copies")

filter.SetInputDataObject(3, vtkStructuredGrid())
fails(filter)
filter.SetInputDataObject(3, wall())
points = vtkPolyData()
points.SetPoints(mesh.GetPoints())
filter.SetInputDataObject(2, points)
fails(filter, "no triangles")
