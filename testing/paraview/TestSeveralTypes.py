# SPDX-License-Identifier: BSD-3-Clause
"""Two types of part in the application, by clicks: both CADs and a scan are opened, MEAM Pose Estimation of both, Pose Diagnosis of a
part of each type and of a place without one by Ctrl+P, and Pick Planning with the grasps of both. The states that are saved then
tell what is connected and which points were picked.

Usage: TestSeveralTypes.py PARAVIEW REPOSITORY
"""
import os
import sys
import tempfile
import xml.etree.ElementTree as ElementTree

import numpy
from vtkmodules.vtkCommonCore import reference
from vtkmodules.vtkCommonDataModel import vtkStaticCellLocator

import ppfmeam

from clicks import (APPLY, BROWSER, DIALOG, accept_inputs, check, choice, connect, event, files, filter_of_menu, item, number, play,
                    point_and_press, view)

PLACES = {"plate": (0.37, 0.66), "bracket": (0.667, 0.6), "floor": (0.65, 0.32)}  # in the picture
CUP = 8  # mm


def clicks(folder):
    for name in ("plate.stl", "bracket.stl", "scan.pcd"):
        yield from files("actionFileOpen", "FileOpenDialog", os.path.join(folder, name))
    yield APPLY
    for part in (0, 1):
        yield from item(BROWSER, part)
        yield from (*filter_of_menu("GraspDefinition"), choice("Propose", "Suction"), number("CupDiameter", CUP), APPLY)
    yield from item(BROWSER, 0)
    yield from item(BROWSER, 1, control=True)
    yield from (event("PoseEstimationToolbar/EstimatePoses", "activate"), APPLY)
    yield from item(BROWSER, 3)
    yield from (*filter_of_menu("PickPlanning"), *connect("Mesh", 0), *item(f"{DIALOG}/pipelineView", 1, control=True))
    yield from (*connect("Grasps", 0, 0, 0), *item(f"{DIALOG}/pipelineView", 1, 0, 0, control=True))
    yield from (*connect("Scan", 2), accept_inputs(), choice("Gripper", "Suction cup"), number("CupDiameter", CUP), choice("Bin", "None"), APPLY)
    yield event("PoseEstimationToolbar/AskWhy", "activate")
    for name, place in PLACES.items():
        yield from (*point_and_press(view(1), *place, "P", control=True), APPLY)
        yield from files("actionFileSaveServerState", "FileSaveServerStateDialog", f"{folder}/{name}.pvsm")


def inputs(path):
    """Of each filter in a state the names of what is connected, and the point of Pose Diagnosis."""
    state = ElementTree.parse(path).getroot()
    names = {item.get("id"): item.get("name") for item in state.iter("Item")}
    return {(proxy.get("type"), entry.get("name")): [names.get(other.get("value")) for other in entry.findall("Proxy")]
            or [element.get("value") for element in entry.iter("Element")]
            for proxy in state.iter("Proxy") for entry in proxy.findall("Property")}


def look(folder):
    """The order of the parts is that of the search, and the points are those of the drawn parts, which the answer is about."""
    state = inputs(f"{folder}/floor.pvsm")
    both = ["plate.stl", "bracket.stl"]
    for name, order in ((("MEAMPoseEstimation", "Input"), both), (("PoseDiagnosis", "Input"), both), (("PickPlanning", "Mesh"), both),
                        (("PickPlanning", "Grasps"), ["GraspDefinition1", "GraspDefinition2"])):
        check(state[name] == order, f"{name} gets {state[name]}")
    check(state["PoseDiagnosis", "Poses"] == ["MEAMPoseEstimation1"], "the poses that are drawn")
    found = ppfmeam.detect([os.path.join(folder, name) for name in both], os.path.join(folder, "scan.pcd"))
    for name in PLACES:
        point = [float(value) for value in inputs(f"{folder}/{name}.pvsm")["PoseDiagnosis", "Position"]]
        told = found.why(at=point)
        if name == "floor":
            check(told.lost_in or told.pose is None, f"{name}: {told}")
            continue
        check(told.rank and told.part == ("plate", "bracket").index(name), f"{name} at {point}: {told.part} {told}")
        locator, on = vtkStaticCellLocator(), numpy.linalg.solve(told.pose, [*point, 1.0])[:3]
        locator.SetDataSet(found.models[told.part].shape)
        locator.BuildLocator()
        nearest, squared = [0.0] * 3, reference(0.0)
        locator.FindClosestPoint(on, nearest, reference(0), reference(0), squared)
        check(squared < 1e-4, f"{name}: {point} is {squared.get() ** 0.5} mm from the part that is drawn")


paraview, repository = sys.argv[1:]
sys.path.append(os.path.join(repository, "testing", "filters"))
import twotypes  # noqa: E402: by the path of the repository

with tempfile.TemporaryDirectory() as folder:
    twotypes.write(folder)
    play(paraview, folder, list(clicks(folder)))
    look(folder)
