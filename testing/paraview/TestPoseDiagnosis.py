# SPDX-License-Identifier: BSD-3-Clause
"""Inside the ParaView application: Pose Diagnosis of a part that lies under others says that it is hidden, and shows why: its
points over the scan in the colors of their states. Its panel has a handle to pick a point with, and a box for the pose.

Usage: --script=TestPoseDiagnosis.py; the picture goes to $PPFMEAM_PICTURE, if that is set.
"""
import math
import os
import sys
import tempfile
import traceback


def check(condition, message):
    if not condition:
        raise AssertionError(message)


def ask():
    from paraview import simple

    simple._DisableFirstRenderCameraReset()
    scene = simple.BinSceneSource(Copies=30, Width=640, Height=512)
    part, scan, truth = (simple.OutputPort(scene, port) for port in (2, 0, 1))
    scene.UpdatePipeline()
    visible = scene.GetClientSideObject().GetOutputDataObject(1).GetPointData().GetArray("VisibleFraction")
    by_visibility = sorted(range(visible.GetNumberOfTuples()), key=lambda k: abs(visible.GetValue(k) - 0.25))
    why = simple.PoseDiagnosis(Input=part, Scene=scan, Poses=truth, MaximumNumberOfPoses=0, MinimumProbability=0.5,
                               Place="Ranked Pose", Fit=0)
    def said(name):
        return why.GetClientSideObject().GetOutputDataObject(0).GetFieldData().GetAbstractArray(name).GetValue(0)

    # A quarter of it can be seen.
    for k in by_visibility:
        why.RankOfPose = k + 1
        why.UpdatePipeline()
        if said("Verdict").startswith("Hidden"):
            break
    view = simple.GetActiveViewOrCreate("RenderView")
    view.OrientationAxesVisibility = 0
    simple.Show(scan, view).Opacity = 0.5  # what lies under it is seen
    display = simple.Show(why, view)
    check(list(display.ColorArrayName) == ["POINTS", "Residual"], f"colored by {display.ColorArrayName}")
    display.PointSize = 6
    simple.Show(simple.OutputPort(why, 4), view).PointSize = 6
    display.SetScalarBarVisibility(view, True)
    simple.GetScalarBar(simple.GetColorTransferFunction("Residual"), view).WindowLocation = "Lower Left Corner"
    table = simple.GetColorTransferFunction("Residual")
    check(list(table.Annotations)[1::2] == ["explained", "missing", "unexplained", "seen past", "turned", "hidden", "not measured"],
          table.Annotations)

    check(said("Verdict").startswith("Hidden: something lies in front of"), said("Verdict"))
    check("Take out what lies on it" in said("Advice"), said("Advice"))
    print(said("Verdict"), said("Advice"), file=sys.__stderr__)
    bounds = why.GetDataInformation().GetBounds()
    middle = [(bounds[2 * axis] + bounds[2 * axis + 1]) / 2 for axis in range(3)]
    view.CameraFocalPoint, view.CameraPosition, view.CameraViewUp = middle, [middle[0], middle[1], 0.0], [0, -1, 0]
    view.CameraViewAngle = 1.6 * math.degrees(math.atan2(bounds[1] - bounds[0], middle[2]))
    simple.Render(view)
    picture = os.environ.get("PPFMEAM_PICTURE") or os.path.join(tempfile.mkdtemp(), "why.png")
    simple.SaveScreenshot(picture, view, ImageResolution=[840, 650])

    # The next place takes no new detection; a picked point and a pose are asked about from the same panel.
    runs = []
    why.GetClientSideObject().AddObserver("ProgressEvent", lambda caller, event: runs.append(caller.GetProgress()))
    seen = max(range(visible.GetNumberOfTuples()), key=visible.GetValue)
    why.RankOfPose = seen + 1
    why.UpdatePipeline()
    check(said("LostIn") == "" or "probability" in said("Verdict"), said("Verdict"))
    check(min(share for share in runs if share > 0) >= 0.8, f"detection ran again: {runs[:4]}")
    check_panel(simple, why)
    return picture


def check_panel(simple, why):
    """The panel has a handle for the point and a box for the pose; it takes both places."""
    groups = [why.SMProxy.GetPropertyGroup(k).GetPanelWidget() for k in range(why.SMProxy.GetNumberOfPropertyGroups())]
    check({"InteractiveHandle", "InteractiveBox"} <= set(groups), f"widgets: {groups}")
    for place in ("Point", "Pose"):
        why.Place = place
        simple.SetActiveSource(why)
        why.UpdatePipeline()
        simple.Render()


status = 1
try:
    print("picture:", ask(), file=sys.__stderr__)
    status = 0
except BaseException:
    traceback.print_exc(file=sys.__stderr__)
sys.__stderr__.flush()
os._exit(status)
