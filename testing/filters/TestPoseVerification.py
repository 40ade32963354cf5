# SPDX-License-Identifier: BSD-3-Clause
"""The true pose beats wrong ones; weights, limits, occlusion, and how the sensor looks."""
import math

from vtkmodules.vtkCommonDataModel import vtkPolyData

from ppfmeam.filters import vtkMEAMPoseVerification
from meamtest import (check, cloud, connect, fails, field, grid, image, is_empty, is_rotation, points, pose_error, poses,
                      run, trained_bracket, tuples)

trained, model, scene, edges = trained_bracket()
diameter = field(model, "Diameter")[0][0]
shifted = scene.shifted


def verification(candidates, surface=None, edges=edges, model=model, **properties):
    return connect(vtkMEAMPoseVerification(), candidates, model, edges, surface, **{"ViewDirection": scene.looking, **properties})


# The wrong ones first: a copy 0.5 mm away, one 60 mm away, one upside down.
far = math.sqrt(3) * 60 / 3
candidates = poses(shifted(far, far, far), shifted(0.3, 0.3, 0.3), shifted(turned=True), shifted())
for method in (0, 1):
    for surface in (None, scene.surface):
        best = run(verification(candidates, surface, Method=method))
        transforms, scores = tuples(best, "Transform"), [s for s, in tuples(best, "Score")]
        check(pose_error(transforms[0], scene.transform)[0] < 1.0, f"method {method}: the best is {transforms[0]}")
        check(pose_error(transforms[0], scene.transform)[1] < 1.0, f"method {method}: the best is {transforms[0]}")
        evidence = [e for e, in tuples(best, "Evidence")]
        check(evidence == sorted(evidence, reverse=True) and evidence[0] > evidence[-1], "best first")
        check(scores[0] > 0.85 and scores[0] <= 1.0, f"method {method}: the true pose has a score of {scores[0]}")
        check(scores[-1] < 0.5 * scores[0], f"method {method}: the worst pose has a score of {scores[-1]}")
        check(best.GetNumberOfPoints() == 4, "every pose is scored")
        check(tuples(best, "Rank") == [(i + 1,) for i in range(4)], "ranks count from 1")
        check(tuples(best, "ViewId")[0] == (0,), "the view of what the sensor sees")
        check(field(best, "Diameter") == [(diameter,)], "the diameter travels along")


def of_truth(array, *args, **properties):
    return tuples(run(verification(poses(shifted()), *args, **properties)), array)[0][0]


def visible(*args, **properties):
    return of_truth("VisibleFraction", *args, **properties)


def score(*args, **properties):
    return of_truth("Score", *args, **properties)


# On one side the sensor saw past the part: that speaks against the pose, where nothing was measured says nothing.
side = [x > sum(x for x, *_ in points(scene.surface)) / scene.surface.GetNumberOfPoints() for x, *_ in points(scene.surface)]
past = cloud([[c + 40 * d * beyond for c, d in zip(p, scene.looking)] for p, beyond in zip(points(scene.surface), side)])
gone = cloud([p for p, beyond in zip(points(scene.surface), side) if not beyond])


check(score(past) < score(scene.surface) - 0.1, f"the sensor saw past half of the part: {score(past)}")
evidence = {name: of_truth("Evidence", surface) for name, surface in (("all", scene.surface), ("past", past), ("gone", gone))}
check(evidence["gone"] - 0.3 < of_truth("Evidence", past, FreeSpace=False) < evidence["all"],
      "what the sensor saw past says nothing, but that the outline ends")
check(evidence["past"] < evidence["gone"] - 2, f"half of the part was not measured: {evidence}")
check(evidence["gone"] < evidence["all"] - 1, f"less speaks for it: {evidence}")
for one, name in ((scene.surface, "all"), (past, "past")):
    check(abs(of_truth("Probability", one) - 1 / (1 + math.exp(-evidence[name]))) < 1e-12, f"probability of {name}")
check(visible(gone) > 0.9, "what was not measured is not hidden")

views = [view for view, in tuples(run(verification(candidates)), "ViewId")]
check(run(verification(candidates, PosesPerView=1)).GetNumberOfPoints() == len(set(views)) < 4, "one of each view")
few = score(scene.surface, PointStride=4)
check(0.9 < few <= 1 and few != score(scene.surface), f"a quarter of the points tells nearly the same: {few}")
for threads in (1, 2):
    check(tuples(run(verification(candidates, scene.surface, NumberOfThreads=threads)), "Score")
          == tuples(run(verification(candidates, scene.surface)), "Score"), f"{threads} threads")
check(is_empty(run(verification(vtkPolyData()))), "no poses, no error")

# A wall between the sensor and the part: all of it is hidden. Behind the part it hides nothing.
center = [sum(c) / len(c) for c in zip(*points(scene.surface))]


def wall(distance):
    """Along the view, `distance` mm behind the part's middle."""
    x, y, z = scene.looking
    u = (y, -x, 0) if abs(z) < 0.9 else (0, z, -y)
    u = [c / math.hypot(*u) for c in u]
    v = (y * u[2] - z * u[1], z * u[0] - x * u[2], x * u[1] - y * u[0])
    return [[center[k] + distance * scene.looking[k] + i * u[k] + j * v[k] for k in range(3)]
            for j in range(-60, 61) for i in range(-60, 61)]


hidden = cloud(wall(-80))
check(visible(scene.surface) > 0.9, f"nothing in front: {visible(scene.surface)}")
check(visible(hidden) < 0.05, f"a wall in front: {visible(hidden)}")
check(visible(cloud(points(scene.surface) + wall(80))) > 0.9, "a wall behind")

# The same wall as an organized cloud is seen from the origin along +z: from there it is elsewhere.
sheet = [(x, y, 20.0) for y in range(-100, 101, 2) for x in range(-40, 161, 2)]
front = grid(101, 101, sheet)
check(visible(front) < 0.05, "automatic: an organized cloud at z = 20 hides what lies farther along +z")
check(visible(front, Projection=2, ViewDirection=(0, 0, 1)) == visible(front), "perspective from the origin along +z")
check(visible(front, Projection=1, ViewDirection=(0, 0, -1)) > 0.9, "from above it lies below the part")
check(visible(cloud(sheet), ViewDirection=(0, 0, -1)) > 0.9,
      "automatic: any other cloud is seen along the view direction")
check(visible(cloud(sheet), Projection=2, ViewDirection=(0, 0, -1), SensorPosition=(100, 0, 1000)) > 0.9,
      "from 1 m above")

# A file's rotation of few decimals comes out as a rotation.
rounded = run(verification(poses(tuple(round(c, 4) for c in scene.transform))))
check(is_rotation(tuples(rounded, "Transform")[0]), "the rotation of few decimals")

fails(verification(poses(tuple(2 * c for c in scene.transform))), "pose 1", "rotation")
fails(verification(poses(shifted(math.nan))), "pose 1")
fails(verification(cloud([(0, 0, 0)])), "Transform")
fails(verification(candidates, edges=vtkPolyData()), "no points")
fails(verification(candidates, edges=scene.edges), "Tangent", "TangentEstimation")
fails(verification(candidates, cloud([(math.nan, 0, 0)] * 4)), "surface", "NaN")
fails(verification(candidates, vtkPolyData()), "surface", "no points")
fails(verification(candidates, model=run(trained.tangents)), "not a trained model")
fails(verification(candidates, ViewDirection=(0, 0, 0)), "view direction is zero")
metres = cloud([tuple(1e-3 * c for c in p) for p in points(edges)], Tangent=tuples(edges, "Tangent"))
fails(verification(candidates, edges=metres), "units differ")
fails(verification(image()), "vtkPolyData")
fails(verification(candidates, image()), "vtkPointSet")
fails(connect(vtkMEAMPoseVerification(), candidates, model), "the input Scene Edges")
