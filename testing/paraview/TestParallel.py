# SPDX-License-Identifier: BSD-3-Clause
"""Several processes give what one gives: nothing comes out twice, and a process without data is no error. Started by mpirun
under pvbatch; the first process compares and ends with the status."""
import os
import sys

from paraview import simple
from vtkmodules.vtkParallelCore import vtkMultiProcessController

WIDTH, HEIGHT = 640, 480
rank = vtkMultiProcessController.GetGlobalController().GetLocalProcessId()
processes = vtkMultiProcessController.GetGlobalController().GetNumberOfProcesses()
plate = simple.SamplePartSource(Part="Hole plate")
scene = simple.BinSceneOfPart(Input=plate, Copies=2, Width=WIDTH, Height=HEIGHT)
found = simple.MEAMPoseEstimation(Input=plate, Scene=simple.OutputPort(scene, 0), MaximumNumberOfPoses=2)
found.UpdatePipeline()
counts = {name: source.GetDataInformation(port).GetNumberOfPoints()
          for name, source, port in (("scan", scene, 0), ("true poses", scene, 1), ("poses", found, 0))}
view = simple.GetActiveViewOrCreate("RenderView")
for source, port in ((scene, 0), (found, 0), (found, 2)):
    simple.Show(simple.OutputPort(source, port), view)
simple.Render(view)
if rank == 0:
    expected = {"scan": WIDTH * HEIGHT, "true poses": 2, "poses": 2}
    print(processes, "processes:", counts)
    if processes < 2 or counts != expected:
        print("expected", expected, file=sys.stderr)
        sys.stderr.flush()
        os._exit(1)
