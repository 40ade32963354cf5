# SPDX-License-Identifier: BSD-3-Clause
"""The edges of a box and of a sheet, exactly; tangents estimated on them agree."""
import math

from vtkmodules.vtkCommonDataModel import vtkPolyData
from vtkmodules.vtkFiltersSources import vtkSphereSource

from ppfmeam.filters import vtkMEAMFeatureEdges, vtkMEAMMeshPreparation, vtkMEAMTangentEstimation
from meamtest import box, bracket, check, close, connect, fails, field, image, mesh, points, run, tuples


def edges(data, spacing=1.0, angle=30.0):
    return connect(vtkMEAMFeatureEdges(), data, Spacing=spacing, Angle=angle)


part = run(edges(box(10, 20, 30)))
check(part.GetNumberOfPoints() == 240 and part.GetNumberOfVerts() == 240, f"{part.GetNumberOfPoints()} points")
check(tuples(part, "PointId") == [(i,) for i in range(240)], "points are counted")
check(set(tuples(part, "EdgeType")) == {(1,)}, "all of them are sharp edges")
for point, tangent, normal in zip(points(part), tuples(part, "Tangent"), tuples(part, "Normals")):
    check(sorted(abs(c) for c in tangent) == [0, 0, 1], f"the tangent at {point} is {tangent}")
    ends = [c in (0, size) for c, size in zip(point, (10, 20, 30))]
    check([not end for end in ends] == [c != 0 for c in tangent], f"{point} is not on an edge along {tangent}")
    check(close([abs(c) for c in normal], [math.sqrt(0.5) if end else 0 for end in ends]), f"the normal is {normal}")
check(abs(field(part, "Diameter")[0][0] - math.sqrt(1400)) < 1e-4, "the diameter travels on")

# 1 % of the diameter.
count = run(edges(box(10, 20, 30), 0.0)).GetNumberOfPoints()
check(abs(count - 240 / (0.01 * math.sqrt(1400))) < 12, f"{count} points")

sheet = run(edges(mesh([(0, 0, 0), (10, 0, 0), (10, 5, 0), (0, 5, 0)], [(0, 1, 2, 3)])))
check(set(tuples(sheet, "EdgeType")) == {(2,)} and sheet.GetNumberOfPoints() == 30, "the border of a sheet")

ell = run(edges(connect(vtkMEAMMeshPreparation(), bracket())))
check(ell.GetNumberOfPoints() == 2 * 130 + 6 * 15, f"{ell.GetNumberOfPoints()} points on the bracket")
check(run(edges(bracket(), 1.0, 91.0)).GetNumberOfPoints() == 0, "no edge is sharper than a right angle")

ball = connect(vtkSphereSource(), ThetaResolution=60, PhiResolution=60)
check(run(edges(connect(vtkMEAMMeshPreparation(), ball))).GetNumberOfPoints() == 0, "a ball has no edges")

# What is estimated on the edge points of the box agrees with what is known.
estimated = run(connect(vtkMEAMTangentEstimation(), part))
known = {tuple(round(c, 3) for c in p): t for p, t in zip(points(part), tuples(part, "Tangent"))}
middle = [(p, t) for p, t in zip(points(estimated), tuples(estimated, "Tangent")) if 10 < p[2] < 20]
check(len(middle) >= 8, f"{len(middle)} tangents")
for point, tangent in middle:
    cosine = sum(a * b for a, b in zip(tangent, known[tuple(round(c, 3) for c in point)]))
    check(abs(cosine) > 0.999, f"the tangent at {point} is {tangent}")

fails(edges(vtkPolyData()), "no faces")
fails(edges(mesh([(0, 0, 0), (1, 0, math.nan), (0, 1, 0)], [(0, 1, 2)])), "not a number")
fails(edges(box(1, 1, 1), 1e-9), "spacing")
fails(edges(image()), "vtkPolyData")
