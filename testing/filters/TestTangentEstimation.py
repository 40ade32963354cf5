# SPDX-License-Identifier: BSD-3-Clause
"""Points of two lines get the lines' directions, in a scene and in appearance models."""
import math

from vtkmodules.vtkCommonDataModel import vtkPartitionedDataSetCollection, vtkPolyData, vtkTable

from ppfmeam.filters import vtkMEAMTangentEstimation
from meamtest import check, cloud, collection, connect, fails, field, image, partitions, points, run, set_fields, tuples

A = (1 / math.sqrt(5), 2 / math.sqrt(5), 0.0)
B = (0.0, 0.6, 0.8)
LINES = [tuple(0.5 * i * c for c in A) for i in range(60)] + [tuple(100 + 0.5 * i * c for c in B) for i in range(60)]
LONE = (50.0, -40.0, 7.0)


def scene(places=LINES + [LONE], **fields):
    n = len(places)
    return set_fields(cloud(places, PointId=range(n), Normals=[(0, 0, 1)] * n), **fields)


def tangents(data, model=None, **properties):
    return connect(vtkMEAMTangentEstimation(), data, model, **properties)


def follow(output):
    """Every point has the direction of its line; the lone point is not there."""
    places, directions = points(output), tuples(output, "Tangent")
    check(len(places) > 10, f"{len(places)} points")
    for place, direction in zip(places, directions):
        line = A if place[0] < 90 else B
        check(place != LONE, "a point without a line is left out")
        check(abs(abs(sum(a * b for a, b in zip(direction, line))) - 1) < 1e-5, f"{direction} at {place}")
        check(abs(math.hypot(*direction) - 1) < 1e-5, "unit directions")
    ids = [int(i) for i, in tuples(output, "PointId")]
    check(all(math.dist(places[k], LINES[i]) < 1e-5 for k, i in enumerate(ids)), "points keep their identity")
    check(len(tuples(output, "Normals")) == len(places), "normals are kept")
    return len(places)


def model(diameter):
    return set_fields(vtkTable(), Diameter=diameter)


# The diameter of the model, or else that of the input, sets the lengths.
of_model = follow(run(tangents(scene(), model(50.0))))
check(of_model == follow(run(tangents(scene(Diameter=50.0)))), "the diameter may come with the input")
check(of_model == follow(run(tangents(scene(Diameter=20.0), model(50.0)))), "the model's diameter comes first")
check(of_model < follow(run(tangents(scene(Diameter=20.0)))), "a smaller part is sampled more densely")
check(field(run(tangents(scene(), model(50.0))), "Diameter") == [(50.0,)], "the diameter travels along")
check(follow(run(tangents(scene(), LeafSize=-1, Radius=3, InlierDistance=0.3))) == 120,
      "a negative leaf keeps all points")
check(follow(run(tangents(scene(), LeafSize=2.0, Radius=3, InlierDistance=0.3))) < 60, "one point for each cube")
check(run(tangents(scene(), model(50.0))).IsA("vtkPolyData"), "a scene stays a scene")

weights = [weight for weight, in tuples(run(tangents(scene(), model(50.0))), "Weight")]
check(all(0 <= weight <= 1 for weight in weights) and max(weights) == 1 and len(set(weights)) > 2,
      "points at the border of a cube count less")
check({weight for weight, in tuples(run(tangents(scene(), model(50.0), LeafSize=-1)), "Weight")} == {1},
      "all points count alike where all are kept")

# Where the edges of a scan come from goes along, point by point; other edge points have nothing of it.
sources = cloud(LINES, PointId=range(120), Normals=[(0, 0, 1)] * 120, EdgeSource=[k % 3 for k in range(120)])
kept = run(tangents(sources, model(50.0)))
check(kept.GetNumberOfPoints() > 10, "points stay")
check(tuples(kept, "EdgeSource") == [(i % 3,) for i, in tuples(kept, "PointId")], "the source of each point")
check(not run(tangents(scene(), model(50.0))).GetPointData().HasArray("EdgeSource"), "none where there was none")

for threads in (1, 2):
    again = run(tangents(scene(), model(50.0), NumberOfThreads=threads))
    check(tuples(again, "Tangent") == tuples(run(tangents(scene(), model(50.0))), "Tangent"), f"{threads} threads")

# The paper's method, on the plane across the view direction.
paper = tangents(scene())
paper.SetParametersToPaper()
follow(run(paper))
paper.SetViewDirection(0, 5, 5)
follow(run(paper))

# Appearance models, each with its own direction.
views = collection(
    ("first", set_fields(scene(), ViewDirection=(0, 0, 1))), ("second", set_fields(scene(), ViewDirection=(1, 0, 0))),
    Diameter=50.0)
for method in (0, 1):
    output = run(tangents(views, Method=method, LeafSize=1.0))
    check([name for name, _ in partitions(output)] == ["first", "second"], "the partitions keep their names")
    check(field(output, "Diameter") == [(50.0,)], "the diameter travels along")
    for (_, edges), direction in zip(partitions(output), ((0, 0, 1), (1, 0, 0))):
        follow(edges)
        check(field(edges, "ViewDirection") == [direction], "the view is kept")
        check(not edges.GetPointData().HasArray("Weight"), "a view's points count alike")

# Points that carry tangents keep them, and their types; they are only thinned.
n = len(LINES)
carried = set_fields(cloud(LINES, Tangent=[(0, 0, 1)] * n, EdgeType=[2] * n), Diameter=50.0)
output = run(tangents(carried))
check(0 < output.GetNumberOfPoints() < n, f"{output.GetNumberOfPoints()} of {n} points")
check(set(tuples(output, "Tangent")) == {(0, 0, 1)} and set(tuples(output, "EdgeType")) == {(2,)}, "as they came")
again = points(run(tangents(output)))  # in the frame of what is left, so the cubes are others
check(set(again) <= set(points(output)) and len(again) > 0.5 * output.GetNumberOfPoints(), "thinning again only thins")
parts_own = set_fields(collection(("own", set_fields(carried, ViewDirection=(0, 0, 1)))), Diameter=50.0)
once = run(tangents(parts_own))
check(points(partitions(run(tangents(once)))[0][1]) == points(partitions(once)[0][1]), "in a model the cubes stay")

fails(tangents(scene()), "diameter", "model")
fails(tangents(scene(), vtkTable()), "Diameter")
fails(tangents(scene(), model(math.nan)), "Diameter")
fails(tangents(scene(), model(50000.0)), "units differ", "1000")
fails(tangents(scene([tuple(1e-3 * c for c in p) for p in LINES]), model(500.0)), "units differ")
fails(tangents(vtkPolyData(), model(50.0)), "no points")
fails(tangents(scene([(math.nan, 0, 0)] * 9), model(50.0)), "NaN")
fails(tangents(scene(), model(50.0), ViewDirection=(0, 0, 0)), "view direction is zero")
fails(tangents(vtkPartitionedDataSetCollection(), model(50.0)), "no appearance models")
fails(tangents(collection(("a", scene()), Diameter=50.0)), "ViewDirection")
fails(tangents(image(), model(50.0)), "vtkPolyData")
check(field(run(tangents(scene(LINES + [(math.nan, 0, 0)]), model(50.0))), "Diameter"),
      "single invalid points do not matter")
