# SPDX-License-Identifier: BSD-3-Clause
"""A pose that is a little off moves to where the part is."""
import math

from vtkmodules.vtkCommonDataModel import vtkPolyData

from ppfmeam.filters import vtkMEAMPoseRefinement
from meamtest import check, cloud, connect, fails, field, image, is_empty, points, pose_error, poses, run, trained_bracket, tuples

trained, model, scene, edges = trained_bracket()
diameter = field(model, "Diameter")[0][0]


def near(degrees, *mm):
    """The true pose, first turned about the part's z axis, then moved."""
    c, s = math.cos(math.radians(degrees)), math.sin(math.radians(degrees))
    t = list(scene.transform)
    for row in range(3):
        x, y = t[4 * row : 4 * row + 2]
        t[4 * row : 4 * row + 2] = [c * x + s * y, c * y - s * x]
        t[4 * row + 3] += mm[row]
    return tuple(t)


def refinement(candidates, surface=None, edges=edges, model=model, **properties):
    return connect(vtkMEAMPoseRefinement(), candidates, model, edges, surface, **{"ViewDirection": scene.looking, **properties})


start = poses(near(2, 0.5, -0.6, 0.7), near(0, 0, 0, 0), near(-1.5, -0.4, 0.4, 0))
for name, values in {"Score": (0.25, 0.5, 0.75), "Votes": (7, 8, 9), "ViewId": (0, 0, 0)}.items():
    array = cloud([(0, 0, 0)] * 3, **{name: values}).GetPointData().GetArray(name)
    start.GetPointData().AddArray(array)
before = [pose_error(t, scene.transform) for t in tuples(start, "Transform")]
for method, surface, mm, degrees in ((0, None, 0.4, 1.0), (1, None, 0.3, 0.6), (1, scene.surface, 0.2, 0.4)):
    refined = run(refinement(start, surface, Method=method))
    errors = [pose_error(t, scene.transform) for t in tuples(refined, "Transform")]
    for (a, b), (c, d) in zip(before, errors):
        print(f"method {method}: {a:.2f} mm, {b:.2f} degrees -> {c:.3f} mm, {d:.3f} degrees")
    check(len(errors) == 3 and all(a < mm and b < degrees for a, b in errors), f"method {method}: {errors}")
    check(tuples(refined, "Score") == [(0.25,), (0.5,), (0.75,)], "scores stay, and the order")
    check(tuples(refined, "Votes") == [(7,), (8,), (9,)] and tuples(refined, "Rank") == [(1,), (2,), (3,)],
          "votes stay")
    check(field(refined, "Diameter") == [(diameter,)], "the diameter travels along")
    for threads in (1, 2):
        again = run(refinement(start, surface, Method=method, NumberOfThreads=threads))
        check(tuples(again, "Transform") == tuples(refined, "Transform"), f"{threads} threads")

# Tangents of any length are directions.
longer = edges.NewInstance()
longer.DeepCopy(edges)
lengths = longer.GetPointData().GetArray("Tangent")
for k in range(lengths.GetNumberOfTuples()):
    lengths.SetTuple(k, [8 * value for value in lengths.GetTuple(k)])
errors = [pose_error(a, b) for a, b in zip(tuples(run(refinement(start, scene.surface)), "Transform"),
                                           tuples(run(refinement(start, scene.surface, edges=longer)), "Transform"))]
check(len(errors) == 3 and all(mm < 1e-3 and degrees < 1e-2 for mm, degrees in errors), f"long tangents: {errors}")

# Too far for any correspondence: the pose stays.
far = near(0, 500, 500, 500)
for method in (0, 1):
    stays = run(refinement(poses(far), Method=method))
    mm, degrees = pose_error(tuples(stays, "Transform")[0], far)
    check(mm < 1e-3 and degrees < 1e-3, f"method {method} moved a lost pose by {mm} mm, {degrees} degrees")
check(is_empty(run(refinement(vtkPolyData()))), "no poses, no error")

fails(refinement(poses(tuple(2 * c for c in scene.transform))), "pose 1", "rotation")
fails(refinement(cloud([(0, 0, 0)])), "Transform")
fails(refinement(start, edges=vtkPolyData()), "no points")
fails(refinement(start, edges=scene.edges), "Tangent")
for weight in (-0.1, 1.5, math.nan):
    weighted = cloud(points(edges), Tangent=tuples(edges, "Tangent"), Weight=[weight] * edges.GetNumberOfPoints())
    fails(refinement(start, edges=weighted), "Weight", "0 to 1")
fails(refinement(start, cloud([(math.nan, 0, 0)] * 4)), "surface", "NaN")
fails(refinement(start, model=run(trained.tangents)), "not a trained model")
fails(refinement(start, ViewDirection=(0, 0, 0)), "view direction is zero")
fails(refinement(image()), "vtkPolyData")
fails(connect(vtkMEAMPoseRefinement(), start), "the input Model, Scene Edges")
