# SPDX-License-Identifier: BSD-3-Clause
"""Symmetries of real parts in $PPFMEAM_DATA, each turn checked by turning the samples and measuring how far they lie
from the mesh. Without --long those of three parts."""
import math
import os
import sys

from vtkmodules.vtkCommonCore import reference
from vtkmodules.vtkCommonDataModel import vtkGenericCell, vtkStaticCellLocator

from ppfmeam import scripting
from ppfmeam.filters import vtkMEAMSurfaceSampling, vtkMEAMSymmetryDetection
from meamtest import LONG, check, connect, field, points, run, skip

data = os.environ.get("PPFMEAM_DATA", "")
if not os.path.isdir(data):
    skip(f"no meshes below '{data}': set PPFMEAM_DATA")
Z, Y = (0, 0, 1), (0, 1, 0)
MEASURED = 400  # samples of each turn


def moved(transform, point):
    return [sum(transform[4 * row + k] * c for k, c in enumerate((*point, 1))) for row in range(3)]


def turn_of(transform):
    """Degrees and the unit axis, upwards."""
    t = transform
    degrees = math.degrees(math.acos(max(-1.0, min(1.0, (t[0] + t[5] + t[10] - 1) / 2))))
    # The axis is the longest column of R + R' + (1 - trace) I.
    trace = t[0] + t[5] + t[10]
    columns = [[t[4 * r + c] + t[4 * c + r] + (1 - trace) * (r == c) for r in range(3)] for c in range(3)]
    axis = max(columns, key=lambda column: math.hypot(*column))
    length = math.hypot(*axis) or 1.0
    return degrees, [a / length for a in axis]


class Part:
    """What the detection finds of a mesh."""

    def __init__(self, *path, scale=1.0):
        self.name = path[-1]
        self.mesh = scripting.read_mesh(os.path.join(data, *path), scale=scale)
        found = run(connect(vtkMEAMSymmetryDetection(), connect(vtkMEAMSurfaceSampling(), self.mesh)))
        self.samples = points(found)[::1 + found.GetNumberOfPoints() // MEASURED]
        self.tolerance = 0.01 * field(found, "Diameter")[0][0]
        self.continuous = field(found, "SymmetriesContinuous")
        self.exact = field(found, "SymmetriesDiscrete")
        self.near = field(found, "NearSymmetries")
        self.overlaps = [overlap for overlap, in field(found, "NearSymmetryOverlap")]
        self.locator = vtkStaticCellLocator()
        self.locator.SetDataSet(self.mesh)
        self.locator.BuildLocator()
        print(f"{self.name}: {'; '.join(scripting.symmetry_words(found))}")
        check(self.continuous == [], f"{self.name} has no axis of revolution")
        for transform in self.exact:
            distances = self.distances(transform)
            check(max(distances) < 1.2 * self.tolerance, f"{self.name}: {turn_of(transform)} is {max(distances)} mm off")
        for transform, overlap in zip(self.near, self.overlaps):
            distances = self.distances(transform)
            share = sum(d <= self.tolerance for d in distances) / len(distances)
            check(abs(share - overlap) < 0.06, f"{self.name}: {turn_of(transform)} keeps {share}, not {overlap}")

    def distances(self, transform):
        """Of the turned samples from the mesh."""
        result = []
        nearest, cell, number, part, squared = [0.0] * 3, vtkGenericCell(), reference(0), reference(0), reference(0.0)
        for point in self.samples:
            self.locator.FindClosestPoint(moved(transform, point), nearest, cell, number, part, squared)
            result.append(math.sqrt(squared.get()))
        return result

    def has(self, transforms, degrees, axis):
        return any(abs(angle - degrees) < 1 and abs(sum(a * b for a, b in zip(direction, axis))) > 0.999
                   for angle, direction in map(turn_of, transforms))


def optional(*path, scale=1.0):
    """The part, or None where its file is missing."""
    if not os.path.exists(os.path.join(data, *path)):
        print(f"no {os.path.join(*path)}")
        return None
    return Part(*path, scale=scale)


# Two round parts that one feature tells from their turned selves: no turn is exact, half a turn is near.
for number, near in ((1, 90), (2, 60)) if LONG else ((2, 60),):
    part = optional("tohoku", f"Part_{number}", f"Part_{number}.STL")
    if part:
        check(part.exact == [] and part.has(part.near[:1], 180, Z), f"{part.name}: the best is half a turn about z")
        check(part.has(part.near, near, Z) and part.overlaps == sorted(part.overlaps, reverse=True), f"{part.name}: turns")
part = optional("tohoku", "Part_3", "Part_3.STL")
if part:
    check(part.exact == [] and part.near == [], f"{part.name} has no symmetry")

# A lug without symmetry, in metres.
part = optional("cad", "small.ply")
if part:
    check(part.exact == [] and part.near == [], f"{part.name} has no symmetry")
if not LONG:
    sys.exit()

# A gear whose two sides are the same: the whole group of a hexagonal prism.
part = optional("cad", "gear.ply")
if part:
    check(len(part.exact) == 11 and part.near == [], f"{part.name}: {len(part.exact)} turns and flips")
    check(all(part.has(part.exact, degrees, Z) for degrees in (60, 120, 180)), f"{part.name}: about its axis")
    check(sum(abs(axis[2]) < 0.01 for _, axis in map(turn_of, part.exact)) == 6, f"{part.name}: six flips")

# Six-fold but for its thread, which a turn moves along the axis: by a third of a millimetre for 60 degrees, by more for
# 120. Half a turn about an axis across the thread maps the thread onto itself.
part = optional("cad", "factory_nut_m16_loose_subdiv_3x.obj", scale=1000)
if part:
    check(part.has(part.exact, 180, Y), f"{part.name}: the flip")
    check(part.has(part.near + part.exact, 60, Z), f"{part.name}: a sixth of a turn")
    check(not part.has(part.near + part.exact, 30, Z), f"{part.name}: a twelfth of a turn")

# A regulator whose body of revolution has its fittings on one side.
part = optional("cad", "assembly_regulator_collision.stl", scale=1000)
if part:
    check(part.exact == [], f"{part.name}: no turn is exact")
    check(all(abs(axis[1]) > 0.99 for _, axis in map(turn_of, part.near)), f"{part.name}: near ones about its body's axis")
