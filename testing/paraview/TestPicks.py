# SPDX-License-Identifier: BSD-3-Clause
"""Planned picks over the scan: the gripper green or red, with a small legend, and beside it the rank of the pick or why the
part cannot be taken; grasps over the part. With PPFMEAM_PICTURE=FILE the picture goes there, that of docs/gallery.md."""
import os
import tempfile

from paraview import servermanager, simple

from pictures import pixels

SIZE = [840, 650]  # of the pictures


def check(condition, message):
    if not condition:
        raise AssertionError(message)


bin = simple.BinSceneSource(Copies=6, Width=640, Height=480)
scan, truth, part = (simple.OutputPort(bin, port) for port in range(3))
jaws = {"FingerWidth": 6, "FingerThickness": 4, "BodyWidth": 30, "BodyLength": 30}
grasps = simple.GraspDefinition(Input=part, **jaws)
picks = simple.PickPlanning(Input=truth, Mesh=part, Grasps=grasps, Scan=scan, **jaws)
view = simple.CreateRenderView()
view.OrientationAxesVisibility, view.ViewSize = 0, [840, 650]
held = simple.Show(part, view)
simple.Show(grasps, view)
check(held.Visibility == 1, "the part stays where its grasps are shown")
simple.HideAll(view)
simple.Show(scan, view)
controller = servermanager.vtkSMParaViewPipelineControllerWithRendering()
picks.UpdatePipeline()
check([port for port in range(3) if controller.ShowInPreferredView(picks.SMProxy, port, view.SMProxy)] == [0, 1],
      "picks and gripper come up by themselves, the bin's walls do not")
gripper = simple.Show(simple.OutputPort(picks, 1), view)
check(list(gripper.ColorArrayName) == ["CELLS", "Possible"], f"the gripper is colored by {gripper.ColorArrayName}")
gripper.SetScalarBarVisibility(view, True)
table = simple.GetColorTransferFunction("Possible")
check(list(table.Annotations)[1::2] == ["possible", "not possible"], f"the legend has {table.Annotations}")
check(simple.GetScalarBar(table, view).ScalarBarLength < 0.3, "the legend is not small")
labels = simple.Show(simple.OutputPort(picks, 0), view)
check((labels.Representation, labels.LabelArray) == ("Pose Labels", "Label"), f"the picks are shown as {labels.Representation}")
data = picks.GetClientSideObject().GetOutputDataObject(0).GetPointData()
texts = [data.GetAbstractArray("Label").GetValue(k) for k in range(data.GetNumberOfTuples())]
check(texts[0] == "pick 1" and any(text.endswith("covered") for text in texts), f"labels {set(texts)}")
check(sum(map(bool, texts)) == 6, "a label for each part")
most = labels.MaximumNumberOfPoseLabels
check(most >= 10000 and len(texts) > 100, f"of {len(texts)} picks {most} have labels, at random")
simple.Render(view)
simple.GetActiveCamera().Dolly(1.4)  # the bin fills the view
with tempfile.TemporaryDirectory() as folder:
    path = os.environ.get("PPFMEAM_PICTURE") or os.path.join(folder, "picks.png")
    with_labels = pixels(path if path.endswith(".png") else os.path.join(folder, "picks.png"), view, SIZE)
    if not path.endswith(".png"):
        simple.SaveScreenshot(path, view, ImageResolution=SIZE)
    level, spread = with_labels.max(axis=1), with_labels.max(axis=1) - with_labels.min(axis=1)
    for name, channel in (("red", 0), ("green", 1)):
        share = ((with_labels[:, channel] == level) & (spread > 60)).mean()
        check(share > 0.002, f"no {name} gripper: {share}")
    simple.Hide(simple.OutputPort(picks, 0), view)
    check((abs(pixels(os.path.join(folder, "without.png"), view, SIZE) - with_labels).max(axis=1) > 60).sum() > 300, "no labels in the view")
