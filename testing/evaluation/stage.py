# SPDX-License-Identifier: BSD-3-Clause
"""Figure 13 of the paper: a part on a stage is moved and turned by known amounts, and what the poses say of each step is
compared with it, with the noise of the sensor."""
import math
import os

import numpy

from ppfmeam import filters, scripting
from ppfmeam.lines import Lines

import charts
import results
from scenes import bin_source, part_mesh

MOVES = (5, 10, 15, 20)  # mm
TURNS = (5, 10, 15, 20)  # degrees
TRIALS = 10
ABOUT = "xz"  # axes of the turns: the paper's stage has theta_x, across the sensor's view; z is along it
STEPS = [("mm", amount) for amount in MOVES] + [(f"degrees about {axis}", amount) for axis in ABOUT for amount in TURNS]
SCANS = 1 + len(STEPS)  # of a trial
TRIAL = ("part", "preset", "seed")
ROW = (*TRIAL, *(f"{amount} {unit}" for unit, amount in STEPS), "failure")  # errors; empty: no pose was found


def moved(transform, distance):
    """Along the stage's x axis, by mm."""
    step = numpy.eye(4)
    step[0, 3] = distance
    return step @ transform


def turned(transform, middle, degrees, axis="z"):
    """About an axis through the part's middle that is parallel to one of the sensor's."""
    angle, (i, j) = math.radians(degrees), {"x": (1, 2), "z": (0, 1)}[axis]
    turn = numpy.eye(4)
    turn[i, i] = turn[j, j] = math.cos(angle)
    turn[j, i] = math.sin(angle)
    turn[i, j] = -turn[j, i]
    turn[:3, 3] = middle - turn[:3, :3] @ middle
    return turn @ transform


class Stage:
    """A part alone below the sensor, and what finds it."""

    def __init__(self, part, preset, threads):
        self.mesh = part_mesh(part)
        self.middle = numpy.array(self.mesh.GetCenter())
        self.estimation = filters.vtkMEAMPoseEstimation()
        model = scripting.train(self.mesh, preset)
        self.estimation.SetInputDataObject(model)
        self.height = scripting.field(model, "Diameter") / 2  # above the floor, so that it can be turned about x
        scripting.set_preset(self.estimation, preset)
        self.estimation.SetMaximumNumberOfPoses(1)
        self.estimation.SetNumberOfThreads(threads)

    def lying(self, seed):
        """The pose of the part as it comes to rest, lifted by the stage."""
        source = scripting.update(bin_source(self.mesh, 1, seed))
        transform = scripting.column(source.GetOutputDataObject(1), "Transform", 4, 4)[0]
        transform[2, 3] -= self.height
        return transform

    def found(self, transform, seed):
        """The pose that is found of the part at a pose, seen with noise of its own; None where none is."""
        source = bin_source(self.mesh, 1, seed)
        source.SetInputDataObject(1, scripting.poses_of(transform[None]))
        self.estimation.SetInputDataObject(1, scripting.update(source).GetOutput())
        poses = scripting.column(scripting.update(self.estimation).GetOutput(), "Transform", 4, 4)
        return poses[0] if len(poses) else None


def errors(before, after, middle, distance=None, degrees=None):
    """Of a step the error of its length (mm) or of its turn (degrees)."""
    if distance is not None:
        step = (after[:3, :3] @ middle + after[:3, 3]) - (before[:3, :3] @ middle + before[:3, 3])
        return abs(float(numpy.linalg.norm(step)) - distance)
    turn = after[:3, :3] @ before[:3, :3].T
    return abs(math.degrees(math.acos(max(-1.0, min(1.0, (numpy.trace(turn) - 1) / 2)))) - degrees)


def trial(stage, seed):
    """The errors of a trial's steps, None where no pose was found."""
    start = stage.lying(seed)
    before = stage.found(start, seed)
    middle = start[:3, :3] @ stage.middle + start[:3, 3]
    result = []
    for number, (unit, amount) in enumerate(STEPS, 1):
        there = moved(start, amount) if unit == "mm" else turned(start, middle, amount, unit[-1])
        after = stage.found(there, seed + number)
        known = before is not None and after is not None
        result.append(errors(before, after, stage.middle, **{"distance" if unit == "mm" else "degrees": amount}) if known
                      else None)
    return result


def measure(folder, part, preset, threads, seeds):
    """The rows of the trials; DIR/figure13_trials.csv has one for each and is gone on with; those that failed are made again."""
    lines = Lines(os.path.join(folder, "figure13_trials.csv"), ROW, lambda row: not row["failure"])
    wanted = [(part, preset, str(seed)) for seed in seeds]
    done = {tuple(row[name] for name in TRIAL) for row in lines.rows}
    todo = [kind for kind in wanted if kind not in done]
    stage, progress = Stage(part, preset, threads) if todo else None, results.Progress(len(wanted), len(todo))
    for kind in todo:
        row = {**dict.fromkeys(ROW, ""), **dict(zip(TRIAL, kind))}
        try:
            of_steps = trial(stage, int(row["seed"]))
            row.update((name, "" if error is None else f"{error:.5f}") for name, error in zip(ROW[len(TRIAL):], of_steps))
        except scripting.Failure as failure:
            row["failure"] = str(failure)
            results.failed.append(kind)
        lines.add([row])
        outcome = "failed: " + row["failure"] if row["failure"] else "is done"
        progress.tell(f"Figure 13, the trial of seed {row['seed']} {outcome}")
    return [row for row in lines.rows if tuple(row[name] for name in TRIAL) in wanted]


def run(folder, part, preset, threads, first, trials=TRIALS):
    """The figure's text in Markdown, which is also written, as CSV and as charts where there is a display; and its rows."""
    trials_done = measure(folder, part, preset, threads, [first + trial * SCANS for trial in range(trials)])
    rows = []
    for unit, amount in STEPS:
        known = results.values(trials_done, f"{amount} {unit}")
        rows.append({"unit": unit, "step": amount, "found": len(known), "trials": trials,
                     "mean error": float(known.mean()) if known.size else None,
                     "largest": float(known.max()) if known.size else None})
    text = "\n\n".join([
        f"Figure 13. Relative errors of a {part} that is moved and turned by known amounts, trials: {trials}, preset {preset}.",
        results.markdown(("step", "found in", "mean error", "largest"), [
            (f"{row['step']} {row['unit']}", f"{row['found']} of {trials}",
             *(f"{row[name]:.3f} {row['unit'].split()[0]}" if row["found"] else "-"
                                                                              for name in ("mean error", "largest")))
                                                                              for row in rows]),
        "The paper turns its part about theta_x alone, and shows its errors in a chart without numbers.",
        *(f"The trial of seed {row['seed']} failed: {row['failure']}" for row in trials_done if row["failure"])]) + "\n"
    results.write(os.path.join(folder, "figure13.csv"), rows)
    with scripting.written(os.path.join(folder, "figure13.md")) as file:
        file.write(text)
    for unit in dict.fromkeys(unit for unit, _ in STEPS):
        of_unit = [row for row in rows if row["unit"] == unit]
        word = "moved" if unit == "mm" else "turned about " + unit[-1]
        charts.lines(os.path.join(folder, f"figure13_{word.replace(' ', '_')}.png"), f"The part {word} on a stage",
                     [row["step"] for row in of_unit],
                     {name: [row[name] for row in of_unit] for name in ("mean error", "largest")}, unit,
                     f"error, {unit.split()[0]}")
    return text, rows
