# SPDX-License-Identifier: BSD-3-Clause
"""examples/paraview: the trace runs, and the state beside it has the same filters, gives the same poses, and looks the same.
The argument is the folder of the examples."""
import math
import os
import sys
import tempfile

from paraview import simple

from pictures import pixels, red

folder = tempfile.TemporaryDirectory()
examples = sys.argv[1]
WIDTH, HEIGHT = 480, 360  # of both scans: those of the example take most of the time


def check(condition, message):
    if not condition:
        raise AssertionError(message)


def pipeline():
    """Name and kind of all sources and filters, and the poses at the end."""
    sources = sorted((name, source.GetXMLName()) for (name, _), source in simple.GetSources().items())
    poses = simple.FindSource("Poses")
    poses.UpdatePipeline()
    array = poses.GetClientSideObject().GetOutputDataObject(0).GetPointData().GetArray("Transform")
    return sources, [array.GetTuple(i) for i in range(array.GetNumberOfTuples())]


sys.argv = ["pipeline.py", "--picture", os.path.join(folder.name, "trace.png")]
with open(os.path.join(examples, "pipeline.py"), encoding="utf-8") as file:
    text = file.read()
check(text.count("Copies=8)") == 1, "pipeline.py has another bin")
exec(compile(text.replace("Copies=8)", f"Copies=8, Width={WIDTH}, Height={HEIGHT})"), "pipeline.py", "exec"), {})
sources, poses = pipeline()
check(len(poses) == 5, f"{len(poses)} poses")
view = simple.GetActiveView()
size, camera = list(view.ViewSize), [list(point) for point in (view.CameraPosition, view.CameraFocalPoint, view.CameraViewUp)]
simple.ResetSession()
simple.LoadState(os.path.join(examples, "pipeline.pvsm"))
bin = simple.FindSource("Bin")
bin.Width, bin.Height = WIDTH, HEIGHT
of_state = pipeline()
check(of_state[0] == sources, f"pipeline.pvsm is not of pipeline.py: {set(sources) ^ set(of_state[0])}; save it again")
check(of_state[1] == poses, "the state has other poses")
view = simple.GetViews()[0]
view.ViewSize = size
check(math.dist(view.CameraPosition, camera[0]) < 0.1 * math.dist(*camera[:2]) and list(view.CameraViewUp) == camera[2],
      f"the state looks from {list(view.CameraPosition)}, the trace from {camera[0]}")
view.CameraPosition, view.CameraFocalPoint, _ = camera  # that of the state is of the whole scan
simple.Render(view)
simple.SaveScreenshot(os.path.join(folder.name, "state.png"), view, ImageResolution=[1200, 900])
trace, state = (pixels(os.path.join(folder.name, name)) for name in ("trace.png", "state.png"))
check(red(trace).mean() > 0.005, "no red part in the trace's picture")
check((abs(trace - state).max(axis=1) > 40).mean() < 0.01, "the state looks different")
