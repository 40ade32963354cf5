# SPDX-License-Identifier: BSD-3-Clause
"""The sample part is closed, and the file in examples/data is the same."""
import os

from vtkmodules.vtkFiltersCore import vtkFeatureEdges
from vtkmodules.vtkIOGeometry import vtkSTLReader

from ppfmeam.filters import vtkMEAMSamplePartSource
from meamtest import check, close, connect, field, run

part = run(vtkMEAMSamplePartSource())
open_edges = connect(vtkFeatureEdges(), part)
open_edges.FeatureEdgesOff()
check(run(open_edges).GetNumberOfCells() == 0, "the sample part has open edges")
check(79 < field(part, "Diameter")[0][0] < 82, f"it is {field(part, 'Diameter')} mm across")
stl = vtkSTLReader()
stl.SetFileName(os.path.join(os.path.dirname(__file__), "..", "..", "examples", "data", "ribbed_flange.stl"))
file = run(stl)
check(file.GetNumberOfPolys() == part.GetNumberOfPolys() and close(file.GetBounds(), part.GetBounds()),
      "examples/data/ribbed_flange.stl is not the sample part")
check("vtkMEAMSamplePartSource" in str(vtkMEAMSamplePartSource()), "PrintSelf works")
