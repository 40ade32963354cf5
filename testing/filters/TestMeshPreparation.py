# SPDX-License-Identifier: BSD-3-Clause
"""A box as STL files have it (every face with vertices of its own), polygons, strips, and meshes that are none."""
import math

import numpy
from vtkmodules.vtkCommonDataModel import vtkCellArray, vtkPolyData
from vtkmodules.vtkFiltersSources import vtkSphereSource

from ppfmeam.filters import vtkMEAMMeshPreparation
from meamtest import box, check, close, cloud, connect, fails, field, image, mesh, points, run, text

DIAGONAL = math.sqrt(10**2 + 20**2 + 30**2)


def triangles(data):
    polys = data.GetPolys()
    ids = [polys.GetConnectivityArray().GetTuple1(i) for i in range(polys.GetNumberOfConnectivityIds())]
    return [tuple(int(k) for k in ids[i : i + 3]) for i in range(0, len(ids), 3)]


def soup(data):
    """The same triangles with three vertices for each."""
    faces = triangles(data)
    return mesh([data.GetPoint(k) for face in faces for k in face], [range(3 * i, 3 * i + 3) for i in range(len(faces))])


def volume(data):
    """Signed: positive when the faces look outwards."""
    return sum(numpy.linalg.det([data.GetPoint(k) for k in face]) for face in triangles(data)) / 6


def prepare(data, **properties):
    return connect(vtkMEAMMeshPreparation(), data, **properties)


stl = soup(box(10, 20, 30))
before = points(stl)
clean = run(prepare(stl))
report = {clean.GetFieldData().GetArrayName(i): field(clean, clean.GetFieldData().GetArrayName(i))[0][0]
          for i in range(clean.GetFieldData().GetNumberOfArrays()) if clean.GetFieldData().GetArray(i)}
expected = {
    "InputVertices": 36, "InputTriangles": 12, "Vertices": 8, "Triangles": 12, "MergedVertices": 28, "NearVertices": 0,
    "IsolatedVertices": 0, "DegenerateTriangles": 0, "DuplicateTriangles": 0, "FlippedComponents": 0,
    "DroppedComponents": 0, "Components": 1, "ClosedHoles": 0, "Intersections": 0, "BorderEdges": 0, "Closed": 1,
    "Area": 2200, "Volume": 6000, "Diameter": DIAGONAL,
}
check(set(report) == set(expected), f"the report has {sorted(report)}")
for name, value in expected.items():
    check(abs(report[name] - value) < 1e-3, f"{name} is {report[name]}, not {value}")
check(text(clean, "Report") == "28 vertices merged with others at their place; closed; 1 component of 12 triangles", text(clean, "Report"))
check(clean.GetNumberOfPoints() == 8 and len(triangles(clean)) == 12, "the box has 8 corners and 12 triangles")
check(points(stl) == before, "the input was changed")

# Metres to mm, then moved to another frame.
moved = run(prepare(box(0.01, 0.02, 0.03), Scale=1000.0, Offset=(1.0, -2.0, 3.0)))
check(close(moved.GetBounds(), (1, 11, -2, 18, 3, 33), 1e-4), f"moved to {moved.GetBounds()}")
check(abs(field(moved, "Volume")[0][0] - 6000) < 0.01, "volume in cubic mm")

# A box that is inside out, with a face twice and one without area.
corners, faces = points(box(10, 20, 30)), triangles(box(10, 20, 30))
inverted = run(prepare(mesh(corners, [face[::-1] for face in faces])))
check(field(inverted, "FlippedComponents") == [(1,)] and abs(volume(inverted) - 6000) < 1e-2, "turned outwards")
dirty = run(prepare(mesh(corners + [(99, 99, 99)], faces + [faces[0], (0, 1, 1)])))
for name in ("DuplicateTriangles", "DegenerateTriangles", "IsolatedVertices"):
    check(field(dirty, name) == [(1,)], f"{name} is {field(dirty, name)}")
check(len(triangles(dirty)) == 12, "what is broken is left out")

# Polygons and strips: an L has a concave face.
outline = [(0, 0), (4, 0), (4, 1), (1, 1), (1, 3), (0, 3)]
ell = run(prepare(mesh([(x, y, 0) for x, y in outline], [range(6)])))
check(abs(field(ell, "Area")[0][0] - 6) < 1e-5 and len(triangles(ell)) == 4,
      f"the L has an area of {field(ell, 'Area')}")
check(field(ell, "Closed") == [(0,)] and field(ell, "BorderEdges") == [(6,)], "a plate is not closed")
strip, strips = mesh([(0, 0, 0), (1, 0, 0), (0, 1, 0), (1, 1, 0)], []), vtkCellArray()
strips.InsertNextCell(4, [0, 1, 2, 3])
strip.SetStrips(strips)
check(abs(field(run(prepare(strip)), "Area")[0][0] - 1) < 1e-6, "a strip of two triangles")

# Two bodies; a hole of 10 + 20 + sqrt(500) mm.
both = mesh(corners + points(box(1, 1, 1, (50, 0, 0))), faces + [tuple(k + 8 for k in face) for face in faces])
check(field(run(prepare(both)), "Components") == [(2,)], "both are kept")
largest = run(prepare(both, KeptComponents=vtkMEAMMeshPreparation.Largest))
check(field(largest, "DroppedComponents") == [(1,)] and field(largest, "Volume") == [(6000,)], "one is dropped")
hole = mesh(corners, faces[1:])
check(field(run(prepare(hole, HoleSize=52)), "BorderEdges") == [(3,)], "the hole is larger")
filled = run(prepare(hole, HoleSize=53))
check(field(filled, "ClosedHoles") == [(1,)] and field(filled, "Closed") == [(1,)], "the hole is closed")
check("1 hole closed" in text(filled, "Report"), text(filled, "Report"))

# Even triangles and back.
fine = run(prepare(box(10, 20, 30), EdgeLength=2.0))
check(len(triangles(fine)) > 800 and abs(field(fine, "Volume")[0][0] - 6000) < 0.1, f"{len(triangles(fine))} triangles")
coarse = run(prepare(fine, MaximumError=0.01))
check(len(triangles(coarse)) == 12, f"{len(triangles(coarse))} triangles are left")

# The progress of many triangles goes on in every step, so that it can be stopped there.
ball = vtkSphereSource()
ball.SetThetaResolution(300)
ball.SetPhiResolution(150)
ball.Update()
filter, shares = prepare(ball.GetOutput()), []
filter.AddObserver("ProgressEvent", lambda caller, event: shares.append(caller.GetProgress()))
run(filter)
check(all(any(low < share < low + 0.1 for share in shares) for low in (0, 0.2, 0.4, 0.5)) and shares == sorted(shares), f"{shares}")

fails(prepare(box(10, 20, 30), EdgeLength=1e-5), "edge length")
fails(prepare(vtkPolyData()), "no faces")
fails(prepare(cloud([(0, 0, 0), (1, 0, 0), (0, 1, 0)])), "no faces", "points")
fails(prepare(mesh([(0, 0, 0), (1, 0, math.nan), (0, 1, 0)], [(0, 1, 2)])), "not a number")
fails(prepare(mesh([(math.inf, 0, 0), (1, 0, 0), (0, 1, 0), (5, 5, 5)], [(0, 1, 2, 3)])), "not a number")
fails(prepare(mesh([(0, 0, 0), (1, 0, 0), (0, 1, 0)], [(0, 1, 7)])), "does not exist")
fails(prepare(mesh([(0, 0, 0), (1, 0, 0), (0, 1, 0), (1, 1, 0)], [(0, 1, 9, 3)])), "does not exist")
fails(prepare(box(1, 1, 1), Scale=math.nan), "scale")
fails(prepare(image()), "vtkPolyData")
