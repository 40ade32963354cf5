# SPDX-License-Identifier: BSD-3-Clause
"""Voting finds the motion of a part's own edges; the same for any number of threads."""
import math

from vtkmodules.vtkCommonDataModel import vtkPolyData

from ppfmeam.filters import vtkMEAMPoseDetection
from meamtest import (Warnings, check, close, cloud, connect, fails, field, image, is_empty, points, pose_error, run,
                      trained_bracket, tuples)

trained, model, scene, edges = trained_bracket()
diameter = field(model, "Diameter")[0][0]


def detection(edges=edges, model=model, **properties):
    return connect(vtkMEAMPoseDetection(), edges, model, **{"ReferenceShare": 0.8, **properties})


found = run(detection())
transforms, votes = tuples(found, "Transform"), tuples(found, "Votes")
count = found.GetNumberOfPoints()
check(100 < count <= math.ceil(0.8 * edges.GetNumberOfPoints()), f"{count} candidates")
good = [pose_error(t, scene.transform) for t in transforms]
right = sum(mm < 0.1 * diameter and degrees < 15 for mm, degrees in good)
check(right > 0.9 * count, f"{right} of {count} candidates are near the motion")
check(field(found, "Diameter") == [(diameter,)], "the diameter travels along")
check(tuples(found, "Rank") == [(i + 1,) for i in range(count)], "ranks count from 1")
check(all(v > 0 for v, in votes) and all(0 <= v < 6 for v, in tuples(found, "ViewId")), "votes and views")
check(tuples(found, "Score") == [(0,)] * count, "no score before verification")
for place, transform, quaternion in zip(points(found), transforms, tuples(found, "Quaternion")):
    check(close(place, transform[3:12:4]), "the point is where the part's origin lies")
    x, y, z, w = quaternion
    rotation = (1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w), 0,
                2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w), 0,
                2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y), 0)
    check(all(abs(rotation[i] - transform[i]) < 1e-5 for i in (0, 1, 2, 4, 5, 6, 8, 9, 10)),
          "the quaternion is the rotation, x y z w")
    check(w >= 0 and transform[12:] == (0, 0, 0, 1), "row by row, the last row 0 0 0 1")

for threads in (1, 2, 3):
    check(tuples(run(detection(NumberOfThreads=threads)), "Transform") == transforms, f"{threads} threads")
check(tuples(run(detection(Seed=2)), "Transform") != transforms, "another seed chooses other points")
check(run(detection(ReferenceShare=0.1)).GetNumberOfPoints() <= 100, "no more than the least number of reference points")

single = tuples(run(detection(SmoothPeaks=False)), "Votes")
check(len(single) == count and all(one <= three for (one,), (three,) in zip(single, votes)) and single != votes,
      "one turn has no more votes than three")
check(tuples(run(detection(SignedTangents=False)), "Transform") != transforms, "the signs of tangents matter")

# Single invalid points do not matter.
holes = cloud(points(edges) + [(math.nan, 0, 0)], Tangent=tuples(edges, "Tangent") + [(1, 0, 0)])
check(not is_empty(run(detection(holes))), "a point of NaN")
whole = cloud(points(edges), Tangent=tuples(edges, "Tangent"))
undirected = cloud(points(edges) + points(edges)[:2], Tangent=tuples(edges, "Tangent") + [(math.nan, 0, 0), (0, 0, 0)])
check(tuples(run(detection(undirected)), "Transform") == tuples(run(detection(whole)), "Transform"),
      "points without a direction do not count")

metres = cloud([tuple(1e-3 * c for c in p) for p in points(edges)], Tangent=tuples(edges, "Tangent"))
fails(detection(metres), "units differ", "1000")
smaller = detection(cloud([tuple(0.3 * c for c in p) for p in points(edges)], Tangent=tuples(edges, "Tangent")))
warnings = Warnings(smaller)
run(smaller)
check("likely factor is 10" in str(warnings), f"a scene that is unlikely small: {warnings}")
warnings = Warnings(detection())
run(warnings.algorithm)
check(not str(warnings), f"nothing to warn of: {warnings}")
fails(detection(vtkPolyData()), "no points")
fails(detection(cloud([(math.nan, 0, 0)] * 5, Tangent=[(1, 0, 0)] * 5)), "NaN")
fails(detection(scene.edges), "Tangent", "TangentEstimation")
fails(detection(model=run(trained.tangents)), "not a trained model", "MEAMHashing")
fails(detection(image()), "vtkPolyData")
fails(detection(model=image()), "vtkPartitionedDataSetCollection")
fails(connect(vtkMEAMPoseDetection(), edges), "the input Model")
