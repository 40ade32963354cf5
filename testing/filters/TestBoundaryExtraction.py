# SPDX-License-Identifier: BSD-3-Clause
"""The boundary of a grid of points is its outermost row; of a box from above the mesh gives the rim of its top."""
import math

from ppfmeam import filters
from meamtest import (box, check, close, cloud, collection, connect, fails, field, image, partitions, points, run,
                      set_fields, tuples)

N = 11
GRID = [(float(x), float(y), 0.0) for y in range(N) for x in range(N)]
OUTER = [p for p in GRID if 0 in p[:2] or N - 1 in p[:2]]


def view(places, direction=(0, 0, 1), **arrays):
    return set_fields(cloud(places, **arrays), ViewDirection=direction)


def grid(**more):
    return view(GRID, Normals=[(0, 0, 1)] * len(GRID), PointId=range(100, 100 + len(GRID)), **more)


def boundary(*pieces, **properties):
    return connect(filters.vtkMEAMBoundaryExtraction(), collection(*pieces, Diameter=14.1), **properties)


output = run(boundary(("left", grid()), ("right", grid())))
check([name for name, _ in partitions(output)] == ["left", "right"], "the partitions keep their names")
check(field(output, "Diameter") == [(14.1,)], "the diameter travels along")
for v, (_, edges) in enumerate(partitions(output)):
    check(points(edges) == OUTER, f"the boundary is {points(edges)}")
    check(tuples(edges, "PointId") == [(100 + GRID.index(p),) for p in OUTER], "points keep their identity")
    check(close(field(edges, "ViewDirection")[0], (0, 0, 1)) and field(edges, "ViewIndex") == [(v,)],
          "the view is kept")
    check(tuples(edges, "Normals") == [(0, 0, 1)] * len(OUTER), "normals are kept")
    check(tuples(edges, "EdgeType") == [(0,)] * len(OUTER), "they are contours")
    check(edges.GetPointData().GetScalars().GetName() == "EdgeType", "a view colours by the type")

# Behind an opening in the grid the background shows that it encloses.
FRAME = [p for p in GRID if max(abs(p[0] - 5), abs(p[1] - 5)) > 1]
framed = partitions(run(boundary(("a", view(FRAME, Normals=[(0, 0, 1)] * len(FRAME))))))[0][1]
inner = [p for p in points(framed) if p not in OUTER]
check(len(inner) >= 12, f"the opening's border is {inner}")
check([t for t, in tuples(framed, "EdgeType")] == [2 * (p not in OUTER) for p in points(framed)], "a hole border")

# Only the corners have a gap of more than 200 degrees: there it is 270, along a side 180.
corners = partitions(run(boundary(("a", grid()), Radius=1.5, Angle=200)))[0][1]
check(sorted(points(corners)) == [(0, 0, 0), (0, 10, 0), (10, 0, 0), (10, 10, 0)],
      f"the corners are {points(corners)}")

# Of a mesh: six views of a box, each with four straight edges.
SIZE = (20, 20, 10)
samples = connect(filters.vtkMEAMSurfaceSampling(), box(*SIZE), Spacing=0.7)
views = connect(filters.vtkMEAMVisibilityExtraction(), samples, box(*SIZE))
views.SetMethodToMeshVisibility()
edges = connect(filters.vtkMEAMBoundaryExtraction(), views, box(*SIZE))
check(edges.GetMethod() == 0, "the paper's method by default")
edges.SetMethodToMeshEdges()
found = partitions(run(edges))
check(len(found) == 6, f"{len(found)} views")
top = found[0][1]
check(all(z == 10 and (x in (0, 20) or y in (0, 20)) for x, y, z in points(top)), "the rim of the top")
for (x, y, z), tangent in zip(points(top), tuples(top, "Tangent")):
    check(tuple(abs(t) for t in tangent) == ((1, 0, 0) if y in (0, 20) else (0, 1, 0)), f"{tangent} at {x, y, z}")
check(set(tuples(top, "Normals")) == {(0, 0, 1)} and set(tuples(top, "EdgeType")) == {(0,)}, "contours of the top")
ids = {i for i, in tuples(partitions(run(views))[0][1], "PointId")}
check({i for i, in tuples(top, "PointId")} <= ids, "points are identified by what the view shows")

# The tangent step thins them and leaves the rest as it is.
thin = connect(filters.vtkMEAMTangentEstimation(), edges, LeafSize=2)
for (_, dense), (_, sparse) in zip(found, partitions(run(thin))):
    check(0 < sparse.GetNumberOfPoints() < dense.GetNumberOfPoints(), "fewer points")
    known = dict(zip(points(dense), zip(tuples(dense, "Tangent"), tuples(dense, "EdgeType"), tuples(dense, "PointId"))))
    kept = zip(tuples(sparse, "Tangent"), tuples(sparse, "EdgeType"), tuples(sparse, "PointId"))
    check([known[p] for p in points(sparse)] == list(kept), "with their tangents, types and identities")
    check(sparse.GetPointData().GetScalars().GetName() == "EdgeType", "a view colours by the type")

without = connect(filters.vtkMEAMBoundaryExtraction(), views, Method=filters.vtkMEAMBoundaryExtraction.MeshEdges)
fails(without, "need the mesh", "connect")
prepared = connect(filters.vtkMEAMMeshPreparation(), box(*SIZE))
without.SetMeshConnection(prepared.GetOutputPort())
check(len(partitions(run(without))) == 6, "the mesh comes by connection")
without.SetMethodToPointBoundary()
check(len(partitions(run(without))) == 6, "the boundary of the points leaves the mesh alone")
wrong = connect(filters.vtkMEAMBoundaryExtraction(), views, box(5, 5, 5), Method=filters.vtkMEAMBoundaryExtraction.MeshEdges)
fails(wrong, "not of this mesh")

typed = boundary(("a", view(GRID, Normals=[(0, 0, 1)] * len(GRID), EdgeType=[7] * len(GRID))))
fails(typed, "EdgeType", "crease")
fails(boundary(), "no appearance models")
fails(boundary(("a", view(GRID))), "no normals", "a")
fails(boundary(("a", view([]))), "no points", "a")
fails(boundary(("a", view([(math.nan, 0, 0)] * 9, Normals=[(0, 0, 1)] * 9))), "NaN")
fails(boundary(("a", cloud(GRID, Normals=[(0, 0, 1)] * len(GRID)))), "ViewDirection", "VisibilityExtraction")
fails(boundary(("a", view(GRID, direction=(0, 0, 0), Normals=[(0, 0, 1)] * len(GRID)))), "ViewDirection")
fails(boundary(("a", view(GRID, Normals=[(0, 1)] * len(GRID)))), "Normals", "3 components")
fails(boundary(("a", image())), "not an appearance model")
fails(connect(filters.vtkMEAMBoundaryExtraction(), cloud(GRID)), "vtkPartitionedDataSetCollection")
