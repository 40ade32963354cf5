# SPDX-License-Identifier: BSD-3-Clause
"""Meshes of every kind: the triangles of VTK's readers, of OFF those of a box, of STEP those of a rod, also through the
scripts; and files that are damaged or cut off."""
import os
import shutil
import warnings

import numpy
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkFiltersCore import vtkTriangleFilter
from vtkmodules.vtkIOGeometry import vtkOBJReader, vtkOBJWriter, vtkSTLReader, vtkSTLWriter
from vtkmodules.vtkIOPLY import vtkPLYReader, vtkPLYWriter

import ppfmeam
from ppfmeam import scripting
from ppfmeam.filters import vtkMEAMMeshPreparation, vtkMEAMMeshReader
from meamtest import Folder, bracket, check, cloud, connect, fails, field, mesh, points, run, text

KINDS = {"ascii.stl": (vtkSTLWriter, vtkSTLReader), "binary.stl": (vtkSTLWriter, vtkSTLReader),
         "ascii.ply": (vtkPLYWriter, vtkPLYReader), "binary.ply": (vtkPLYWriter, vtkPLYReader),
         "part.obj": (vtkOBJWriter, vtkOBJReader)}
BOX = b"""OFF
# a box of 1 x 2 x 3
8 6 12
0 0 0\n1 0 0\n0 2 0\n1 2 0\n0 0 3\n1 0 3\n0 2 3\n1 2 3
4 0 2 3 1\n4 4 5 7 6\n4 0 1 5 4\n4 2 6 7 3\n4 0 4 6 2\n4 1 3 7 5
"""
file = Folder()


def reader(path, kind=vtkMEAMMeshReader):
    return connect(kind(), FileName=path)


def write(path, data, writer):
    writer = connect(writer(), data, FileName=path)
    if os.path.basename(path).startswith("ascii"):
        writer.SetFileTypeToASCII()
    elif not path.endswith(".obj"):
        writer.SetFileTypeToBinary()
    writer.Write()
    return path


def shape(data):
    return vtk_to_numpy(data.GetPoints().GetData()), vtk_to_numpy(data.GetPolys().GetConnectivityArray())


part = run(connect(vtkTriangleFilter(), bracket()))
random = numpy.random.default_rng(1)
for name, (writer, theirs) in KINDS.items():
    path = write(file(name), part, writer)
    expected = shape(run(reader(path, theirs)))
    for found in (shape(run(reader(path))), shape(scripting.read(path))):
        check(all(a.shape == b.shape and (a == b).all() for a, b in zip(found, expected)), f"another mesh of {name}")
    check(len(expected[0]) == 12 and len(expected[1]) == 3 * 20, f"{name}: {len(expected[0])} vertices")

    # Damaged files end no program: they are a mesh or a sentence.
    with open(path, "rb") as whole:
        content = whole.read()
    failed = 0
    for k in range(60):
        damaged = bytearray(content[:random.integers(len(content))] if k % 2 else content)
        for place in random.integers(0, len(damaged) if damaged else 0, 3 * (1 - k % 2)):
            damaged[place] = random.integers(256)
        bad = file("bad" + os.path.splitext(name)[1], damaged)
        try:
            check(scripting.read(bad).GetNumberOfPoints() > 0, f"{name}: no points")
        except scripting.Failure as failure:
            check(bad in str(failure), f"{name}: {failure}")
            failed += 1
    check(failed > 20, f"{name}: {failed} of 60 damaged files are refused")

# A polygon is cut; a file of points alone is a cloud for the scripts and no mesh.
square = write(file("square.ply"), mesh([(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0)], [(0, 1, 2, 3)]), vtkPLYWriter)
check(run(reader(square)).GetNumberOfPolys() == 2, "a square is two triangles")
only = write(file("points.ply"), cloud([(1, 2, 3), (4, 5, 6)]), vtkPLYWriter)
fails(reader(only), "no faces")
check(points(scripting.read(only, 2)) == [(2, 4, 6), (8, 10, 12)], "a cloud")

path = file("box.off", BOX)
box = run(reader(path))
check(points(box)[7] == (1, 2, 3), f"the last corner is {points(box)[7]}")
check(box.GetNumberOfPoints() == 8 and box.GetNumberOfPolys() == 12, "squares become triangles")
clean = run(connect(vtkMEAMMeshPreparation(), reader(path)))
check(field(clean, "Volume") == [(6,)] and field(clean, "FlippedComponents") == [(0,)], "the box is closed")
colored = file("c.off", BOX.replace(b"OFF", b"COFF").replace(b"\n0 0 0\n", b"\n0 0 0 255 0 0\n"))
check(run(reader(colored)).GetNumberOfPolys() == 12, "colours are skipped")
check(field(scripting.read_mesh(path, scale=2.0), "Volume") == [(48,)], "scripts read OFF files")
try:
    scripting.read(file("cut.off", BOX[:-12]))
    check(False, "a file that is cut off is read")
except scripting.Failure as failure:
    check("cut off" in str(failure), failure)
fails(reader(file("text.off", b"ply\n")), "not an OFF file")
fails(reader(file("point.off", b"OFF\n1 0 0\n0 0 0\n")), "no faces")

# A rod of 20 x 20 x 5 mm, whose file is in inches.
rod = os.path.join(os.path.dirname(__file__), "..", "fuzz", "corpus", "step", "rod.step")
for path in (rod, shutil.copy(rod, file("ROD.STP"))):
    found = run(reader(path))
    sizes = [b - a for a, b in zip(found.GetBounds()[::2], found.GetBounds()[1::2])]
    check(numpy.allclose(sizes, (20, 20, 5), atol=0.01), f"{path}: {sizes}")
    clean = run(connect(vtkMEAMMeshPreparation(), found))
    check(field(clean, "Closed") == [(1,)] and field(clean, "MergedVertices") == [(0,)], "faces share their vertices")
    check(numpy.allclose(field(clean, "Volume"), 500 * numpy.pi, rtol=0.01), f"{path}: {field(clean, 'Volume')}")
    check(field(scripting.read_mesh(path, scale=2.0), "Volume")[0][0] > 7.9 * 490 * numpy.pi, "scripts read STEP files")
check(abs(ppfmeam.train(rod).diameter - 425 ** 0.5) < 0.05, "a STEP file is trained")
with open(rod, "rb") as whole:
    content = whole.read()
fails(reader(file("cut.step", content[:3000])), "cut.step", "cut off")
fails(reader(file("empty.igs", b"")), "empty.igs", "no IGES file")
fails(reader(file("no.step")), "no.step")

# The file holds one solid.
chosen = reader(rod)
chosen.SetSolid(1)
check(points(run(chosen)) == points(run(reader(rod))), "the only solid is all of the file")
chosen.SetSolid(2)
fails(chosen, "rod.step", "holds 1 solid, no solid 2")
chosen.SetFileName(square)
fails(chosen, "square.ply", "is a mesh")
check(abs(ppfmeam.train(rod, solid=1).diameter - 425 ** 0.5) < 0.05, "the solid is trained")
for cad, words in ((rod, "holds 1 solid, no solid 3: choose 1, or 0"), (box, "solid is chosen from a STEP or IGES file")):
    try:
        ppfmeam.train(cad, solid=3)
        check(False, "a solid that is not there is trained")
    except ppfmeam.Error as error:
        check(words in str(error), error)
check(field(scripting.read_mesh(rod, solid=1), "Closed") == [(1,)], "scripts choose a solid")

# A triangle far off the box is told, by the reader, in Python and in mm by the preparation.
stray = file("stray.off", BOX.replace(b"8 6 12", b"11 7 12").replace(b"1 2 3\n4 0 2", b"1 2 3\n100 0 0\n101 0 0\n100 1 0\n4 0 2")
             + b"3 8 9 10\n")
words = "a component of 1 triangle, far off the rest, 1 x 1 x 0 large at (100.5, 0.5, 0) in the file's unit"
told = text(run(reader(stray)), "CADReport")
check(words in told, told)
check(run(reader(path)).GetFieldData().GetAbstractArray("CADReport") is None, "of a rod nothing is told")
with warnings.catch_warnings(record=True) as caught:
    warnings.simplefilter("always")
    ppfmeam.train(stray, scale=10)
check(any(words in str(warning.message) for warning in caught), [str(warning.message) for warning in caught])
preparation = connect(vtkMEAMMeshPreparation(), reader(stray), Scale=10)
told = text(run(preparation), "Report")
check("1 triangle, far off the rest, 10 x 10 x 0 large at (1005, 5, 0) in mm" in told, told)

fails(reader(__file__), "extension")
# An error takes the old output away.
same = reader(square)
run(same)
same.SetFileName(only)
fails(same, "no faces")
