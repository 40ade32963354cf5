# SPDX-License-Identifier: BSD-3-Clause
"""The boundary of a grid of points is its outermost row."""
import math

from ppfmeam.filters import vtkMEAMBoundaryExtraction
from meamtest import (check, close, cloud, collection, connect, fails, field, image, partitions, points, prints, run,
                      set_fields, tuples)

N = 11
GRID = [(float(x), float(y), 0.0) for y in range(N) for x in range(N)]
OUTER = [p for p in GRID if 0 in p[:2] or N - 1 in p[:2]]


def view(places, direction=(0, 0, 1), **arrays):
    return set_fields(cloud(places, **arrays), ViewDirection=direction)


def grid(**more):
    return view(GRID, Normals=[(0, 0, 1)] * len(GRID), PointId=range(100, 100 + len(GRID)), **more)


def boundary(*pieces, **properties):
    filter = connect(vtkMEAMBoundaryExtraction(), collection(*pieces, Diameter=14.1))
    for name, value in properties.items():
        getattr(filter, "Set" + name)(value)
    return filter


output = run(boundary(("left", grid()), ("right", grid())))
check([name for name, _ in partitions(output)] == ["left", "right"], "the partitions keep their names")
check(field(output, "Diameter") == [(14.1,)], "the diameter travels along")
for v, (_, edges) in enumerate(partitions(output)):
    check(points(edges) == OUTER, f"the boundary is {points(edges)}")
    check(tuples(edges, "PointId") == [(100 + GRID.index(p),) for p in OUTER], "points keep their identity")
    check(close(field(edges, "ViewDirection")[0], (0, 0, 1)) and field(edges, "ViewIndex") == [(v,)],
          "the view is kept")
    check(tuples(edges, "Normals") == [(0, 0, 1)] * len(OUTER), "normals are kept")

# Only the corners have a gap of more than 200 degrees: there it is 270, along a side 180.
corners = partitions(run(boundary(("a", grid()), Radius=1.5, Angle=200)))[0][1]
check(sorted(points(corners)) == [(0, 0, 0), (0, 10, 0), (10, 0, 0), (10, 10, 0)],
      f"the corners are {points(corners)}")

fails(boundary(), "no appearance models")
fails(boundary(("a", view(GRID))), "no normals", "a")
fails(boundary(("a", view([]))), "no points", "a")
fails(boundary(("a", view([(math.nan, 0, 0)] * 9, Normals=[(0, 0, 1)] * 9))), "NaN")
fails(boundary(("a", cloud(GRID, Normals=[(0, 0, 1)] * len(GRID)))), "ViewDirection", "VisibilityExtraction")
fails(boundary(("a", view(GRID, direction=(0, 0, 0), Normals=[(0, 0, 1)] * len(GRID)))), "ViewDirection")
fails(boundary(("a", view(GRID, Normals=[(0, 1)] * len(GRID)))), "Normals", "3 components")
fails(boundary(("a", image())), "not an appearance model")
fails(connect(vtkMEAMBoundaryExtraction(), cloud(GRID)), "vtkPartitionedDataSetCollection")
prints(vtkMEAMBoundaryExtraction(), "Radius", "Angle")
