# SPDX-License-Identifier: BSD-3-Clause
"""A box has three half turns; with a notch it keeps them nearly, and the deviation shows the notch."""
import json
import math

from vtkmodules.vtkCommonDataModel import vtkPolyData

from ppfmeam.filters import vtkMEAMSurfaceSampling, vtkMEAMSymmetryDetection
from meamtest import Folder, box, check, cloud, connect, fails, field, image, mesh, points, run, text, tuples


def detection(data, spacing=0.8):
    return connect(vtkMEAMSymmetryDetection(), connect(vtkMEAMSurfaceSampling(), data, Spacing=spacing))


found = run(detection(box(30, 20, 10)))
check(field(found, "SymmetriesContinuous") == [], "a box has no axis of revolution")
turns = field(found, "SymmetriesDiscrete")
check(len(turns) == 3, f"{len(turns)} turns of a box")
for turn in turns:
    check(abs(turn[0] + turn[5] + turn[10] + 1) < 1e-3, f"not half a turn: {turn}")
    centre = [sum(turn[4 * row + k] * c for k, c in enumerate((15, 10, 5, 1))) for row in range(3)]
    check(math.dist(centre, (15, 10, 5)) < 0.1, f"the middle moves to {centre}")
check(max(tuples(found, "Deviation")) == (0,), "nothing deviates")
entry = json.loads(text(found, "ModelsInfo"))
check(len(entry["symmetries_discrete"]) == 3 and abs(entry["size_x"] - 30) < 0.01, f"models_info.json: {entry}")
check(len(field(found, "Diameter")) == 1, "the diameter travels on")

# The corner at (30, 20) cut off by 4 mm.
outline = [(0, 0), (30, 0), (30, 16), (26, 20), (0, 20)]
low, high = [(x, y, 0) for x, y in outline], [(x, y, 10) for x, y in outline]
sides = [(i, (i + 1) % 5, 5 + (i + 1) % 5, 5 + i) for i in range(5)]
filter = detection(mesh(low + high, [(4, 3, 2, 1, 0), (5, 6, 7, 8, 9)] + sides))
found = run(filter)
check(field(found, "SymmetriesDiscrete") == [], "the cut breaks all turns")
check(len(field(found, "NearSymmetries")) == 3, f"{len(field(found, 'NearSymmetries'))} near-symmetries")
for (overlap,), (largest,) in zip(field(found, "NearSymmetryOverlap"), field(found, "NearSymmetryDeviation")):
    check(0.8 < overlap < 1 and largest > 1, f"overlap {overlap}, deviation {largest} mm")
for place, (deviation,) in zip(points(found), tuples(found, "Deviation")):
    nearest = min(math.hypot(place[0] - x, place[1] - y) for x in (0, 30) for y in (0, 20))
    check(deviation < 0.5 or nearest < 5, f"{place} deviates by {deviation} mm")
check(max(tuples(found, "Deviation"))[0] > 1, "the cut deviates")
filter.SetShownNearSymmetry(99)
check(max(tuples(run(filter), "Deviation")) == (0,), "there is no hundredth near-symmetry to show")
filter.SetLeastOverlap(1.0)
check(field(run(filter), "NearSymmetries") == [], "none keeps all of the surface")

fails(connect(vtkMEAMSymmetryDetection(), vtkPolyData()), "no points")
fails(connect(vtkMEAMSymmetryDetection(), cloud([(0, 0, 0), (1, 0, 0), (0, 1, 0)])), "no normals")
fails(connect(vtkMEAMSymmetryDetection(), image()), "vtkPolyData")

# Exact symmetries from a file: the box is said to have one half turn alone.
folder = Folder()
turned = [-1, 0, 0, 30, 0, -1, 0, 20, 0, 0, 1, 0, 0, 0, 0, 1]
filter = detection(box(30, 20, 10))
filter.SetModelsInfoFile(folder("models_info.json", json.dumps({"4": {"symmetries_discrete": [turned]}})))
filter.SetObjectId(4)
check(field(run(filter), "SymmetriesDiscrete") == [tuple(turned)], "the symmetries of the file")
filter.SetObjectId(5)
fails(filter, "no object 5")
