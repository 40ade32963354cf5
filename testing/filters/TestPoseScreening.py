# SPDX-License-Identifier: BSD-3-Clause
"""Duplicates go, and what has no surface; what stays is turned where the edges speak for it."""
import math

from vtkmodules.vtkCommonDataModel import vtkPolyData

from ppfmeam.filters import vtkMEAMPoseScreening
from meamtest import check, cloud, connect, fails, field, image, is_empty, poses, run, trained_bracket, tuples

_, model, scene, edges = trained_bracket()
diameter = field(model, "Diameter")[0][0]
shifted = scene.shifted


def screening(candidates, surface=scene.surface, **properties):
    return connect(vtkMEAMPoseScreening(), candidates, model, edges, surface, **{"ViewDirection": scene.looking, **properties})


def kept(*args, **properties):
    return tuples(run(screening(*args, **properties)), "Transform")


past = shifted(*(-40 * c for c in scene.looking))  # nearer to the sensor: it saw past the part
near = shifted(0.3, 0.3, 0.3)
candidates = poses(past, near, shifted(), shifted(turned=True))
check(len(kept(candidates)) == 3, "of few candidates only the duplicate goes")
check(len(kept(candidates, Enough=0)) == 2, "what has no surface goes")
check(past[3] not in [t[3] for t in kept(candidates, Enough=0)], "it is the one that the sensor saw past")
check(len(kept(candidates, None, Enough=0)) == 3, "without a surface only the duplicate goes")
check(len(kept(candidates, Enough=0, LeastSurface=0)) == 3, "no surface asked for")

# Of duplicates that with more votes stays.
voted = cloud([t[3::4][:3] for t in (shifted(), near)], Transform=[shifted(), near], Votes=[10, 20])
check(all(abs(a - b) < 1e-9 for a, b in zip(kept(voted)[0], near)), "more votes stay")
check(field(run(screening(candidates)), "Diameter") == [(diameter,)], "the diameter travels along")
for threads in (1, 2):
    check(kept(candidates, NumberOfThreads=threads) == kept(candidates), f"{threads} threads")
check(is_empty(run(screening(vtkPolyData()))), "no poses, no error")

fails(screening(poses(shifted(math.nan))), "pose 1")
fails(screening(cloud([(0, 0, 0)])), "Transform")
fails(screening(image()), "vtkPolyData")
