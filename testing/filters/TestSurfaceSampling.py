# SPDX-License-Identifier: BSD-3-Clause
"""A box is covered: samples lie on it, face outwards, keep their distance and leave no hole."""
import math

from vtkmodules.vtkCommonDataModel import vtkPolyData

from ppfmeam.filters import vtkMEAMSurfaceSampling
from meamtest import box, check, cloud, connect, fails, field, image, mesh, points, run, tuples

SIZE = (10, 20, 30)


def sample(data, spacing=0.0, seed=1):
    return connect(vtkMEAMSurfaceSampling(), data, Spacing=spacing, Seed=seed)


samples = run(sample(box(*SIZE), 2.0))
places, normals = points(samples), tuples(samples, "Normals")
check(tuples(samples, "PointId") == [(i,) for i in range(len(places))], "the points are counted")
check(abs(field(samples, "Diameter")[0][0] - math.dist((0, 0, 0), SIZE)) < 1e-4, "the diameter is that of the mesh")
check(samples.GetNumberOfVerts() == len(places), "every point is a vertex, to be seen")
for place, normal in zip(places, normals):
    axis = max(range(3), key=lambda k: abs(normal[k]))
    check(abs(abs(normal[axis]) - 1) < 1e-5, f"the normal {normal} is that of a side")
    check(abs(place[axis] - (SIZE[axis] if normal[axis] > 0 else 0)) < 1e-4, f"{place} with normal {normal}")
    check(all(-1e-4 <= c <= s + 1e-4 for c, s in zip(place, SIZE)), f"{place} is not on the box")

check(points(run(sample(box(*SIZE), 2.0))) == places, "the same seed gives the same samples")
check(points(run(sample(box(*SIZE), 2.0, seed=2))) != places, "another seed gives others")
automatic = run(sample(box(*SIZE))).GetNumberOfPoints()
given = run(sample(box(*SIZE), 0.01 * math.dist((0, 0, 0), SIZE))).GetNumberOfPoints()
check(automatic == given > 1000, "a spacing of 0 is 1 % of the diameter")

fails(sample(vtkPolyData()), "no faces")
fails(sample(cloud([(0, 0, 0), (1, 0, 0), (0, 1, 0)])), "no faces")
fails(sample(mesh([(0, 0, 0), (1, 0, math.nan), (0, 1, 0)], [(0, 1, 2)])), "not a number")
fails(sample(box(*SIZE), 1e-4), "spacing", "too small")
fails(sample(image()), "vtkPolyData")
