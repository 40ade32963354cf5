# SPDX-License-Identifier: BSD-3-Clause
"""Every mesh in the folders cad, rings, scanner and tohoku of $PPFMEAM_DATA is prepared without an error; a file
without faces is told to have none."""
import glob
import os

from ppfmeam import scripting
from ppfmeam.filters import vtkMEAMMeshPreparation
from meamtest import check, connect, fails, field, points, run, skip

data = os.environ.get("PPFMEAM_DATA", "")
files = sorted(path for folder in ("cad", "rings", "scanner", "tohoku/Part_*")
               for path in glob.glob(os.path.join(data, folder, "*"))
               if os.path.splitext(path)[1].lower() in (".stl", ".ply", ".obj", ".off")) if data else []
if not files:
    skip(f"no meshes below '{data}': set PPFMEAM_DATA")

for path in files:
    name = os.path.relpath(path, data)
    mesh = scripting.read(path)
    before = points(mesh)
    filter = connect(vtkMEAMMeshPreparation(), mesh)
    if mesh.GetNumberOfPolys() + mesh.GetNumberOfStrips() == 0:
        fails(filter, "no faces")
        print(f"{name}: no faces")
        continue
    clean = run(filter)
    print(f"{name}: {clean.GetFieldData().GetAbstractArray('Report').GetValue(0)}")
    check(clean.GetNumberOfPolys() > 0 and field(clean, "Area")[0][0] > 0, f"{name} has no area")
    check(field(clean, "Triangles")[0][0] == clean.GetNumberOfPolys(), f"{name}: triangles are counted wrong")
    check((field(clean, "Volume")[0][0] > 0) == (field(clean, "Closed")[0][0] == 1), f"{name}: volume")
    check(points(mesh) == before, f"{name}: the input was changed")
print("ok")
