# SPDX-License-Identifier: BSD-3-Clause
"""Small OFF files: a box of squares, colours, bad files; and the script package picks the reader by extension."""
import os
import tempfile

from ppfmeam import scripting
from ppfmeam.filters import vtkMEAMMeshPreparation, vtkMEAMOFFReader
from meamtest import check, connect, fails, field, points, prints, run

folder = tempfile.TemporaryDirectory()
BOX = """OFF
# a box of 1 x 2 x 3
8 6 12
0 0 0\n1 0 0\n0 2 0\n1 2 0\n0 0 3\n1 0 3\n0 2 3\n1 2 3
4 0 2 3 1\n4 4 5 7 6\n4 0 1 5 4\n4 2 6 7 3\n4 0 4 6 2\n4 1 3 7 5
"""


def off(text, name="box.off"):
    path = os.path.join(folder.name, name)
    with open(path, "w") as file:
        file.write(text)
    return path


def reader(path):
    result = vtkMEAMOFFReader()
    result.SetFileName(path)
    return result


path = off(BOX)
box = run(reader(path))
check(points(box)[7] == (1, 2, 3), f"the last corner is {points(box)[7]}")
check(box.GetNumberOfPoints() == 8 and box.GetNumberOfPolys() == 12, "squares become triangles")
clean = run(connect(vtkMEAMMeshPreparation(), reader(path)))
check(field(clean, "Volume") == [(6,)] and field(clean, "FlippedComponents") == [(0,)], "the box is closed")
check(run(reader(off(BOX.replace("OFF", "COFF").replace("\n0 0 0\n", "\n0 0 0 255 0 0\n"), "c.off"))).GetNumberOfPolys()
      == 12, "colours are skipped")

check(field(scripting.read_mesh(path, scale=2.0), "Volume") == [(48,)], "scripts read OFF files")
try:
    scripting.read(off(BOX[:-12], "cut.off"))
    check(False, "a file that is cut off is read")
except scripting.Failure as failure:
    check("cut off" in str(failure), failure)

check(vtkMEAMOFFReader().CanReadFile(path) == 1, "an OFF file can be read")
check(vtkMEAMOFFReader().CanReadFile(__file__) == 0, "a Python file cannot")
check(vtkMEAMOFFReader().CanReadFile("/no/such/file.off") == 0, "a missing file cannot")

fails(vtkMEAMOFFReader(), "no file")
fails(reader("/no/such/file.off"), "/no/such/file.off")
fails(reader(__file__), "not an OFF file")
fails(reader(off("OFF\n1 0 0\n0 0 0\n", "point.off")), "no faces")
# An error takes the old output away.
same = reader(path)
run(same)
same.SetFileName(off("OFF\n9 1 0\n", "bad.off"))
fails(same, "cut off", "bad.off")
prints(same, "FileName")
