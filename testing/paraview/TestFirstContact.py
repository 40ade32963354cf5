# SPDX-License-Identifier: BSD-3-Clause
"""The first four clicks in the application: a CAD is opened, a scan is opened, MEAM Pose Estimation, Apply. ParaView's own
player clicks; the state that it saves then is opened by pvpython, which looks at it. The dialog of the menu names its inputs.

Usage: TestFirstContact.py PARAVIEW PVPYTHON
"""
import os
import subprocess
import sys
import tempfile

CLICKS = """<?xml version="1.0" ?>
<pqevents>
  <pqevent object="pqClientMainWindow/menubar/menu_File" command="activate" arguments="actionFileOpen" />
  <pqevent object="pqClientMainWindow/FileOpenDialog" command="filesSelected" arguments="{folder}/part.stl" />
  <pqevent object="pqClientMainWindow/menubar/menu_File" command="activate" arguments="actionFileOpen" />
  <pqevent object="pqClientMainWindow/FileOpenDialog" command="filesSelected" arguments="{folder}/scan.pcd" />
  <pqevent object="pqClientMainWindow/PoseEstimationToolbar/EstimatePoses" command="activate" arguments="" />
  <pqevent object="pqClientMainWindow/propertiesDock/propertiesPanel/Accept" command="activate" arguments="" />
  <pqevent object="pqClientMainWindow/menubar/menu_File" command="activate" arguments="actionFileSaveServerState" />
  <pqevent object="pqClientMainWindow/FileSaveServerStateDialog" command="filesSelected" arguments="{folder}/state.pvsm" />
  <pqevent object="pqClientMainWindow/menubar" command="activate" arguments="menuFilters" />
  <pqevent object="pqClientMainWindow/menubar/menuFilters/PoseEstimation" command="activate" arguments="MEAMPoseEstimation" />
  <pqcheck object="pqClientMainWindow/SelectInputDialog/buttonFrame/Input" property="text" arguments="Part" />
  <pqcheck object="pqClientMainWindow/SelectInputDialog/buttonFrame/Scene" property="text" arguments="Scan" />
  <pqevent object="pqClientMainWindow/SelectInputDialog/buttonBox/1QPushButton1" command="activate" arguments="" />
</pqevents>
"""
RED, GREEN = (220, 30, 30), (40, 170, 50)


def check(condition, message):
    if not condition:
        raise AssertionError(message)


def prepare(folder):
    """A part and a scan of four copies of it, as files."""
    import numpy
    from vtkmodules.util.numpy_support import vtk_to_numpy
    from vtkmodules.vtkIOGeometry import vtkSTLWriter
    from ppfmeam.filters import vtkMEAMBinSceneSource, vtkMEAMSamplePartSource

    plate = vtkMEAMSamplePartSource()
    plate.SetPartToHolePlate()
    source = vtkMEAMBinSceneSource()
    source.SetInputConnection(plate.GetOutputPort())
    source.SetCopies(4)
    source.SetWidth(640)
    source.SetHeight(480)
    source.Update()
    writer = vtkSTLWriter()
    writer.SetInputData(source.GetOutputDataObject(2))
    writer.SetFileName(os.path.join(folder, "part.stl"))
    writer.SetFileTypeToBinary()
    writer.Write()
    scan = source.GetOutputDataObject(0)
    columns = numpy.column_stack((vtk_to_numpy(scan.GetPoints().GetData()),
                                  vtk_to_numpy(scan.GetPointData().GetArray("Intensity"))))
    with open(os.path.join(folder, "scan.pcd"), "wb") as file:
        file.write(b"VERSION .7\nFIELDS x y z intensity\nSIZE 4 4 4 4\nTYPE F F F F\nCOUNT 1 1 1 1\nWIDTH 640\nHEIGHT 480\n"
                   b"POINTS 307200\nDATA binary\n")
        file.write(columns.astype("<f4").tobytes())
    with open(os.path.join(folder, "clicks.xml"), "w") as file:
        file.write(CLICKS.format(folder=folder))


def click(paraview, folder):
    """Plays the clicks with the settings of a new user."""
    environment = dict(os.environ, HOME=folder, XDG_CONFIG_HOME=os.path.join(folder, "config"))
    run = subprocess.run([paraview, "--dr", "--exit", f"--test-script={folder}/clicks.xml"], env=environment, capture_output=True, text=True, timeout=120)
    check(os.path.exists(os.path.join(folder, "state.pvsm")), f"the clicks led nowhere: {run.stdout[-3000:]} {run.stderr[-3000:]}")
    said = [line for line in (run.stdout + run.stderr).splitlines() if "ERR|" in line or "critical" in line]
    check(not said, f"ParaView says {said}")


def share(picture, color):
    """Share of the pixels whose hue is that of the colour."""
    from vtkmodules.util.numpy_support import vtk_to_numpy
    from vtkmodules.vtkIOImage import vtkPNGReader

    reader = vtkPNGReader()
    reader.SetFileName(picture)
    reader.Update()
    pixels = vtk_to_numpy(reader.GetOutput().GetPointData().GetScalars())[:, :3].astype(float)
    level = pixels.max(axis=1)
    near = sum(abs(pixels[:, c] / level.clip(1) - color[c] / max(color)) for c in range(3)) < 0.35
    return (near & (level - pixels.min(axis=1) > 40)).mean()


def look(state):
    """At what the user sees."""
    from paraview import simple

    simple.LoadState(state)
    found = simple.FindSource("MEAMPoseEstimation1")
    view = next(v for v in simple.GetViews() if v.GetXMLName() == "RenderView")
    shown = {(r.Input.GetXMLName() if hasattr(r.Input, "GetXMLName") else r.Input.SMProxy.GetXMLName(), r.Input.Port): r
             for r in view.Representations if hasattr(r, "Input") and r.Visibility}
    check(sorted(shown) == [("MEAMPoseEstimation", 0), ("MEAMPoseEstimation", 2), ("PCDReader", 0)], f"shown: {sorted(shown)}")
    labels = shown["MEAMPoseEstimation", 0]
    check((labels.Representation, labels.LabelArray) == ("Pose Labels", "Label"), f"labels: {labels.Representation}")
    check(list(shown["MEAMPoseEstimation", 2].ColorArrayName) == ["POINTS", "Rank"], "the parts are not coloured by rank")
    check(shown["PCDReader", 0].MapScalars == 0, "the scan is not grey")
    check(tuple(view.CameraViewUp) == (0, -1, 0), f"seen from {view.CameraPosition}, up {view.CameraViewUp}")
    bars = [r for r in view.Representations if r.GetXMLName() == "ScalarBarWidgetRepresentation" and r.Visibility]
    check([b.Title for b in bars] == ["Rank"], f"legends: {[b.Title for b in bars]}")
    found.UpdatePipeline()
    poses = found.GetClientSideObject().GetOutputDataObject(0)
    check(poses.GetNumberOfPoints() >= 2, f"{poses.GetNumberOfPoints()} poses")
    check(poses.GetPointData().GetAbstractArray("Label").GetValue(0).startswith("1: "), "the label of the first")
    simple.Render(view)
    picture = state + ".png"
    simple.SaveScreenshot(picture, view, ImageResolution=[640, 480])
    for color in (RED, GREEN):
        check(share(picture, color) > 0.005, f"no part of the colour {color} in {picture}")


if sys.argv[1] == "--look":
    look(sys.argv[2])
else:
    with tempfile.TemporaryDirectory() as temporary:
        prepare(temporary)
        click(sys.argv[1], temporary)
        subprocess.run([sys.argv[2], os.path.abspath(__file__), "--look",
                        os.path.join(temporary, "state.pvsm")], check=True)
