# SPDX-License-Identifier: BSD-3-Clause
"""Of a box each of six viewpoints sees one side; against the mesh that is exact."""
import math

from vtkmodules.vtkCommonDataModel import vtkPolyData

from ppfmeam.filters import (vtkMEAMBoundaryExtraction, vtkMEAMHashing, vtkMEAMMeshPreparation, vtkMEAMSurfaceSampling,
                             vtkMEAMTangentEstimation, vtkMEAMVisibilityExtraction)
from meamtest import box, check, close, cloud, connect, fails, field, image, mesh, partitions, points, run, tuples

SIZE = (10, 10, 10)
DIRECTIONS = [(0, 0, 1), (0, 0, -1), (1, 0, 0), (-1, 0, 0), (0, 1, 0), (0, -1, 0)]


def views(data, number=None):
    filter = connect(vtkMEAMVisibilityExtraction(), data)
    if number is not None:
        filter.SetNumberOfViewpoints(number)
    return filter


sampling = connect(vtkMEAMSurfaceSampling(), box(*SIZE), Spacing=0.5)
samples = run(sampling)
places, normals = points(samples), tuples(samples, "Normals")
output = run(views(sampling))
check([name for name, _ in partitions(output)] == [f"View {v}" for v in range(6)],
      "one named partition for each view")
check(field(output, "Diameter") == field(samples, "Diameter"), "the diameter travels along")
for v, (_, view) in enumerate(partitions(output)):
    direction = field(view, "ViewDirection")[0]
    check(close(direction, DIRECTIONS[v]), f"view {v} is in direction {direction}")
    check(field(view, "ViewIndex") == [(v,)], "the view's number")
    ids = [int(i) for i, in tuples(view, "PointId")]
    check(points(view) == [places[i] for i in ids], "PointId leads to the sample")
    check(tuples(view, "Normals") == [normals[i] for i in ids], "normals are passed on")
    side = {i for i, n in enumerate(normals) if sum(a * b for a, b in zip(n, direction)) > 0.9}
    check(len(side) > 100 and len(side - set(ids)) <= 0.01 * len(side), f"view {v} misses points of its side")
    height = [sum(p * d for p, d in zip(places[i], direction)) for i in ids]
    check(max(height) - min(height) < 2.0, f"view {v} sees {max(height) - min(height)} mm deep")

for number in (1, 2, 14, 26, 9):
    found = partitions(run(views(samples, number)))
    check(len(found) == number, f"{number} viewpoints")
    check(all(abs(math.hypot(*field(view, "ViewDirection")[0]) - 1) < 1e-6 for _, view in found), "unit directions")

# Without viewpoints the whole part is one model; the later steps know it and every pair is stored.
whole = views(samples, 0)
whole.SetMethodToMeshVisibility()  # plays no part
(name, view), = partitions(run(whole))
check(name == "Whole part" and points(view) == places and tuples(view, "Normals") == normals, f"{name}: all points")
check(field(view, "WholePart") == [(1,)] and field(view, "ViewDirection") == [(0, 0, 1)], "the whole part's fields")
check(view.GetFieldData().GetArray("Viewpoint") is None, "there is no viewpoint")
check(field(whole.GetOutput(), "Diameter") == field(samples, "Diameter"), "the diameter travels along")
for on_mesh in (0, 1):
    boundary = connect(vtkMEAMBoundaryExtraction(), whole, box(*SIZE), Method=on_mesh)
    tangents = connect(vtkMEAMTangentEstimation(), boundary)
    (name, edges), = partitions(run(tangents))
    check(name == "Whole part" and field(edges, "WholePart") == [(1,)], f"{name}: still known as the whole part")
    check(set(tuples(edges, "EdgeType")) == {(1,)}, "all edges of a box are creases")
    check({round(p[2]) for p in points(edges)} >= {0, 10}, "above and below")
    count = edges.GetNumberOfPoints()
    hashing = connect(vtkMEAMHashing(), tangents, samples)
    hashing.SetLeafSize(1e-3)  # all points make pairs
    check(field(run(hashing), "NumberOfPairs")[0][0] == count * (count - 1), "every pair is stored")

# Against the mesh: of a box exactly the points of the side, with the normals as they are.
exact = connect(vtkMEAMVisibilityExtraction(), samples, box(*SIZE))
check(exact.GetMethod() == 0, "the paper's method by default")
exact.SetMethodToMeshVisibility()
for v, (_, view) in enumerate(partitions(run(exact))):
    side = [i for i, n in enumerate(normals) if sum(a * b for a, b in zip(n, DIRECTIONS[v])) > 0.9]
    check([int(i) for i, in tuples(view, "PointId")] == side, f"view {v} sees its side")
    check(tuples(view, "Normals") == [normals[i] for i in side], "normals stay outward")
    away = [p - 5 for p in field(view, "Viewpoint")[0]]
    check(close([a / math.hypot(*away) for a in away], DIRECTIONS[v], 2e-3), "the viewpoint is known")
connection = connect(vtkMEAMVisibilityExtraction(), samples, Method=vtkMEAMVisibilityExtraction.MeshVisibility)
fails(connection, "needs the mesh", "connect")
source = connect(vtkMEAMMeshPreparation(), box(*SIZE))
connection.SetMeshConnection(source.GetOutputPort())
check(len(partitions(run(connection))) == 6, "the mesh comes by connection")
connection.SetMethodToHiddenPointRemoval()
check(len(partitions(run(connection))) == 6, "hidden point removal leaves the mesh alone")

# An open sheet is seen from above and from below, and its normals are turned.
sheet = mesh([(0, 0, 0), (9, 0, 0), (9, 9, 0), (0, 9, 0)], [(0, 1, 2), (0, 2, 3)])
both = connect(vtkMEAMVisibilityExtraction(), run(connect(vtkMEAMSurfaceSampling(), sheet)), sheet)
both.SetMethodToMeshVisibility()
found = partitions(run(both))
check([name for name, _ in found] == ["View 0", "View 1"], "from its sides there is nothing to see")
for (_, view), direction in zip(found, DIRECTIONS):
    check(set(tuples(view, "Normals")) == {direction}, "normals are turned towards the viewpoint")

# A part that is seen from above only.
cone = views(samples, 26)
cone.SetConeAngle(50)
directions = [field(view, "ViewDirection")[0] for _, view in partitions(run(cone))]
check(len(directions) == 5 and min(d[2] for d in directions) > 0.7, f"the cone holds {directions}")
cone.SetConeDirection(-1, 0, 0)
cone.SetConeAngle(30)
cone.SetNumberOfViewpoints(7)
directions = [field(view, "ViewDirection")[0] for _, view in partitions(run(cone))]
check(len(directions) == 7 and max(d[0] for d in directions) < -0.86, f"the cone holds {directions}")
cone.SetNumberOfViewpoints(1)
fails(cone, "none of the 1 viewpoints", "cone")
cone.SetConeDirection(0, 0, 0)
fails(cone, "direction of the cone")

fails(views(vtkPolyData()), "no points")
wrong = connect(vtkMEAMVisibilityExtraction(), samples, box(5, 5, 5), Method=vtkMEAMVisibilityExtraction.MeshVisibility)
fails(wrong, "not of this mesh")
fails(views(cloud([(math.nan, 0, 0)] * 5)), "NaN")
fails(views(image()), "vtkPolyData")
filter = connect(vtkMEAMVisibilityExtraction(), NumberOfViewpoints=-1)
check(filter.GetNumberOfViewpoints() == 0, "not less than none")
