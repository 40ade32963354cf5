# SPDX-License-Identifier: BSD-3-Clause
"""What a new user does in one go, by clicks: a new part by its page, a wrong pose that is asked about, two types of part, a
gripper and its picks, poses and picks saved. pvpython looks at what was saved.

Usage: TestWorkflow.py PARAVIEW PVPYTHON REPOSITORY; with PPFMEAM_PICTURE=FOLDER pictures of the window go there, those of
docs/gallery.md (needs python3-pil).
"""
import json
import os
import re
import subprocess
import sys
import tempfile

from clicks import (APPLY, BROWSER, NEW_PART, PANEL, PROPERTIES, START, check, event, files, item, new_part_choice, new_part_file,
                    new_part_length, play, share, shoot)

POINT = PROPERTIES + "/InteractiveHandle"
CAD, SCAN, POSES, DIAGNOSIS = range(4)  # rows of the pipeline browser
OTHER_CAD, BOTH = 2, 3  # when what came after the scan is deleted
NEW_POSES = 3  # after the other CAD and those of the part once more


def wrong_point(folder):
    """A measured point on an unlikely pose and far from all likely ones."""
    import numpy
    import ppfmeam

    model, scan = ppfmeam.train(f"{folder}/part.stl"), f"{folder}/scan.pcd"
    found = ppfmeam.detect(model, scan, poses=0)
    likely = found.place_probabilities >= 0.5
    told = ppfmeam.why(model, scan, pose=found.poses, poses=0)
    on = [each.points[numpy.array(each.states) == "matched"] for each in told]
    taken = numpy.concatenate([points for points, is_likely in zip(on, likely) if is_likely])
    free = [(numpy.linalg.norm(taken - point, axis=1).min(), tuple(point)) for points, is_likely in zip(on, likely)
            if not is_likely for point in points[::20]]
    return max(free)[1]


def delete(row):
    return [*item(BROWSER, row), event(f"{PANEL}/Delete", "activate")]


def stages(folder, repository, wrong):
    """What is clicked, in stages, and the pictures of the gallery that they end with."""
    files_of_part = [new_part_file("CAD", f"{folder}/part.stl"), new_part_file("Scan", f"{folder}/scan.pcd")]
    yield "wrong_pose", [
        NEW_PART, *files_of_part, START,
        *item(BROWSER, POSES), share("ShownProbability", 0), APPLY,
        event("PoseEstimationToolbar/AskWhy", "activate"),
        *(event(f"{POINT}/worldPosition{axis}", "set_string", f"{value:.3f}") for axis, value in zip("XYZ", wrong)), APPLY,
        *files("actionFileSaveServerState", "FileSaveServerStateDialog", f"{folder}/wrong.pvsm")]
    yield "two_types", [
        *delete(DIAGNOSIS), *delete(POSES),
        *files("actionFileOpen", "FileOpenDialog", os.path.join(repository, "examples", "parts", "knob.stl")),
        *item(BROWSER, CAD), *item(BROWSER, OTHER_CAD, control=True), event("PoseEstimationToolbar/EstimatePoses", "activate"), APPLY,
        *files("actionFileSaveServerState", "FileSaveServerStateDialog", f"{folder}/types.pvsm")]
    yield None, [
        *delete(BOTH),
        new_part_choice("Gripper", "Parallel jaws"), new_part_length("FingerWidth", 8), new_part_length("FingerThickness", 5), START,
        *item(BROWSER, NEW_POSES), *files("actionFileSaveData", "FileSaveDialog", f"{folder}/poses.json"),
        event("WriterSettingsDialog/widget/OKButton", "activate"),
        *files("actionFileSaveServerState", "FileSaveServerStateDialog", f"{folder}/picks.pvsm")]


def main(paraview, pvpython, repository):
    with tempfile.TemporaryDirectory() as folder:
        subprocess.run([sys.executable, os.path.join(repository, "testing", "install", "scan.py"), "make", folder], check=True)
        wrong, events = wrong_point(folder), []
        for name, stage in stages(folder, repository, wrong):
            events += stage
            if name and os.environ.get("PPFMEAM_PICTURE"):
                shoot(paraview, folder, events, os.path.join(os.environ["PPFMEAM_PICTURE"], f"application_{name}.jpg"))
        play(paraview, folder, events)
        subprocess.run([pvpython, os.path.abspath(__file__), "--look", folder], check=True)


def look(folder):
    """The wrong pose is told to be one, two types are looked for, and the poses that are saved are those that picks are of."""
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
    names = output("MEAMPoseEstimation1", "types.pvsm").GetFieldData().GetAbstractArray("PartName")
    check([names.GetValue(k) for k in range(names.GetNumberOfValues())] == ["part", "part 2"], "the types that are looked for")
    picks = output("PickPlanning1", "picks.pvsm").GetPointData().GetArray("Instance")
    with open(os.path.join(folder, "poses.json")) as file:
        poses = json.load(file)["poses"]
    check(len(poses) == picks.GetRange()[1] >= 2, f"{len(poses)} poses are saved, picks are of {picks.GetRange()[1]}")


if sys.argv[1] == "--look":
    look(sys.argv[2])
else:
    main(*sys.argv[1:])
