# SPDX-License-Identifier: BSD-3-Clause
"""What a new user does in one go, by clicks: a new part by its page, a wrong pose and a part that was missed are asked about,
two types of part, a gripper and its picks, poses and the report saved. pvpython looks at what was saved.

Usage: TestWorkflow.py PARAVIEW PVPYTHON REPOSITORY; with PPFMEAM_PICTURE=FOLDER pictures of the window go there, those of
docs/gallery.md (needs python3-pil).
"""
import json
import os
import re
import subprocess
import sys
import tempfile
import xml.etree.ElementTree as ElementTree

from clicks import (APPLY, BROWSER, NEW_PART, PANEL, PROPERTIES, START, check, event, files, item, new_part_choice, new_part_file,
                    new_part_length, play, share, shoot)

POINT = PROPERTIES + "/InteractiveHandle"
CAD, SCAN, POSES, DIAGNOSIS = range(4)  # rows of the pipeline browser
OTHER_CAD, BOTH = 2, 3  # when what came after the scan is deleted
COPIES = 12  # some lie under others
NEW_POSES = 2  # when both CADs are deleted and the part is searched once more


def points_to_ask(folder):
    """Measured points far from all likely poses: on a pose where no copy is, and on a copy where no pose is."""
    import numpy
    import ppfmeam

    model, scan = ppfmeam.train(f"{folder}/part.stl"), f"{folder}/scan.pcd"
    found = ppfmeam.detect(model, scan, poses=0)
    likely = found.place_probabilities >= 0.5
    truth = numpy.loadtxt(f"{folder}/truth.txt").reshape(-1, 4, 4)
    apart = numpy.linalg.norm(truth[:, None, :3, 3] - found.poses[None, :, :3, 3], axis=2) > 10  # mm
    wrong, missed = found.poses[~likely & apart.all(axis=0)], truth[apart.all(axis=1)]

    def measured(poses):
        told = ppfmeam.why(model, scan, pose=poses, poses=0)
        return [each.points[numpy.array(each.states) == "explained"] for each in told]

    taken = numpy.concatenate(measured(found.poses[likely]))

    def farthest(poses):
        """The points on them, the farthest from likely poses first."""
        return [point for _, point in sorted(((numpy.linalg.norm(taken - point, axis=1).min(), tuple(point))
                                              for points in measured(poses) for point in points[::40]), reverse=True)]

    return farthest(wrong)[0], next(point for point in farthest(missed) if found.why(at=point).lost_in)


def ask(place):
    """The point of Pose Diagnosis, as it is written into its panel."""
    return [*(event(f"{POINT}/worldPosition{axis}", "set_string", f"{value:.3f}") for axis, value in zip("XYZ", place)), APPLY]


def delete(row):
    return [*item(BROWSER, row), event(f"{PANEL}/Delete", "activate")]


def stages(folder, repository, wrong, missed):
    """What is clicked, in stages, and the pictures of the gallery that they end with."""
    files_of_part = [new_part_file("CAD", f"{folder}/part.stl"), new_part_file("Scan", f"{folder}/scan.pcd")]
    yield "wrong_pose", [
        NEW_PART, *files_of_part, START,
        *item(BROWSER, POSES), share("ShownProbability", 0), APPLY,
        event("PoseEstimationToolbar/AskWhy", "activate"), *ask(wrong),
        *files("actionFileSaveServerState", "FileSaveServerStateDialog", f"{folder}/wrong.pvsm")]
    yield "missed", [
        *item(BROWSER, POSES), share("ShownProbability", 0.5), APPLY, *item(BROWSER, DIAGNOSIS), *ask(missed),
        *files("actionFileSaveServerState", "FileSaveServerStateDialog", f"{folder}/missed.pvsm")]
    yield "two_types", [
        *delete(DIAGNOSIS), *delete(POSES),
        *files("actionFileOpen", "FileOpenDialog", os.path.join(repository, "examples", "parts", "knob.stl")),
        *item(BROWSER, CAD), *item(BROWSER, OTHER_CAD, control=True), event("PoseEstimationToolbar/EstimatePoses", "activate"), APPLY,
        *files("actionFileSaveServerState", "FileSaveServerStateDialog", f"{folder}/types.pvsm")]
    yield "report", [
        *delete(BOTH), *files("actionFileSaveServerState", "FileSaveServerStateDialog", f"{folder}/deleted.pvsm"), *delete(OTHER_CAD),
        new_part_choice("Gripper", "Parallel jaws"), new_part_length("FingerWidth", 8), new_part_length("FingerThickness", 5), START,
        *item(BROWSER, NEW_POSES), *files("actionFileSaveData", "FileSaveDialog", f"{folder}/poses.json"),
        event("WriterSettingsDialog/widget/OKButton", "activate"),
        *files("actionFileSaveData", "FileSaveDialog", f"{folder}/found.html"),
        *files("actionFileSaveServerState", "FileSaveServerStateDialog", f"{folder}/picks.pvsm")]


def main(paraview, pvpython, repository):
    with tempfile.TemporaryDirectory() as folder:
        subprocess.run([sys.executable, os.path.join(repository, "testing", "install", "scan.py"), "make", folder, str(COPIES)], check=True)
        wrong, missed = points_to_ask(folder)
        events = []
        for name, stage in stages(folder, repository, wrong, missed):
            events += stage
            if os.environ.get("PPFMEAM_PICTURE"):
                shoot(paraview, folder, events, os.path.join(os.environ["PPFMEAM_PICTURE"], f"application_{name}.jpg"))
        play(paraview, folder, events)
        subprocess.run([pvpython, os.path.abspath(__file__), "--look", folder], check=True)


def shown(path, name):
    """Whether a source is to be seen in a view of a state."""
    state = ElementTree.parse(path).getroot()
    (number,) = {entry.get("id") for entry in state.iter("Item") if entry.get("name") == name}

    def values(proxy, name):
        return [value.get("value") for entry in proxy.findall("Property") if entry.get("name") == name for value in entry]

    return any(values(proxy, "Visibility")[0] == "1" for proxy in state.iter("Proxy")
               if proxy.get("group") == "representations" and number in values(proxy, "Input"))


def look(folder):
    """The wrong pose is told to be one, and why the other part was missed; two types are looked for; the poses that are saved
    are those that picks are of, and the report has them."""
    from paraview import simple

    def output(name, file, port=0):
        simple.ResetSession()
        simple.LoadState(os.path.join(folder, file))
        source = simple.FindSource(name)
        source.UpdatePipeline()
        return source.GetClientSideObject().GetOutputDataObject(port)

    said = output("PoseDiagnosis1", "wrong.pvsm").GetFieldData()
    verdict, reasons = (said.GetAbstractArray(name).GetValue(0) for name in ("Verdict", "Reasons"))
    check(re.match(r"Found as rank \d+, [0-4]?\d %", verdict) and "Against it" in reasons, f"{verdict} {reasons}")
    said = output("PoseDiagnosis1", "missed.pvsm").GetFieldData()
    verdict, advice = (said.GetAbstractArray(name).GetValue(0) for name in ("Verdict", "Advice"))
    check(not verdict.startswith(("Found", "No part")) and advice, f"{verdict} {advice}")
    names = output("MEAMPoseEstimation1", "types.pvsm").GetFieldData().GetAbstractArray("PartName")
    check([names.GetValue(k) for k in range(names.GetNumberOfValues())] == ["part", "knob"], "the types that are looked for")
    check(not shown(f"{folder}/deleted.pvsm", "knob.stl"), "the CAD of poses that were deleted is shown in front of the scan")
    picks = output("PickPlanning1", "picks.pvsm").GetPointData().GetArray("Instance")
    with open(os.path.join(folder, "poses.json")) as file:
        poses = json.load(file)["poses"]
    with open(os.path.join(folder, "found.html")) as file:
        page = file.read()
    check("<title>part in scan.pcd</title>" in page and page.count("<tr data-rank") == len(poses), page[:400])
    check(len(poses) == picks.GetRange()[1] >= 2, f"{len(poses)} poses are saved, picks are of {picks.GetRange()[1]}")


if sys.argv[1] == "--look":
    look(sys.argv[2])
else:
    main(*sys.argv[1:])
