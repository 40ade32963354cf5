# SPDX-License-Identifier: BSD-3-Clause
"""A box at every pose, in the colour of its rank, and how uncertain it is."""
from vtkmodules.vtkCommonDataModel import vtkCellArray, vtkPolyData

from ppfmeam.filters import vtkMEAMPoseInstances
from meamtest import box, check, close, cloud, connect, fails, field, is_empty, points, poses, run, set_fields, tuples


def at(x, turned=False):
    return (0, -1, 0, x, 1, 0, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1) if turned else (1, 0, 0, x, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1)


part = box(1, 2, 3)
found = set_fields(poses(at(10), at(20, turned=True)), Diameter=3.7)
filter = connect(vtkMEAMPoseInstances(), found, part)
copies = run(filter)
check(copies.GetNumberOfPoints() == 16 and copies.GetNumberOfPolys() == 24, "two boxes")
check(points(copies)[:8] == [(x + 10, y, z) for x, y, z in points(part)], "the first is shifted")
check(all(close(a, (20 - y, x, z)) for a, (x, y, z) in zip(points(copies)[8:], points(part))), "the second is turned")
check(tuples(copies, "Rank") == [(1,)] * 8 + [(2,)] * 8, "points know their rank")
cells = copies.GetCellData()
check([cells.GetArray("Rank").GetValue(i) for i in range(24)] == [1] * 12 + [2] * 12, "cells know their rank")
check(copies.GetPointData().GetScalars().GetName() == "Rank" == cells.GetScalars().GetName(), "ranks are active")
check(field(copies, "Diameter") == [(3.7,)], "field data travel along")
check(points(part) == points(box(1, 2, 3)), "the mesh is not changed")

# Red, green, blue, yellow, pink: told by which channels are strong; the same, dark. Then grey.
many = cloud([(0, 0, 0)] * 12, Transform=[at(i) for i in range(12)], Score=[0.9 - 0.05 * i for i in range(12)])
filter = connect(vtkMEAMPoseInstances(), many, part)
copies = run(filter)
colors = [tuples(copies, "RankColor")[8 * i] for i in range(12)]
strong = [tuple(c > 160 for c in color) for color in colors[:5]]
check(strong == [(1, 0, 0), (0, 1, 0), (0, 0, 1), (1, 1, 0), (1, 0, 1)], f"the colours are {colors}")
check(all(max(dark) < 0.7 * max(color) for dark, color in zip(colors[5:10], colors)), f"the dark ones are {colors[5:10]}")
check(len(set(colors[:11])) == 11, f"each rank has its own: {colors}")
check(len(set(colors[10])) == 1 and colors[10] == colors[11], f"later ranks are grey: {colors[10:]}")
check(close(tuples(copies, "Score")[8 * 6], (0.6,)), "the score is there")
ranked = cloud([(0, 0, 0)] * 2, Transform=[at(0), at(1)], Rank=[2, 19])
check([tuples(run(connect(vtkMEAMPoseInstances(), ranked, part)), name)[i] for i in (0, 8) for name in ("Rank", "RankColor")]
      == [(2,), colors[1], (19,), colors[10]], "poses keep the ranks that they have")
filter.SetMaximumNumberOfInstances(3)
check({r for r, in tuples(run(filter), "Rank")} == {1, 2, 3}, "only the best")

# Poses that are more likely wrong than right are left out of the picture; those of unknown probability are not.
doubtful = cloud([(0, 0, 0)] * 4, Transform=[at(i) for i in range(4)], Probability=[0.9, 0.4, 0.0, 0.51],
                 Certainty=[1, 0.25, 0.5, 0.75], VisibleFraction=[0.1, 0.2, 0.3, 0.4])
filter = connect(vtkMEAMPoseInstances(), doubtful, part)
for least, ranks in ((0.5, [1, 3, 4]), (0.6, [1, 3]), (0.0, [1, 2, 3, 4])):
    check(filter.GetMinimumProbability() == 0.5 or least != 0.5, "those more likely than not")
    filter.SetMinimumProbability(least)
    copies = run(filter)
    check([r for r, in tuples(copies, "Rank")][::8] == ranks, f"likelier than {least}: {tuples(copies, 'Rank')[::8]}")
    text = filter.GetOutputDataObject(2).GetValueByName(0, "Text").ToString()
    told = {3: "1 of 4 poses is not shown: a copy is there with less than 50 % (MinimumProbability).",
            2: "2 of 4 poses are not shown: a copy is there with less than 60 % (MinimumProbability).", 4: ""}
    check(text.replace("\n", " ") == told[len(ranks)], f"of poses that are hidden: {text}")
for name in ("Probability", "Certainty", "VisibleFraction"):
    check(tuples(copies, name)[::8] == tuples(doubtful, name), f"{name} of points is that of the pose")
    check(copies.GetCellData().GetArray(name).GetValue(12) == tuples(doubtful, name)[1][0], f"{name} of cells, too")

check(run(connect(vtkMEAMPoseInstances(), poses(), part)).GetNumberOfPoints() == 0, "no poses, no copies")
points_only = run(connect(vtkMEAMPoseInstances(), found, cloud([(0, 0, 0), (1, 0, 0)])))
check(points_only.GetNumberOfVerts() == 4, "a part of points is fine")
mixed, lines, strips = cloud([(0, 0, 0), (1, 0, 0), (0, 1, 0), (1, 1, 0)]), vtkCellArray(), vtkCellArray()
lines.InsertNextCell(3, [0, 1, 2])
strips.InsertNextCell(4, [0, 1, 2, 3])
mixed.SetLines(lines)
mixed.SetStrips(strips)
copies = run(connect(vtkMEAMPoseInstances(), found, mixed))
check([copies.GetCellData().GetArray("Rank").GetValue(i) for i in range(12)] == [1] * 4 + [2] * 4 + [1, 2, 1, 2],
      "values stand with the cells, kind by kind")
second = copies.GetCell(9).GetPointIds()
check([second.GetId(i) for i in range(3)] == [4, 5, 6], "the second line is of the second copy")

# How uncertain a pose is, when asked for: an ellipsoid about the part's middle, and of what does not tell it an error.
deviations = (0.1, 0.2, 0.3)
covariance = [0.0] * 36
for axis, deviation in enumerate(deviations):
    covariance[7 * (3 + axis)] = deviation ** 2
uncertain = set_fields(cloud([(0, 0, 0)] * 2, Transform=[at(10), at(20)], Probability=[0.9, 0.4],
                             Residual=[0.1] * 2, Iterations=[5] * 2, Covariance=[covariance] * 2,
                             ConstrainedDegreesOfFreedom=[6] * 2, ConstrainedAxes=[(1,) * 6] * 2), PartBounds=(0, 1, 0, 2, 0, 3), PartMiddle=(0.5, 1, 1.5))
filter = connect(vtkMEAMPoseInstances(), uncertain, part)
run(filter)
check(is_empty(filter.GetOutputDataObject(1)), "no ellipsoids without a wish")
filter.SetUncertaintyScale(20)
run(filter)
ellipsoids = filter.GetOutputDataObject(1)
bounds = ellipsoids.GetBounds()
check(close([bounds[2 * k + 1] - bounds[2 * k] for k in range(3)], [40 * d for d in deviations], 1e-3), f"{bounds}")
check(close([(bounds[2 * k + 1] + bounds[2 * k]) / 2 for k in range(3)], (10.5, 1, 1.5), 1e-3), f"{bounds}")
check({r for r, in tuples(ellipsoids, "Rank")} == {1}, "of the likely pose alone")
filter.SetInputDataObject(0, found)
fails(filter, "UncertaintyScale")

fails(connect(vtkMEAMPoseInstances(), found, vtkPolyData()), "CAD mesh", "no points")
fails(connect(vtkMEAMPoseInstances(), part, part), "Transform")
fails(connect(vtkMEAMPoseInstances(), poses((float("nan"),) * 16), part), "not a rotation")
fails(connect(vtkMEAMPoseInstances(), found))

# A number that is none is no 0; only what a pose file does not have to know of all its poses may lack.
for name, value, *words in (("Evidence", float("nan"), "Pose 2 has a 'Evidence' that is not a number"), ("Score", float("nan"), "'Score'", "take the pose out"),
                            ("Votes", float("nan"), "Value 2 of the array 'Votes'", "whole"), ("Votes", 3e9, "up to 2147483647, not 3e+09"), ("Rank", 1.5, "'Rank'", "1.5"),
                            ("PartId", float("nan"), "'PartId'", "whole"), ("Certainty", float("nan"))):
    lacking = poses(at(10), at(20))
    lacking.GetPointData().AddArray(cloud([(0, 0, 0)] * 2, **{name: [1, value]}).GetPointData().GetArray(name))
    filter = connect(vtkMEAMPoseInstances(), lacking, part, MinimumProbability=0)
    filter.AddInputDataObject(1, part)
    fails(filter, *words) if words else check(run(filter).GetNumberOfPoints() == 16, f"{name} is not known of one")
