# SPDX-License-Identifier: BSD-3-Clause
"""What ParaView shows without a word from the user: poses in the colours of their ranks, a grey scan, both seen from the
sensor, and nothing in front; of a chain's steps the last, over the scan."""
import os
import re
import tempfile

import numpy
import ppfmeam
from paraview import servermanager, simple

from pictures import pixels, share

# In the colours of RankColor.
RANKS = {"red": (220, 30, 30), "green": (40, 170, 50), "blue": (40, 90, 220), "yellow": (245, 205, 30),
         "pink": (240, 120, 190)}
folder = tempfile.TemporaryDirectory()
controller = servermanager.vtkSMParaViewPipelineControllerWithRendering()


def check(condition, message):
    if not condition:
        raise AssertionError(message)


def drawn(view, size=(400, 300)):
    return pixels(os.path.join(folder.name, "view.png"), view, list(size))


def answers(view):
    return [r for r in view.Representations if r.GetXMLName() == "TextSourceRepresentation" and r.Visibility]


def shown_by_default(source):
    """Ports that are shown when the source is applied for the first time."""
    view = simple.GetActiveView().SMProxy
    return [port for port in range(source.SMProxy.GetNumberOfOutputPorts())
            if controller.ShowInPreferredView(source.SMProxy, port, view) is not None]


# Twelve poses in two rows, red, green, blue, yellow, pink, the same, dark, and grey twice.
poses = os.path.join(folder.name, "poses.txt")
with open(poses, "w") as file:
    for i in range(12):
        file.write(f"1 0 0 {1.2 * (i % 6) - 3}  0 1 0 {1.2 * (i // 6) - 0.6}  0 0 1 10  0 0 0 1\n")
view = simple.CreateRenderView()
view.OrientationAxesVisibility = 0
mesh = simple.Sphere(ThetaResolution=32, PhiResolution=32)
part = simple.Show(mesh, view)
instances = simple.PoseInstances(Input=simple.PoseReader(FileName=poses), Mesh=mesh)
display = simple.Show(instances, view)
check(list(display.ColorArrayName) == ["POINTS", "Rank"], f"coloured by {display.ColorArrayName}")
check(part.Visibility == 0, "the part itself is still shown")
simple.ResetCamera(view)
picture = drawn(view)
for name, color in RANKS.items():
    check(share(picture, color) > 0.005, f"no {name}: {share(picture, color)}")
grey = (abs(picture - picture.mean(axis=1, keepdims=True)).max(axis=1) < 3) & (picture[:, 0] > 50)
check(grey.mean() > 0.004, f"no grey: {grey.mean()}")

# By cells the same; the colours are those of the array RankColor.
simple.ColorBy(display, ("CELLS", "Rank"))
picture = drawn(view)
check(all(share(picture, color) > 0.005 for color in RANKS.values()), "cells have other colours")
table = simple.GetColorTransferFunction("Rank")
colors = instances.GetClientSideObject().GetOutputDataObject(0).GetCellData().GetArray("RankColor")
cells = colors.GetNumberOfTuples() // 12
for rank in range(10):
    channels = [round(255 * c) for c in table.IndexedColors[3 * rank:3 * rank + 3]]
    check(channels == list(colors.GetTuple(cells * rank)), f"rank {rank + 1}: {channels}")

# The legend has the ten, and is small.
display.SetScalarBarVisibility(view, True)
bar = simple.GetScalarBar(table, view)
check(bar.Visibility == 1 and bar.ScalarBarLength < 0.3, "the legend of the ranks")

# A scan: grey, from where the sensor is; what stands in front of it is hidden.
view = simple.CreateRenderView()
view.OrientationAxesVisibility = 0
cad = simple.Show(simple.Sphere(Radius=20.0), view)
scene = simple.BinSceneSource(Copies=2, Width=160, Height=120)
check(shown_by_default(scene) == [0], f"ports {shown_by_default(scene)} are shown")
scan = simple.Show(simple.OutputPort(scene, 0), view)
check(list(scan.ColorArrayName) == ["POINTS", "Intensity"] and scan.MapScalars == 0, "the grey values of the image")
check(cad.Visibility == 0, "the CAD stands between the sensor and the scan")


def check_camera():
    forward = [f - p for f, p in zip(view.CameraFocalPoint, view.CameraPosition)]
    check(tuple(view.CameraViewUp) == (0, -1, 0) and forward[2] > 0 and abs(forward[0]) + abs(forward[1]) < 1e-6,
          f"the camera: {view.CameraPosition} {view.CameraFocalPoint} {view.CameraViewUp}")


check_camera()
simple.Render(view)
check_camera()
view.Background, view.UseColorPaletteForBackground = [0.5, 0.5, 0.5], 0
picture = drawn(view)
check((picture.max(axis=1) - picture.min(axis=1)).max() < 3, "the scan is not grey")
check(picture.std() > 10, "the scan is not in sight")

# A point of it can be picked (Ctrl+P in the application).
point = [0.0, 0.0, 0.0]
view.SMProxy.ConvertDisplayToPointOnSurface([size // 2 for size in view.ViewSize], point, [0.0, 0.0, 0.0], True)
data = scene.GetClientSideObject().GetOutputDataObject(0)
check(abs(point[0]) + abs(point[1]) < 20 < point[2] and data.FindPoint(point) >= 0
      and data.GetPoint(data.FindPoint(point)) == tuple(point), f"the picked point is {point}")
scan.SetScalarBarVisibility(view, True)
check(simple.GetScalarBar(simple.GetColorTransferFunction("Intensity"), view).Visibility == 0, "a legend of grey values")

# The camera is the user's from then on, and the scan stays when poses are shown.
view.CameraViewUp = [0, 1, 0]
found = simple.PoseInstances(Input=simple.OutputPort(scene, 1), Mesh=simple.OutputPort(scene, 2))
simple.Show(found, view)
check(tuple(view.CameraViewUp) == (0, 1, 0), "the camera is moved again")
check(scan.Visibility == 1, "the scan is gone")
check(found.SMProxy.GetHints().FindNestedElementByName("Visibility"), "inputs are hidden")
check(max(share(drawn(view), RANKS[name]) for name in ("red", "green")) > 0.01, "no parts over the scan")

# Points alone without colors: gray, and behind a part whose surface they are on.
with open(os.path.join(folder.name, "cloud.ply"), "w") as file:
    places = [(x, y, 499.9) for x in range(-60, 61) for y in range(-60, 61)]
    file.write(f"ply\nformat ascii 1.0\nelement vertex {len(places)}\nproperty float x\nproperty float y\nproperty float z\nend_header\n")
    file.writelines(f"{x} {y} {z}\n" for x, y, z in places)
with open(os.path.join(folder.name, "pose.txt"), "w") as file:
    file.write("1 0 0 0  0 1 0 0  0 0 1 500  0 0 0 1\n")
view = simple.CreateRenderView()
view.OrientationAxesVisibility = 0
cloud = simple.Show(simple.PLYCloudReader(FileName=os.path.join(folder.name, "cloud.ply")), view)
cloud.PointSize = 5
view.CameraPosition, view.CameraFocalPoint, view.CameraViewUp = [0, 0, 0], [0, 0, 500], [0, -1, 0]
view.Background, view.UseColorPaletteForBackground = [0, 0, 0], 0
picture = drawn(view)
check((picture.max(axis=1) - picture.min(axis=1)).max() < 3 and 60 < numpy.median(picture[picture.max(axis=1) > 20]) < 180,
      "points alone are not gray")
box = simple.Box(XLength=80.0, YLength=80.0, ZLength=20.0, Center=[0, 0, 10])
simple.Show(simple.PoseInstances(Input=simple.PoseReader(FileName=os.path.join(folder.name, "pose.txt")), Mesh=box), view)
over = share(drawn(view), RANKS["red"])
cloud.Visibility = 0
alone = share(drawn(view), RANKS["red"])
check(over > 0.95 * alone > 0.05, f"{over} of the picture is the part over points, {alone} without them")
cloud.Visibility, cloud.UseShaderReplacements = 1, 0
check(share(drawn(view), RANKS["red"]) < 0.5 * alone, "the points would not hide the part anyhow")

# A step of poses takes the place of what it was made of, but not of the scan; edges and answers come over it.
view = simple.CreateRenderView()
plate = simple.SamplePartSource(Part="Hole plate")
bin = simple.BinSceneOfPart(Input=plate, Copies=2, Width=320, Height=240)
shown = simple.Show(simple.OutputPort(bin, 0), view)
found = simple.MEAMPoseEstimation(Input=plate, Scene=simple.OutputPort(bin, 0))
edges = simple.Show(simple.OutputPort(found, 1), view)
check(list(edges.ColorArrayName) == ["POINTS", "Rank"], f"edges are coloured by {edges.ColorArrayName}, not by what explains them")
poses = simple.Show(simple.OutputPort(found, 0), view)
answer, = answers(view)
hidden = [k for k in range(5) if not found.GetClientSideObject().GetOutputDataObject(0).GetPointData().GetAbstractArray("Label").GetValue(k)]
text = found.GetClientSideObject().GetOutputDataObject(5).GetValueByName(0, "Text").ToString()
check(hidden and text.startswith(f"{len(hidden)} of 5 poses are not shown") and answer.Input.Port == 5, f"{len(hidden)} are hidden: {text}")
model = simple.MEAMHashing(Input=simple.TangentEstimation(Input=simple.BoundaryExtraction(Input=simple.VisibilityExtraction(
    Input=simple.SurfaceSampling(Input=simple.MeshPreparation(Input=plate))))))
verified = simple.PoseVerification(Input=simple.OutputPort(found, 0), Model=model, SceneEdges=simple.OutputPort(found, 1),
                                   SceneSurface=simple.OutputPort(bin, 0))
simple.Show(verified, view)
check((shown.Visibility, edges.Visibility, poses.Visibility) == (1, 0, 0), "what a step was made of is hidden, but the scan")
for name in ("SceneEdgeExtraction", "PoseDetection", "PoseScreening", "PoseVerification", "PoseSelection", "PoseRefinement",
             "ConflictResolution"):
    hint = servermanager.ProxyManager().SMProxyManager.GetPrototypeProxy("filters", name).GetHints()
    hint = hint and hint.FindNestedElementByName("Visibility")
    check(hint and hint.GetAttribute("replace_input") == "0", f"{name} hides the scan in the application")
why = simple.PoseDiagnosis(Input=plate, Scene=simple.OutputPort(bin, 0), Place="Point")
simple.Show(why, view)
answer, = answers(view)
check(answer.WindowLocation == "Upper Left Corner" and answer.FontSize == 12, f"the answer is {answer.WindowLocation}")
check(answer.BackgroundColor[3] > 0.5 and answer.ShowBorder == "Always", "the answer cannot be read over a scan")

# A scan with colours shows them.
view = simple.CreateRenderView()
scan = simple.Show(simple.OutputPort(simple.BinSceneSource(Copies=2, Width=160, Height=120, Colored=1), 0), view)
check(list(scan.ColorArrayName) == ["POINTS", "RGB"] and scan.MapScalars == 0, "the colours of the image")

# Poses that are judged: a point for each in front of all else, in the colours of what they are, with a small legend.
def row(x, cosine=1, sine=0):
    return f"{cosine} {-sine} 0 {x}  {sine} {cosine} 0 0  0 0 1 600  0 0 0 1\n"


for name, text in (("found.txt", row(-60) + row(-58) + row(0, 0, 1) + row(50)), ("true.txt", row(-60) + row(0))):
    with open(os.path.join(folder.name, name), "w") as file:
        file.write(text)
found, true = (simple.PoseReader(FileName=os.path.join(folder.name, name)) for name in ("found.txt", "true.txt"))
judged = simple.PoseEvaluation(Input=found, TruePoses=true, Diameter=50.0)
view = simple.CreateRenderView()
view.OrientationAxesVisibility = 0
check(2 in shown_by_default(judged) and 1 not in shown_by_default(judged), f"ports {shown_by_default(judged)} are shown")
simple.SetActiveView(view)
points = simple.Show(simple.OutputPort(judged, 2), view)
check(list(points.ColorArrayName) == ["POINTS", "PoseOutcome"] and points.PointSize > 5, f"coloured by {points.ColorArrayName}")
table = simple.GetColorTransferFunction("PoseOutcome")
check(list(table.Annotations) == ["0", "right", "1", "duplicate", "2", "wrong turn", "3", "wrong place"], f"{table.Annotations}")
points.SetScalarBarVisibility(view, True)
check(simple.GetScalarBar(table, view).ScalarBarLength < 0.3, "the legend is not small")
points.SetScalarBarVisibility(view, False)
simple.ResetCamera(view)
picture = drawn(view)
for name, color in (("green", RANKS["green"]), ("yellow", RANKS["yellow"]), ("violet", (150, 60, 190)), ("red", RANKS["red"])):
    check(share(picture, color) > 0.0001, f"no {name} point: {share(picture, color)}")

def check_legends(view, number):
    """None meets another one in a narrow view: what is drawn with all is what each draws alone."""
    shown = [r for r in view.Representations if r.GetXMLName() == "ScalarBarWidgetRepresentation" and r.Visibility]
    check(len(shown) == number, f"{len(shown)} legends are shown")
    for legend in shown:
        legend.Visibility = 0
    view.ViewSize, alone = [100, 800], []
    empty = drawn(view, view.ViewSize)
    for legend in shown:
        legend.Visibility = 1
        alone.append((drawn(view, view.ViewSize) != empty).any(axis=1))
        legend.Visibility = 0
    for legend in shown:
        legend.Visibility = 1
    check(all(one.sum() > 100 for one in alone) and max(sum(one.astype(int) for one in alone)) == 1,
          f"legends at {[(r.WindowLocation, list(r.Position)) for r in shown]} meet")


# Types of part are called by their files; the legend lists those that there are.
view = simple.CreateRenderView()
parts = []
for kind in ("Hole plate", "Flap", "Knob"):
    path = os.path.join(folder.name, f"{kind.lower()}.stl")
    part = simple.SamplePartSource(Part=kind)
    simple.SaveData(path, part)
    parts.append(simple.STLReader(registrationName=kind, FileNames=[path]))
bin = simple.BinSceneOfPart(registrationName="Bin", Input=parts[0], Copies=2, Width=320, Height=240)
types = simple.MEAMPoseEstimation(registrationName="Types", Input=parts[:2], Scene=simple.OutputPort(bin, 0), MaximumNumberOfPoses=1)
simple.Show(simple.OutputPort(types, 2), view)
simple.Show(simple.OutputPort(types, 0), view)
simple.Render(view)
data = types.GetClientSideObject().GetOutputDataObject(0)
check(data.GetPointData().GetAbstractArray("Label").GetValue(0).startswith("1 (hole plate)"), "the label names the file")
table = simple.GetColorTransferFunction("PartId")
check(list(table.Annotations) == ["0", "hole plate", "1", "flap"], f"the legend has {table.Annotations}")
types.Input = parts[1:]
simple.Render(view)
check(list(table.Annotations) == ["0", "flap", "1", "knob"], f"the legend of other types has {table.Annotations}")

# Another estimation has a legend of its own types; what the user changes stays, also after a state was loaded.
others = simple.MEAMPoseEstimation(registrationName="Others", Input=parts[:2], Scene=simple.OutputPort(bin, 0), MaximumNumberOfPoses=1)
copies = simple.Show(simple.OutputPort(others, 2), view)
copies.SetScalarBarVisibility(view, True)
own = copies.LookupTable
labels = simple.Show(simple.OutputPort(others, 0), view)
check(labels.LookupTable.SMProxy is own.SMProxy, "the labels of an estimation have another map than its copies")
check(list(table.Annotations) == ["0", "flap", "1", "knob"], f"another estimation has written {table.Annotations}")
check(list(own.Annotations) == ["0", "hole plate", "1", "flap"] and list(own.IndexedColors) == list(table.IndexedColors),
      f"the legend of another estimation has {own.Annotations}")
check(simple.GetScalarBar(own, view).ScalarBarLength < 0.3, "its legend is large")
simple.GetRepresentation(simple.OutputPort(types, 0), view).SetScalarBarVisibility(view, True)
check_legends(view, 2)
unnamed = simple.Show(simple.Calculator(Input=simple.PoseReader(FileName=os.path.join(folder.name, "poses.txt")), ResultArrayName="PartId", Function="Rank - 1"), view)
simple.ColorBy(unnamed, ("POINTS", "PartId"))
simple.Render(view)
unnamed.SetScalarBarVisibility(view, True)
check(list(unnamed.LookupTable.Annotations[1::2]) == [f"part {k + 1}" for k in range(12)] and list(table.Annotations) == ["0", "flap", "1", "knob"],
      f"the legend of twelve types without names has {unnamed.LookupTable.Annotations}, that of the files {table.Annotations}")
check_legends(view, 3)
simple.Delete(unnamed.Input)
with open(os.path.join(os.path.dirname(ppfmeam.__file__), "report", "page.js")) as file:
    palette = re.search(r"palette = \[(.*?)\]", file.read(), re.DOTALL).group(1)
check(["#{:02x}{:02x}{:02x}".format(*(round(255 * c) for c in table.IndexedColors[3 * k:3 * k + 3])) for k in range(12)]
      == re.findall("#......", palette), f"the page has the types in {palette}")
table.Annotations = ["0", "lid", "1", "button"]
for other in simple.GetViews():
    if other.SMProxy is not view.SMProxy:
        simple.Delete(other)
state = os.path.join(folder.name, "types.pvsm")
simple.SaveState(state)
with open(state) as file:
    text = file.read()
earlier, changes = re.subn(r'<Annotation key="PPFMEAM.TypeNames"[^>]*>', "", text)  # as earlier versions saved it
check(changes, "a state has no annotation")
with open(state, "w") as file:
    file.write(earlier)
simple.ResetSession()
simple.LoadState(state)
types, others, *parts = map(simple.FindSource, ("Types", "Others", "Flap", "Knob"))
view, = simple.GetViews()
for source, expected, now in ((types, ["0", "lid", "1", "button"], ["0", "lid", "1", "button"]),
                              (others, ["0", "hole plate", "1", "flap"], ["0", "flap", "1", "knob"])):
    table = simple.GetRepresentation(simple.OutputPort(source, 2), view).LookupTable
    check(list(table.Annotations) == expected, f"the state has {table.Annotations}")
    source.Input = parts
    simple.Render(view)
    check(list(table.Annotations) == now, f"after the state was loaded and Apply it has {table.Annotations}")

# What comes out of a second Apply, after one that failed, is colored, too.
view = simple.CreateRenderView()
plate, scan = simple.FindSource("Hole plate"), simple.OutputPort(simple.FindSource("Bin"), 0)
found = simple.MEAMPoseEstimation(Input=plate, Scene=scan, MaximumNumberOfPoses=1, CADScale=0.001)
copies = simple.Show(simple.OutputPort(found, 2), view)
simple.Render(view)
check(not copies.ColorArrayName[0], "there is nothing to color")
colored = simple.Show(simple.OutputPort(found, 2), simple.CreateRenderView())
colored.DiffuseColor = colored.AmbientColor = [0, 0, 1]
found.CADScale = 1
simple.RenderAllViews()
check(not colored.ColorArrayName[0], f"the user's color gives way to {colored.ColorArrayName}")
check(list(copies.ColorArrayName) == ["POINTS", "Rank"], f"after a failure they are colored by {copies.ColorArrayName}")
