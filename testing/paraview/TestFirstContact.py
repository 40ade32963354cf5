# SPDX-License-Identifier: BSD-3-Clause
"""The first clicks in the application, played by ParaView's own player: a CAD is opened, a series of scans is opened,
MEAM Pose Estimation, Apply; the page of what was found is saved; the charts; the series is played; Pose Diagnosis is asked about points of the scan, by Ctrl+P and
by P, and why a hidden part was missed; grasps are proposed, and picks planned. The state that is saved then is opened by
pvpython, which looks at it. Files that are no CAD are refused. The tutorial shows its text and opens its example; the dialog of the menu names its inputs.

Usage: TestFirstContact.py PARAVIEW PVPYTHON REPOSITORY; with PPFMEAM_PICTURE=FOLDER pictures of the whole window go there,
those of docs/gallery.md (needs python3-pil).
"""
import json
import math
import os
import re
import subprocess
import sys
import tempfile
import xml.etree.ElementTree as ElementTree

from clicks import (APPLY, BROWSER, LONGEST, PANEL, PROPERTIES, accept_inputs, check, choice, connect, event, expect, files, filter_of_menu, item,
                    menu, number, play, point_and_press, shoot, start, view)

RED, GREEN, BROWN = (220, 30, 30), (40, 170, 50), (140, 92, 51)
PICTURES = os.environ.get("PPFMEAM_PICTURE")
SCANS, COPIES, SIZE = (3, 12, (-1, -1)) if PICTURES else (2, 10, (640, 480))  # pixels; -1: the sensor's
POINT = PROPERTIES + "/InteractiveHandle"
CUP = 10  # mm: between the holes of the plate


def clicks(folder, hidden):
    """What is clicked, in stages that end with a picture of the gallery."""
    yield "first_contact", estimation(folder)
    yield "series", [*files("actionFileSaveData", "FileSaveDialog", f"{folder}/found.html"), event("PoseEstimationToolbar/ShowCharts", "activate"), event("VCRToolbar/actionVCRPlay", "activate")]
    yield "why", [
        event("PoseEstimationToolbar/AskWhy", "activate"), *point_and_press(view(1), 0.4, 0.6, "P", control=True), APPLY,
        *point_and_press(view(1), 0.5, 0.5, "P"), APPLY,  # alone it is taken where the focus is in the picture
        *files("actionFileSaveServerState", "FileSaveServerStateDialog", f"{folder}/picked.pvsm"),
        *(event(f"{POINT}/worldPosition{axis}", "set_string", f"{value:.3f}") for axis, value in zip("XYZ", hidden)), APPLY]


def estimation(folder):
    return [*files("actionFileOpen", "FileOpenDialog", f"{folder}/bins/models/obj_000001.ply"),
            *files("actionFileOpen", "FileOpenDialog", f"{folder}/bins/camera.json"),
            event("PoseEstimationToolbar/EstimatePoses", "activate"), APPLY]


def picks():
    """Grasps of the part, proposed for a cup, and picks of the poses."""
    return [*item(BROWSER, 0), *filter_of_menu("GraspDefinition"), choice("Propose", "Suction"), number("CupDiameter", CUP), APPLY,
            *item(BROWSER, 2), *filter_of_menu("PickPlanning"), *connect("Mesh", 0), *connect("Grasps", 0, 0, 0),
            *connect("Scan", 1, 0), accept_inputs(), choice("Gripper", "Suction cup"), number("CupDiameter", CUP), APPLY]


def tutorial(folder, text):
    """Its text, the names in the dialog of the menu, and its example."""
    select = "SelectInputDialog/buttonFrame"
    return [
        menu("menu_Help", "actionPPFMEAMTutorial"),
        expect("PPFMEAMTutorial/Page/Text", "plainText", text), *filter_of_menu("MEAMPoseEstimation"),
        expect(f"{select}/Input", "text", "Part"), expect(f"{select}/Scene", "text", "Scan"),
        event("SelectInputDialog/buttonBox/1QPushButton1", "activate"),
        event("PPFMEAMTutorial/Page/OpenExample", "activate"),
        event("PoseEstimationToolbar/EstimatePoses", "activate"),
        *files("actionFileSaveServerState", "FileSaveServerStateDialog", f"{folder}/example.pvsm")]


def refused(paraview, repository, folder):
    """Files that are no CAD are opened: the sentences, and that no other CAD takes the place of one that is empty."""
    contents = {"image": b"\x89PNG\r\n\x1a\n" + bytes(range(256)) * 9, "random": bytes(range(255, 0, -1)) * 9, "nothing": b"",
                "named": "solid Geh\u00e4use\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\n"
                         "endfacet\nendsolid\n".encode(),
                "empty": b"solid a\nendsolid a\n"}
    contents = {**{f"{name}.stl": content for name, content in contents.items()}, "cloud.xyz": b"0 0 700\n1 0 700\n0 1 700\n",
                **{f"image.{ending}": contents["image"] for ending in ("obj", "pcd", "ply")}}
    for name, content in contents.items():
        with open(f"{folder}/{name}", "wb") as file:
            file.write(content)
    box, events = "1QMessageBox0", []
    for path in (os.path.join(repository, "examples", "parts", "knob.stl"), *(f"{folder}/{name}" for name in contents)):
        events += files("actionFileOpen", "FileOpenDialog", path)
        events += [event("pqSelectReaderDialog/okButton", "activate")] if path.endswith("xyz") else []
        events += [APPLY, event(f"{PANEL}/Delete", "activate")] if path.endswith(("pcd", "ply")) else []
    events += [*item(BROWSER, 2)]
    events += [event("PoseEstimationToolbar/EstimatePoses", "activate"),
               expect(box, "text", "empty.stl has no triangles: delete it, or select another part."),
               event(f"{box}/qt_msgbox_buttonbox/1QPushButton0", "activate")]
    said, _ = start(paraview, folder, events, "--exit").communicate(timeout=LONGEST)
    for words in ("cloud.xyz was not opened: it is no PLOT3D grid", "image.obj was not opened: it is no OBJ but a PNG image",
                  "image.pcd' has a header line without", "image.ply' does not start with ply", "image.stl was not opened: it is no STL but a PNG image", "random.stl was not opened: it is no STL, or damaged",
                  "nothing.stl was not opened: it is empty", "Success =  true"):
        check(words in said, f"not said: {words}: {said[-3000:]}")
    check("named.stl" not in said, f"a text with letters beyond ASCII is refused: {said[-3000:]}")


def prepare(folder, repository):
    """Scans of a part, and a point of it in the last one that a sensor sees, though most lies under others."""
    import numpy
    from vtkmodules.util.numpy_support import vtk_to_numpy
    from vtkmodules.vtkIOImage import vtkPNGReader

    def pixels(path):
        reader = vtkPNGReader()
        reader.SetFileName(path)
        reader.Update()
        image = reader.GetOutput()
        return vtk_to_numpy(image.GetPointData().GetScalars()).reshape(image.GetDimensions()[1::-1])[::-1].astype(float)

    subprocess.run(["/usr/bin/python3", "-c", f"import batchtest; batchtest.dataset({folder + '/bins'!r}, {SCANS}, *{SIZE}, {COPIES})"],
                   cwd=os.path.join(repository, "testing", "filters"), check=True)
    scene = os.path.join(folder, "bins", "test", f"{SCANS - 1:06d}")
    with open(os.path.join(scene, "scene_gt_info.json")) as file:
        shares = [copy["visib_fract"] for copy in json.load(file)["0"]]
    with open(os.path.join(scene, "scene_camera.json")) as file:
        camera = json.load(file)["0"]
    copy = max((k for k, share in enumerate(shares) if share < 0.3), key=lambda k: shares[k])
    depth = pixels(os.path.join(scene, "depth", "000000.png")) * camera["depth_scale"]
    rows, columns = numpy.nonzero((pixels(os.path.join(scene, "mask_visib", f"000000_{copy:06d}.png")) > 0) & (depth > 0))
    middle = numpy.argmin((rows - numpy.median(rows)) ** 2 + (columns - numpy.median(columns)) ** 2)
    z = depth[rows[middle], columns[middle]]
    matrix = camera["cam_K"]
    return (columns[middle] - matrix[2]) / matrix[0] * z, (rows[middle] - matrix[5]) / matrix[4] * z, z


def plain(path):
    """A page as it reads: its headings and paragraphs, a line each."""
    with open(path) as file:
        text = re.sub(r"^(#+ .*)$", r"\1\n", file.read().strip(), flags=re.MULTILINE)
    blocks = re.split(r"\n\s*\n", text)
    return "\n".join(re.sub(r"[*`]|^#+ ", "", block.replace("\n", " ")) for block in blocks)


def share(picture, color):
    import pictures

    return pictures.share(pictures.pixels(picture), color)


def shown_in(view, hidden=False):
    """The representations of data, by kind of source and its port."""
    def key(representation):
        data = representation.Input
        return (data.GetXMLName() if hasattr(data, "GetXMLName") else data.SMProxy.GetXMLName()), data.Port
    return {key(r): r for r in view.Representations if hasattr(r, "Input") and (r.Visibility or hidden)}


def output(source, port=0):
    return source.GetClientSideObject().GetOutputDataObject(port)


def look(folder):
    """At what the user sees."""
    from paraview import simple

    simple.LoadState(os.path.join(folder, "state.pvsm"))
    found, why = simple.FindSource("MEAMPoseEstimation1"), simple.FindSource("PoseDiagnosis1")
    times = simple.GetTimeKeeper()
    check(list(times.TimestepValues) == list(range(SCANS)) and times.Time == SCANS - 1, f"the series stands at {times.Time}")
    view = next(v for v in simple.GetViews() if ("BOPReader", 0) in shown_in(v))
    shown = shown_in(view)
    check(sorted(shown) == [("BOPReader", 0), ("MEAMPoseEstimation", 2), ("PickPlanning", 0), ("PickPlanning", 1),
                            ("PickPlanning", 3), ("PoseDiagnosis", 0), ("PoseDiagnosis", 4)], f"shown: {sorted(shown)}")
    labels = shown_in(view, hidden=True)["MEAMPoseEstimation", 0]
    check((labels.Representation, labels.LabelArray) == ("Pose Labels", "Label"), f"labels: {labels.Representation}")
    check(list(shown["MEAMPoseEstimation", 2].ColorArrayName) == ["POINTS", "Rank"], "the parts are not coloured by rank")
    check(shown["BOPReader", 0].MapScalars == 0, "the scan is not grey")
    check(tuple(view.CameraViewUp) == (0, -1, 0), f"seen from {view.CameraPosition}, up {view.CameraViewUp}")
    bars = [r.Title for r in view.Representations if r.GetXMLName() == "ScalarBarWidgetRepresentation" and r.Visibility]
    check(sorted(bars) == ["Possible", "Rank", "Residual"], f"legends: {bars}")
    simple.Render(view)
    look_at_picks(simple, view, folder)
    check(output(found).GetNumberOfPoints() >= 2, f"{output(found).GetNumberOfPoints()} poses")
    check(output(found).GetPointData().GetAbstractArray("Label").GetValue(0).startswith("1: "), "the label of the first")
    picture = os.path.join(folder, "view.png")
    simple.SaveScreenshot(picture, view, ImageResolution=[640, 480])
    for color, least in ((RED, 0.005), (GREEN, 0.005), (BROWN, 0.002)):  # the last are points that lie under other parts
        check(share(picture, color) > least, f"{share(picture, color)} of {picture} has the colour {color}")
    verdict = output(why).GetFieldData().GetAbstractArray("Verdict").GetValue(0)
    check(verdict.startswith("Hidden: something lies in front of"), verdict)
    text = output(why, 3).GetValueByName(0, "Text").ToString()
    check(verdict in text.replace("\n", " ") and max(map(len, text.split("\n"))) <= 66, f"the answer in the view: {text}")
    look_at_charts(simple, found)
    look_at_pick(os.path.join(folder, "picked.pvsm"), output(simple.FindSource("camera.json")))


def look_at_charts(simple, found):
    charts = {key: v for v in simple.GetViews() if v.GetXMLName() == "XYBarChartView" for key in shown_in(v)}
    check(sorted(charts) == [("MEAMPoseEstimation", 3), ("MEAMPoseEstimation", 4)], f"charts: {charts}")
    scores, = shown_in(charts["MEAMPoseEstimation", 3]).values()
    check((scores.UseIndexForXAxis, scores.XArrayName) == (0, "Pose"), f"scores over {scores.XArrayName}")
    series = sorted(scores.SeriesVisibility)
    check(series == ["Certainty", "PlaceProbability", "Probability", "Score", "VisibleFraction"], f"bars of {series}")
    stages = output(found, 4).GetColumnByName("Stage")
    labels = [re.sub(r"\s", "", label) for label in charts["MEAMPoseEstimation", 4].BottomAxisLabels[1::2]]
    check(labels == [stages.GetValue(k) for k in range(stages.GetNumberOfValues())], f"bars of {labels}")


def look_at_picks(simple, view, folder):
    """The gripper at its picks, green and red, with labels and an answer; beside it the part with its grasps."""
    picks, shown = simple.FindSource("PickPlanning1"), shown_in(view)
    labels = output(picks).GetPointData().GetAbstractArray("Label")
    labels = [label for label in (labels.GetValue(k) for k in range(labels.GetNumberOfValues())) if label]
    check("pick 1" in labels and any(not label.startswith("pick") for label in labels), f"labels: {labels}")
    text = output(picks, 3).GetValueByName(0, "Text").ToString()
    check(re.match(r"\d of 5 copies can be picked", text) and "\nCopies " in text, f"the answer in the view: {text}")
    beside = sorted(key for v in simple.GetViews() if v.GetXMLName() == "RenderView" and v != view for key in shown_in(v))
    check([name for name, _ in beside] == ["GraspDefinition", "GraspDefinition", "PLYReader"], f"beside the scan: {beside}")
    picture = os.path.join(folder, "picks.png")
    others = [r for key, r in shown.items() if key not in (("PickPlanning", 1), ("PickPlanning", 0))]
    for representation in others:
        representation.Visibility = 0
    simple.SaveScreenshot(picture, view, ImageResolution=[640, 480])
    for color in (RED, GREEN):
        check(share(picture, color) > 0.005, f"{share(picture, color)} of {picture} has the colour {color}")
    for representation in others:
        representation.Visibility = 1
    for port in (0, 1, 3):
        shown["PickPlanning", port].Visibility = 0


def look_at_pick(path, scan):
    """The point of Pose Diagnosis is that of the part that is drawn in the middle of the picture, where the scan is, too."""
    from vtkmodules.vtkCommonDataModel import vtkLine

    numbers = {(proxy.get("type"), entry.get("name")): [float(element.get("value")) for element in entry.iter("Element")]
               for proxy in ElementTree.parse(path).getroot().iter("Proxy") for entry in proxy.iterfind("Property")
               if entry.get("name") in ("Position", "CameraPosition", "CameraFocalPoint")}
    point = numbers["PoseDiagnosis", "Position"]
    beside = math.dist(point, scan.GetPoint(scan.FindPoint(point)))
    check(beside < 2, f"{point} is {beside} mm from the nearest point of the scan")
    check(PICTURES or beside > 0.001, f"{point} is a point of the scan: no part is drawn there")  # in that of the pictures none is
    off = vtkLine.DistanceToLine(point, numbers["RenderView", "CameraPosition"], numbers["RenderView", "CameraFocalPoint"])
    check(math.sqrt(off) < 0.1, f"{point} is {math.sqrt(off)} mm from the ray through the middle")


def look_at_page(path):
    """File > Save Data of the poses is the page of `detect --report`."""
    with open(path) as file:
        text = file.read()
    check("<title>obj_000001 in camera.json</title>" in text and "poses are more likely there than not" in text, text[:400])
    check(text.count('"why":"Most for it: ') >= 2, "the poses have no reasons")


def look_at_example(path):
    """The button took the example's part and scan."""
    proxies = {p.get("type"): p for p in ElementTree.parse(path).getroot().iter("Proxy") if p.get("group") in ("sources", "filters")
               and p.get("type") == "BinSceneSource"}
    check(proxies, "the example is not open")
    bin_id = proxies["BinSceneSource"].get("id")
    inputs = [{p.get("name"): [(x.get("value"), x.get("output_port")) for x in p.iter("Proxy")] for p in e.iter("Property")
               if p.get("name") in ("Input", "Scene")} for e in ElementTree.parse(path).getroot().iter("Proxy")
              if e.get("type") == "MEAMPoseEstimation"]
    check({"Input": [(bin_id, "2")], "Scene": [(bin_id, "0")]} in inputs, f"connected: {inputs}")


def main(paraview, pvpython, repository):
    with tempfile.TemporaryDirectory() as folder:
        refused(paraview, repository, folder)
        hidden = prepare(folder, repository)
        events = []
        for name, stage in clicks(folder, hidden):
            events += stage
            if PICTURES:
                shoot(paraview, folder, events, os.path.join(PICTURES, f"application_{name}.jpg"))
        if PICTURES:
            shoot(paraview, folder, estimation(folder) + picks(), os.path.join(PICTURES, "application_picks.jpg"))
        events += picks() + files("actionFileSaveServerState", "FileSaveServerStateDialog", f"{folder}/state.pvsm")
        events += tutorial(folder, plain(os.path.join(repository, "docs", "tutorial.md")))
        play(paraview, folder, events)
        look_at_page(os.path.join(folder, "found.html"))
        look_at_example(os.path.join(folder, "example.pvsm"))
        subprocess.run([pvpython, os.path.abspath(__file__), "--look", folder], check=True)


if sys.argv[1] == "--look":
    look(sys.argv[2])
else:
    main(*sys.argv[1:])
