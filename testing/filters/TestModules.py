# SPDX-License-Identifier: BSD-3-Clause
"""Detection and IO without the other modules: nothing under the GPL is loaded, a trained model is found, a mesh is an error that
says what to do. Once Training is there the same filter stops training when it is asked to, and trains the mesh."""
import os
import re
import subprocess
import sys
import tempfile

import vtkmodules.vtkCommonCore  # noqa: F401
import vtkmodules.vtkCommonDataModel  # noqa: F401
import vtkmodules.vtkCommonExecutionModel  # noqa: F401
import vtkmodules.vtkIOCore  # noqa: F401
from vtkmodules.vtkIOXML import vtkXMLStructuredGridReader

from ppfmeam.ppfmeamDetection import vtkMEAMPoseEstimation
from ppfmeam.ppfmeamIO import vtkMEAMMeshReader, vtkMEAMModelReader

GPL = re.compile("CGAL|libgmp|libmpfr|OpenMesh|Bullet|libTK|gdal|poppler|imgcodecs")
MAKE = """
import ppfmeam
from ppfmeam.filters import vtkMEAMBinSceneSource
from vtkmodules.vtkIOGeometry import vtkSTLWriter
from vtkmodules.vtkIOXML import vtkXMLStructuredGridWriter

source = vtkMEAMBinSceneSource()
source.SetCopies(2)
source.SetWidth(320)
source.SetHeight(240)
for writer, port, name in (vtkXMLStructuredGridWriter(), 0, "scan.vts"), (vtkSTLWriter(), 2, "part.stl"):
    writer.SetInputConnection(source.GetOutputPort(port))
    writer.SetFileName(name)
    writer.Write()
ppfmeam.train("part.stl").save("part.meam")
"""


def check(condition, message):
    if not condition:
        raise AssertionError(message)


def reader(kind, file):
    result = kind()
    result.SetFileName(os.path.join(name, file))
    return result


def loaded():
    with open("/proc/self/maps", encoding="utf-8") as maps:
        return sorted({line.split()[-1] for line in maps if GPL.search(line)})


def found(part):
    """The poses, and the errors told meanwhile."""
    errors.clear()
    estimation.SetInputConnection(part.GetOutputPort())
    estimation.Update()
    poses = estimation.GetOutput().GetPointData().GetArray("Transform")
    return [poses.GetTuple(k) for k in range(poses.GetNumberOfTuples())] if poses else [], list(errors)


def tell(caller, event, text):
    errors.append(text)


def stop(caller, event):
    if 0.2 < caller.GetProgress() < 0.5:  # of its training
        caller.AbortExecuteOn()


with tempfile.TemporaryDirectory() as name:
    subprocess.run([sys.executable, "-c", MAKE], cwd=name, check=True)
    scan = reader(vtkXMLStructuredGridReader, "scan.vts")
    mesh, model = reader(vtkMEAMMeshReader, "part.stl"), reader(vtkMEAMModelReader, "part.meam")
    errors = []
    tell.CallDataType = "string0"
    estimation = vtkMEAMPoseEstimation()
    estimation.AddObserver("ErrorEvent", tell)
    estimation.SetSceneConnection(scan.GetOutputPort())
    poses, told = found(model)
    check(poses and not told, f"a trained model: {len(poses)} poses, {told}")
    check(not loaded(), f"detection alone loads {loaded()}")
    none, told = found(mesh)
    check(not none and len(told) == 1 and "PPFMEAM::Training" in told[0], f"a mesh without Training: {len(none)} poses, {told}")
    step = reader(vtkMEAMMeshReader, "part.step")
    step.AddObserver("ErrorEvent", tell)
    errors.clear()
    step.Update()
    check(len(errors) == 1 and "PPFMEAM::Training" in errors[0], f"a STEP file without Training: {errors}")

    import ppfmeam.ppfmeamPicking  # noqa: F401
    import ppfmeam.ppfmeamTraining  # noqa: F401
    check(loaded(), "Training loads nothing under the GPL, by the names that are looked for")
    observer = estimation.AddObserver("ProgressEvent", stop)
    none, told = found(mesh)
    check(not none and not told, f"stopped while it trained: {len(none)} poses, {told}")
    estimation.RemoveObserver(observer)
    estimation.AbortExecuteOff()
    estimation.Modified()
    trained, told = found(mesh)
    check(trained == poses and not told, f"a mesh with Training: {len(trained)} poses, {told}")
