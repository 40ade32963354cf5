# SPDX-License-Identifier: BSD-3-Clause
"""The floor, what is outside a region and what a mask hides are blanked; the rest and its arrays stay."""
import math

from vtkmodules.vtkCommonCore import vtkUnsignedCharArray
from vtkmodules.vtkCommonDataModel import vtkStructuredGrid

from ppfmeam.filters import vtkMEAMBackgroundRemoval, vtkMEAMSceneEdgeExtraction
from meamtest import box, check, close, connect, fails, field, grid, image, picture, points, run, tuples

W, H = 60, 40
PART = {(x, y) for x in range(10, 25) for y in range(10, 30)}


def scan(part=30.0):
    """A floor at 800 mm, points 1 mm apart, with a block on it; grey values that count the points."""
    pixels = [(x, y) for y in range(H) for x in range(W)]
    data = grid(W, H, [(math.nan,) * 3] + [(x, y, 800.0 - part * ((x, y) in PART)) for x, y in pixels[1:]])
    grey = vtkUnsignedCharArray()
    grey.SetName("Intensity")
    for pixel in pixels:
        grey.InsertNextValue(200 if pixel in PART else 50)
    data.GetPointData().AddArray(grey)
    return data


def removal(*inputs, **properties):
    return connect(vtkMEAMBackgroundRemoval(), *inputs, **properties)


def kept(filter):
    data = run(filter)
    return {(i % W, i // W) for i, p in enumerate(points(data)) if math.isfinite(p[2])}


filter = removal(scan())
check(kept(filter) == PART, "the block alone is left")
output = filter.GetOutput()
check({(i % W, i // W) for i in range(W * H) if output.IsPointVisible(i)} == PART, "the rest is blanked")
check(tuples(output, "Intensity") == tuples(scan(), "Intensity"), "arrays stay")
check([r for r, in tuples(output, "Background")][:2] == [0, 3], "a point without depth was no plane's")
(plane,) = field(output, "Planes")
check(close(plane, (0, 0, -1, 800), 1e-3), f"the floor is {plane}")
# Edges on the floor vanish, those of the block stay.
edges = run(connect(vtkMEAMSceneEdgeExtraction(), filter))
check(edges.GetNumberOfPoints() > 50 and all(p[2] == 770 for p in points(edges)), "edges of the block")

# A thin part is in the tolerance or is not.
check(len(kept(removal(scan(1.0)))) == 0 and kept(removal(scan(1.0), Tolerance=0.5)) == PART, "the tolerance")
everything = W * H - 1
check(len(kept(removal(scan(), NumberOfPlanes=0))) == everything, "no planes")
check(len(kept(removal(scan(), LeastShare=95))) == everything, "the floor is smaller than that")

# Region and mask; an axis without limits.
inside = {(x, y) for x in range(12, 21) for y in range(H)}
check(kept(removal(scan(), NumberOfPlanes=0, Region=(12, 20, 0, 0, 0, 0))) == inside, "between x = 12 and 20")
check(kept(removal(scan(), NumberOfPlanes=0, Region=(12, 20, 0, 0, 0, 790))) == inside & PART, "and above the floor")
mask = picture([[255] * W] * 3 + [[0] * W] * (H - 3))
filter = removal(scan(), mask, NumberOfPlanes=0)
check(kept(filter) == {(x, y) for x in range(W) for y in range(3)} - {(0, 0)}, "the mask's upper rows")
check(tuples(filter.GetOutput(), "Background")[-1] == (1,), "the rest is masked")

fails(vtkMEAMBackgroundRemoval())
fails(removal(vtkStructuredGrid()), "no points")
fails(removal(box(1, 1, 1)), "vtkStructuredGrid")
fails(removal(scan(), image(3, 4)), "no pixels")
mask.SetDimensions(H, W, 1)
fails(removal(scan(), mask), f"{H} x {W}", f"{W} x {H}")
fails(removal(scan(), Region=(3, 2, 0, 0, 0, 0)), "region")
