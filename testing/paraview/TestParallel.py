# SPDX-License-Identifier: BSD-3-Clause
"""Several processes give what one gives: nothing comes out twice, a process without data is no error, and what is saved is
written once. Started by mpirun under pvbatch; the first process compares and ends with the status."""
import json
import os
import sys
import tempfile

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
MODEL = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "fuzz", "corpus", "model", "derived.meam")
grasps = simple.GraspDefinition(Input=plate)


def content(path):
    with open(path, "rb") as file:
        return file.read()


def is_saved():
    """Whether poses, grasps, a trained model and the page of what was found are in their files."""
    with tempfile.TemporaryDirectory() as folder:
        for name, source in (("poses.json", found), ("part.grasps", grasps), ("part.meam", simple.TrainedModelReader(FileName=MODEL))):
            simple.SaveData(os.path.join(folder, name), simple.OutputPort(source, 0))
        counts = [len(json.loads(content(os.path.join(folder, name)))[key]) for name, key in (("poses.json", "poses"), ("part.grasps", "grasps"))]
        print("saved:", counts)
        if os.path.exists("/usr/share/javascript/three"):
            page = os.path.join(folder, "found.html")
            simple.SaveData(page, simple.OutputPort(found, 0))
            print("page:", os.path.getsize(page) if os.path.exists(page) else "none")
            counts += [] if content(page).count(b"<tr data-rank") == 2 else ["no page"]
        return counts == [2, grasps.GetDataInformation(0).GetNumberOfPoints()] and counts[1] > 0 \
            and content(os.path.join(folder, "part.meam")) == content(MODEL)


if rank == 0:
    expected = {"scan": WIDTH * HEIGHT, "true poses": 2, "poses": 2}
    print(processes, "processes:", counts)
    if processes < 2 or counts != expected or not is_saved():
        print("expected", expected, file=sys.stderr)
        sys.stderr.flush()
        os._exit(1)
