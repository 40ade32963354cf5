# SPDX-License-Identifier: BSD-3-Clause
"""Clusters, alternatives and instances of scored poses."""
import math

from vtkmodules.vtkCommonDataModel import vtkPolyData

from ppfmeam.filters import vtkMEAMPoseSelection, vtkMEAMPoseVerification
from meamtest import check, cloud, connect, fails, field, image, is_empty, pose_error, poses, run, trained_bracket, tuples

_, model, scene, edges = trained_bracket()
diameter = field(model, "Diameter")[0][0]
shifted = scene.shifted


def selection(candidates, surface=scene.surface, method="Instances", **properties):
    scored = connect(vtkMEAMPoseVerification(), candidates, model, edges, surface, ViewDirection=scene.looking)
    filter = connect(vtkMEAMPoseSelection(), scored, model, edges, surface, ViewDirection=scene.looking)
    getattr(filter, "SetMethodTo" + method)()
    return connect(filter, **properties)


def count(*args, **properties):
    return run(selection(*args, **properties)).GetNumberOfPoints()


# A copy 0.5 mm away, one 60 mm away, one upside down, and the true one.
far = math.sqrt(3) * 60 / 3
candidates = poses(shifted(far, far, far), shifted(0.3, 0.3, 0.3), shifted(turned=True), shifted())
for surface in (None, scene.surface):
    check(count(candidates, surface) == 2, "instances: the one upside down shares its surface with the true one")
    check(count(candidates, surface, "Clusters") == 3, "clusters: one of each place")
for surface in (None, scene.surface):
    check(count(candidates, surface, "Alternatives") == 2, "alternatives: where nothing is there is nothing to refine")
best = run(selection(candidates))
mm, degrees = pose_error(tuples(best, "Transform")[0], scene.transform)
check(mm < 0.1 and degrees < 0.2, f"the first is the true one, aligned: {mm} mm, {degrees} degrees off")
check(tuples(best, "Iterations")[0][0] > 0 and tuples(best, "ConstrainedDegreesOfFreedom")[0] == (6,), "the scene fixes it")
check([r for r, in tuples(best, "Rank")] == [1, 2], "ranks count from 1")
check(all(0 < c <= 1 for c, in tuples(best, "Certainty")), "certainties")
check(field(best, "Diameter") == [(diameter,)], "the diameter travels along")
clusters = tuples(run(selection(candidates, method="Clusters")), "Transform")
check(any(all(abs(a - b) < 1e-9 for a, b in zip(clusters[0], t)) for t in tuples(candidates, "Transform")),
      "clusters leave poses where they are")
wide = {"surface": None, "method": "Alternatives", "ClusterDistance": 0.6 * diameter}  # upside down is in one with the true one
check([count(candidates, PosesPerInstance=n, **wide) for n in (1, 2, 9)] == [1, 2, 2], "alternatives of an instance")
check(count(candidates, method="Clusters", ClusterDistance=0.01) == 4, "small clusters")
check(count(candidates, MaximumNumberOfPoses=1) == 1, "as many poses as asked for")
check(count(candidates, MinimumProbability=0.9) == 1, "the likely one alone")
for threads in (1, 2):
    check(tuples(run(selection(candidates, NumberOfThreads=threads)), "Transform") == tuples(best, "Transform"),
          f"{threads} threads")
check(is_empty(run(selection(vtkPolyData()))), "no poses, no error")

fails(connect(vtkMEAMPoseSelection(), poses(shifted(math.nan)), model, edges), "pose 1")
fails(connect(vtkMEAMPoseSelection(), cloud([(0, 0, 0)]), model, edges), "Transform")
fails(connect(vtkMEAMPoseSelection(), image(), model, edges), "vtkPolyData")
