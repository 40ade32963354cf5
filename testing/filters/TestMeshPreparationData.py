# SPDX-License-Identifier: BSD-3-Clause
"""Every mesh in the folders cad, rings, scanner, step and tohoku of $PPFMEAM_DATA is prepared without an error; a file
without faces is told to have none. Of STEP files, one in mm and two in inches, the sizes are known."""
import glob
import os

from ppfmeam import scripting
from ppfmeam.filters import vtkMEAMMeshPreparation
from meamtest import check, connect, fails, field, points, run, skip

SIZES = {"02-PANEL.step": (70, 60, 20), "base_interface_AP214.STEP": (599.412, 638.672, 4.763),  # mm
         "featuretype.STEP": (127, 63.5, 34.925)}
data = os.environ.get("PPFMEAM_DATA", "")
files = sorted(path for folder in ("cad", "rings", "scanner", "step", "tohoku/Part_*")
               for path in glob.glob(os.path.join(data, folder, "*"))
               if os.path.splitext(path)[1].lower() in (".stl", ".ply", ".obj", ".off", ".step")) if data else []
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
    if os.path.basename(path) in SIZES:
        low, high = clean.GetBounds()[::2], clean.GetBounds()[1::2]
        for a, b, size in zip(low, high, SIZES[os.path.basename(path)]):
            check(abs(b - a - size) < 0.01, f"{name}: {b - a} mm instead of {size}")
        check(field(clean, "Closed") == [(1,)] and field(clean, "FlippedComponents") == [(0,)], f"{name} is no solid")
print("ok")
