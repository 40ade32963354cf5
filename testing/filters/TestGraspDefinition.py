# SPDX-License-Identifier: BSD-3-Clause
"""Grasps of a file, by hand and from the mesh, in this order; what is written is read again."""
import json
import math
import os

from ppfmeam.filters import vtkMEAMGraspDefinition, vtkMEAMGraspWriter, vtkMEAMSurfaceSampling, vtkMEAMSymmetryDetection
from meamtest import Errors, Folder, box, check, close, cloud, connect, fails, is_empty, run, texts, tuples

path = Folder()
part = box(20, 40, 30, origin=(-10, -20, -15))


def definition(*inputs, **properties):
    return connect(vtkMEAMGraspDefinition(), *inputs, **properties)


def names(data):
    return texts(data, "GraspName")


# Proposed for jaws: the best at the middle of the box, with the way in along z of the frame.
filter = definition(part)
grasps = run(filter)
count = grasps.GetNumberOfPoints()
check(count == 20 and grasps.GetNumberOfVerts() == count, f"{count} grasps")
check(names(grasps)[:2] == ["parallel 1", "parallel 2"], f"{names(grasps)}")
check(set(tuples(grasps, "Kind")) == {(0,)}, "jaws")
qualities = [q for q, in tuples(grasps, "Quality")]
check(qualities == sorted(qualities, reverse=True) and qualities[0] == 1, f"{qualities}")
check(grasps.GetPointData().GetScalars().GetName() == "Quality", "colored by quality")
check(close(grasps.GetPoint(0), (0, 0, 0)), f"{grasps.GetPoint(0)}")
for transform, (width,) in zip(tuples(grasps, "Transform"), tuples(grasps, "Width")):
    closing = [abs(transform[k]) for k in (0, 4, 8)]
    check(close([width], [20 * closing[0] + 40 * closing[1] + 30 * closing[2]]), f"{width} mm along {closing}")
glyphs = filter.GetOutputDataObject(1)
check(glyphs.GetNumberOfPolys() == count * 36, f"{glyphs.GetNumberOfPolys()} triangles: three boxes a grasp")
check([glyphs.GetCellData().GetArray("Grasp").GetTuple1(i) for i in (0, 35, 36)] == [1, 1, 2], "the grasps are numbered")
check(glyphs.GetCellData().GetScalars().GetName() == "Quality", "colored by quality")

# For a cup, for both, for none; narrower jaws hold less.
cups = run(definition(part, Propose=2, CupDiameter=15.0))
check(cups.GetNumberOfPoints() > 3 and set(tuples(cups, "Kind")) == {(1,)} == set(tuples(cups, "FreeTurn")), "cups")
both = run(definition(part, Propose=3, MaximumNumberOfGrasps=2))
check(names(both) == ["parallel 1", "parallel 2", "suction 1", "suction 2"], f"{names(both)}")
check(is_empty(run(definition(part, Propose=0))), "nothing is proposed")
check({w for w, in tuples(run(definition(part, Opening=27.0)), "Width")} == {20.0}, "20 mm and 2 x 3 mm fit into 27 mm")

# Symmetries come from the samples, or from the mesh, and go on.
samples = connect(vtkMEAMSymmetryDetection(), connect(vtkMEAMSurfaceSampling(), part))
some = run(definition(part, samples, MaximumNumberOfGrasps=1000))
all_of_them = run(definition(part, MaximumNumberOfGrasps=1000))
check(0 < some.GetNumberOfPoints() < 0.6 * all_of_them.GetNumberOfPoints(),
      f"{some.GetNumberOfPoints()} of {all_of_them.GetNumberOfPoints()}")
check(some.GetFieldData().GetArray("SymmetriesDiscrete").GetNumberOfTuples() == 3, "the symmetries go on")

# By hand: from above, the jaws close on the box and the origin comes to its middle. A width that is given stays.
hand = definition(part, Propose=0, HandGrasp=1, HandPosition=(3, 5, 10))
grasp = run(hand)
check(names(grasp) == ["by hand"] and tuples(grasp, "Width") == [(20,)] and close(grasp.GetPoint(0), (0, 5, 10)),
      f"{grasp.GetPoint(0)}")
check(close(tuples(grasp, "Transform")[0], (1, 0, 0, 0, 0, -1, 0, 5, 0, 0, -1, 10, 0, 0, 0, 1), 1e-12), "from above")
hand.SetHandRotation(180, 0, 90)
check(tuples(run(hand), "Width") == [(40,)], "turned, they close along y")
hand.SetHandWidth(7)
check(tuples(run(hand), "Width") == [(7,)] and close(hand.GetOutput().GetPoint(0), (3, 5, 10)), "as it was given")
cup = run(definition(part, Propose=0, HandGrasp=2, HandPosition=(3, 5, 60)))
check(close(cup.GetPoint(0), (3, 5, 15)) and tuples(cup, "Kind") == [(1,)], f"a cup goes down: {cup.GetPoint(0)}")
fails(definition(part, HandGrasp=1, HandPosition=(0, 0, 40)), "by hand", "closes on nothing")

# A file comes first; what is written is read again.
writer = connect(vtkMEAMGraspWriter(), definition(part, Propose=3, MaximumNumberOfGrasps=3, HandGrasp=1))
writer.SetFileName(path("part.grasps"))
check(writer.Write() == 1, "Write() succeeds")
with open(path("part.grasps")) as stream:
    file = json.load(stream)
check((file["format"], file["version"], file["units"], len(file["grasps"])) == ("meam-grasps", 1, "mm", 7), f"{file}")
read = run(definition(part, Propose=0, FileName=path("part.grasps")))
check(names(read)[:2] == ["by hand", "parallel 1"] and read.GetNumberOfPoints() == 7, f"{names(read)}")
written = run(writer.GetInputAlgorithm())
for key in ("Transform", "Kind", "Width", "FreeTurn", "Quality"):
    for a, b in zip(tuples(read, key), tuples(written, key)):
        check(close(a, b, 1e-12), f"{key}: {a} and {b}")
again = run(definition(part, FileName=path("part.grasps"), MaximumNumberOfGrasps=1))
check(names(again)[-1] == "parallel 1 (2)", f"names stay apart: {names(again)}")

# Any gripper as a mesh: one that is wider than the box on all sides grasps nothing.
wall = box(200, 200, 2, origin=(-100, -100, 2))
check(is_empty(run(definition(part, connect(vtkMEAMSurfaceSampling(), part), wall))), "a wall is in the way")

# Errors.
fails(definition(part, FileName=path("bad.grasps", '{"poses": []}')), "bad.grasps", "'format'")
fails(definition(cloud([(0, 0, 0)])), "no faces")
fails(definition(part, Opening=-1.0), "gripper's opening")
for name, value, *words in (("FrictionAngle", 120.0, "friction angle", "0.1 to 89 degrees", "120"),
                            ("MaximumNumberOfGrasps", -1, "maximum number of grasps", "0 or more", "-1"),
                            ("Spread", -2.0, "spread", "0 mm or more", "-2")):
    fails(definition(part, Propose=1, **{name: value}), *words)
fails(definition(part, HandGrasp=1, HandWidth=-5.0), "hand width", "0 mm or more", "-5")
for data, word in ((box(1, 1, 1), "Transform"), (cloud([(0, 0, 0)], Transform=[(2, *[0] * 15)]), "rotation")):
    refused = connect(vtkMEAMGraspWriter(), data, FileName=path("refused.grasps"))
    errors = Errors(refused)
    check(not refused.Write() and word in str(errors) and not os.path.exists(path("refused.grasps")), f"{errors}")
check(math.isclose(vtkMEAMGraspDefinition().GetFrictionAngle(), 15), "the default")
