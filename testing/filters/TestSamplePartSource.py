# SPDX-License-Identifier: BSD-3-Clause
"""The sample parts are closed, and the files in examples are the same."""
import os

from vtkmodules.vtkFiltersCore import vtkFeatureEdges
from vtkmodules.vtkIOGeometry import vtkSTLReader

from ppfmeam.filters import vtkMEAMSamplePartSource
from meamtest import check, close, connect, field, run

EXAMPLES = os.path.join(os.path.dirname(__file__), "..", "..", "examples")
FILES = {"RibbedFlange": ("data/ribbed_flange.stl", 80.5), "RidgedDisc": ("parts/ridged_disc.stl", 92.0),
         "ArcLever": ("parts/arc_lever.stl", 112.7), "Flap": ("parts/flap.stl", 153.9),
         "HolePlate": ("parts/hole_plate.stl", 84.5), "PipeElbow": ("parts/pipe_elbow.stl", 107.9),
         "Cap": ("parts/cap.stl", 69.5), "Knob": ("parts/knob.stl", 49.8), "Handle": ("parts/handle.stl", 117.0)}
for number, (name, (path, diameter)) in enumerate(FILES.items()):
    source = vtkMEAMSamplePartSource()
    getattr(source, "SetPartTo" + name)()
    check(source.GetPart() == number, f"{name} is part {source.GetPart()}")
    part = run(source)
    open_edges = connect(vtkFeatureEdges(), part)
    open_edges.FeatureEdgesOff()
    check(run(open_edges).GetNumberOfCells() == 0, f"{name} has open edges")
    check(abs(field(part, "Diameter")[0][0] - diameter) < 0.5, f"{name} is {field(part, 'Diameter')} mm across")
    file = run(connect(vtkSTLReader(), FileName=os.path.join(EXAMPLES, path)))
    check(os.path.getsize(os.path.join(EXAMPLES, path)) < 200000, f"{path} is large")
    check(file.GetNumberOfPolys() == part.GetNumberOfPolys() and close(file.GetBounds(), part.GetBounds()),
          f"examples/{path} is not {name}")
