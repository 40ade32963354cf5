# SPDX-License-Identifier: BSD-3-Clause
"""Of a box each of six viewpoints sees one side."""
import math

from vtkmodules.vtkCommonDataModel import vtkPolyData

from ppfmeam.filters import vtkMEAMSurfaceSampling, vtkMEAMVisibilityExtraction
from meamtest import box, check, close, cloud, connect, fails, field, image, partitions, points, prints, run, tuples

SIZE = (10, 10, 10)
DIRECTIONS = [(0, 0, 1), (0, 0, -1), (1, 0, 0), (-1, 0, 0), (0, 1, 0), (0, -1, 0)]


def views(data, number=None):
    filter = connect(vtkMEAMVisibilityExtraction(), data)
    if number:
        filter.SetNumberOfViewpoints(number)
    return filter


sampling = connect(vtkMEAMSurfaceSampling(), box(*SIZE))
sampling.SetSpacing(0.5)
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

fails(views(vtkPolyData()), "no points")
fails(views(cloud([(math.nan, 0, 0)] * 5)), "NaN")
fails(views(image()), "vtkPolyData")
filter = vtkMEAMVisibilityExtraction()
filter.SetNumberOfViewpoints(0)
check(filter.GetNumberOfViewpoints() == 1, "at least one viewpoint")
prints(filter, "NumberOfViewpoints", "RadiusFactor", "ViewpointDistance")
