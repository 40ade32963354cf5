# SPDX-License-Identifier: BSD-3-Clause
"""Figure 13 of the paper: a part on a stage is moved and turned by known amounts, and what the poses say of each step is
compared with it, with the noise of the sensor."""
import math
import os

import numpy
from vtkmodules.util.numpy_support import vtk_to_numpy

from . import charts, filters, scripting, simulation

MOVES = (5, 10, 15, 20)  # mm
TURNS = (5, 10, 15, 20)  # degrees
TRIALS = 10
SCANS = 1 + len(MOVES) + len(TURNS)  # of a trial


def moved(transform, distance):
    """Along the stage's x axis, by mm."""
    step = numpy.eye(4)
    step[0, 3] = distance
    return step @ transform


def turned(transform, middle, degrees):
    """About the stage's axis, the sensor's z, through the part's middle."""
    angle = math.radians(degrees)
    turn = numpy.eye(4)
    turn[:2, :2] = (math.cos(angle), -math.sin(angle)), (math.sin(angle), math.cos(angle))
    turn[:3, 3] = middle - turn[:3, :3] @ middle
    return turn @ transform


class Stage:
    """A part alone below the sensor, and what finds it."""

    def __init__(self, part, preset, threads):
        self.mesh = simulation.part_mesh(part)
        self.middle = numpy.array(self.mesh.GetCenter())
        self.estimation = filters.vtkMEAMPoseEstimation()
        self.estimation.SetInputDataObject(scripting.train(self.mesh, preset))
        scripting.set_preset(self.estimation, preset)
        self.estimation.SetMaximumNumberOfPoses(1)
        self.estimation.SetNumberOfThreads(threads)

    def source(self, seed):
        source = filters.vtkMEAMBinSceneSource()
        source.SetInputDataObject(self.mesh)
        source.SetCopies(1)
        source.SetSeed(seed)
        return source

    def lying(self, seed):
        """The pose of the part as it comes to rest."""
        source = self.source(seed)
        scripting.update(source)
        return vtk_to_numpy(source.GetOutputDataObject(1).GetPointData().GetArray("Transform")).reshape(4, 4)

    def found(self, transform, seed):
        """The pose that is found of the part at a pose, seen with noise of its own; None where none is."""
        source = self.source(seed)
        source.SetInputDataObject(1, scripting.poses_of(transform[None]))
        self.estimation.SetInputDataObject(1, scripting.update(source).GetOutput())
        array = scripting.update(self.estimation).GetOutput().GetPointData().GetArray("Transform")
        return vtk_to_numpy(array).reshape(-1, 4, 4)[0] if array and array.GetNumberOfTuples() else None


def errors(before, after, middle, distance=None, degrees=None):
    """Of a step the error of its length (mm) or of its turn (degrees)."""
    if distance is not None:
        step = (after[:3, :3] @ middle + after[:3, 3]) - (before[:3, :3] @ middle + before[:3, 3])
        return abs(float(numpy.linalg.norm(step)) - distance)
    turn = after[:3, :3] @ before[:3, :3].T
    return abs(math.degrees(math.acos(max(-1.0, min(1.0, (numpy.trace(turn) - 1) / 2)))) - degrees)


def run(folder, part, preset, threads, first, trials=TRIALS):
    """The table in Markdown, which is also written, as CSV and as charts where there is a display."""
    stage = Stage(part, preset, threads)
    steps = [("mm", distance) for distance in MOVES] + [("degrees", degrees) for degrees in TURNS]
    measured = {step: [] for step in steps}
    for trial in range(trials):
        seed = first + trial * SCANS
        start = stage.lying(seed)
        before = stage.found(start, seed)
        middle = start[:3, :3] @ stage.middle + start[:3, 3]
        for number, (unit, amount) in enumerate(steps, 1):
            there = moved(start, amount) if unit == "mm" else turned(start, middle, amount)
            after = stage.found(there, seed + number)
            if before is not None and after is not None:
                asked = {"distance" if unit == "mm" else "degrees": amount}
                measured[unit, amount].append(errors(before, after, stage.middle, **asked))
    lines = [f"Figure 13. Relative errors of a {part} that is moved and turned by known amounts, {trials} trial{'s' if trials > 1 else ''}, preset {preset}.", "",
             "| step | found in | mean error | largest |", "|---|---|---|---|"]
    rows = ["unit,step,found,mean,largest"]
    for unit, amount in steps:
        of_step = measured[unit, amount] or [math.nan]
        found, mean, largest = len(measured[unit, amount]), numpy.mean(of_step), max(of_step)
        lines.append(f"| {amount} {unit} | {found} of {trials} | {mean:.3f} {unit} | {largest:.3f} {unit} |")
        rows.append(f"{unit},{amount},{found},{mean:.5f},{largest:.5f}")
    text = "\n".join(lines) + "\n"
    for name, content in (("figure13.md", text), ("figure13.csv", "\n".join(rows) + "\n")):
        with scripting.written(os.path.join(folder, name)) as file:
            file.write(content)
    for unit, amounts, word in (("mm", MOVES, "moved"), ("degrees", TURNS, "turned")):
        charts.lines(os.path.join(folder, f"figure13_{word}.png"), f"The part {word} on a stage", amounts,
                     {"mean error": [numpy.mean(measured[unit, amount] or [math.nan]) for amount in amounts],
                      "largest error": [max(measured[unit, amount] or [math.nan]) for amount in amounts]}, unit, f"error, {unit}")
    return text
