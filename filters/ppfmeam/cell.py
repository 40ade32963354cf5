# SPDX-License-Identifier: BSD-3-Clause
"""A picking cell, simulated (Section 6.4 of the paper): parts fall into a bin, are scanned, found and picked one by one,
the gripper among the true parts, until none is left or none can be picked."""
import os
import sys
import time

import numpy
from vtkmodules.vtkCommonDataModel import vtkPolyData
from vtkmodules.vtkIOXML import vtkXMLPolyDataWriter

from . import charts, filters, scripting, simulation, world

COPIES = 12  # in a bin, as in the paper
BINS = 5
MOST_FAILURES = 3  # one after the other: then the bin is given up
PROBABILITY = 0.5  # of a pose that is picked
GRASPS = 300  # all that differ: at a wall or among others few of a part's can be reached
TILT = 75  # degrees: parts lean steeply at the walls
SHARES = (0, 1)  # of the edge points that vote: the preset's, and when nothing can be picked all
SAME_PLACE = 5  # mm: a part so near to where a trial failed is taken last
BIN = ("part", "sensor", "gripper", "seed", "copies")
ROW = (*BIN, "trial", "left", "found", "possible", "outcome", "reason", "mm", "degrees", "detect_ms", "plan_ms")
HEAD = ("| part | sensor | gripper | bins | trials | success | failure | success rate | left in the bins | detection ms | planning ms |\n"
        "|---|---|---|---|---|---|---|---|---|---|---|")
PAPER = "| part A (the paper) | structured light | jaws | 5 | 63 | 60 | 3 | 95.2 % | 0 | 889 | - |"


def text(data, name, row):
    return data.GetPointData().GetAbstractArray(name).GetValue(row)


class Gripper:
    """Jaws or a cup, in lengths that suit a part, slim to reach in at walls: set on the filters that take them."""

    def __init__(self, kind, diameter):
        self.kind = kind
        size = diameter / 80
        self.lengths = dict(Opening=92 * size, JawClearance=2 * size, FingerWidth=6 * size, FingerThickness=4 * size,
                            FingerLength=60 * size, TipLength=5 * size, BodyLength=80 * size, BodyWidth=40 * size,
                            CupDiameter=8 * size, CupLength=70 * size)

    def set(self, algorithm):
        for name, value in self.lengths.items():
            getattr(algorithm, "Set" + name)(value)


class Station:
    """What a cell knows of a part before the first scan: its model, its grasps, its gripper."""

    def __init__(self, part, sensor, gripper, threads):
        self.part, self.sensor = part, sensor
        self.mesh = simulation.part_mesh(part)
        training = scripting.Training(self.mesh)
        self.model = training.model()
        self.diameter = scripting.field(self.model, "Diameter")
        self.gripper = Gripper(gripper, self.diameter)
        definition = filters.vtkMEAMGraspDefinition()
        definition.SetInputDataObject(self.mesh)
        definition.SetInputDataObject(1, self.model)
        scripting.set_choice(definition, "Propose", "Suction" if gripper == "cup" else "ParallelJaws")
        self.gripper.set(definition)
        definition.SetMaximumNumberOfGrasps(GRASPS)
        self.grasps = vtkPolyData()
        self.grasps.ShallowCopy(scripting.update(definition).GetOutput())
        if self.grasps.GetNumberOfPoints() == 0:
            raise scripting.Failure(f"no grasp of {part} is found for this gripper")
        self.estimation = filters.vtkMEAMPoseEstimation()
        self.estimation.SetInputDataObject(self.model)
        self.estimation.SetMaximumNumberOfPoses(0)
        self.estimation.SetMinimumProbability(PROBABILITY)
        self.estimation.SetPartIsPresent(True)  # a cell knows how many were thrown in
        self.estimation.SetNumberOfThreads(threads)
        self.planning = filters.vtkMEAMPickPlanning()
        self.planning.SetInputDataObject(1, self.mesh)
        self.planning.SetInputDataObject(2, self.grasps)
        scripting.set_choice(self.planning, "Gripper", "SuctionCup" if gripper == "cup" else "ParallelJaws")
        self.gripper.set(self.planning)
        self.planning.SetMaximumTilt(TILT)
        self.planning.SetBinToGiven()
        self.evaluation = filters.vtkMEAMPoseEvaluation()
        self.evaluation.SetInputDataObject(2, self.model)
        self.trial = filters.vtkMEAMPickTrial()
        self.trial.SetInputDataObject(1, self.mesh)

    def set_bin(self, truth):
        """A cell knows its bin."""
        values = scripting.tuples(truth, "Bin")[0]
        self.planning.SetBinPosition(values[3], values[7], values[11])
        self.planning.SetBinSize(values[16:19])
        self.planning.SetBinWall(values[19])

    def find(self, scan, share):
        self.estimation.SetReferenceShare(share)
        self.estimation.SetInputDataObject(1, scan)
        return scripting.update(self.estimation).GetOutput()

    def plan(self, found, scan):
        self.planning.SetInputDataObject(0, found)
        self.planning.SetInputDataObject(3, scan)
        return scripting.update(self.planning).GetOutput()


class Bin:
    """Copies of the part, scanned again after each pick."""

    def __init__(self, station, copies, seed):
        self.source = filters.vtkMEAMBinSceneSource()
        self.source.SetInputDataObject(station.mesh)
        self.source.SetCopies(copies)
        simulation.set_sensor(self.source, station.sensor)
        self.seed, self.scans = seed, 0
        self.scan_again()
        self.source.SetBinSize(scripting.field(self.scan, "BinSize"))

    def scan_again(self):
        self.source.SetSeed(1000 * self.seed + self.scans)
        self.scans += 1
        scripting.update(self.source)
        self.scan, self.truth = (self.source.GetOutputDataObject(port).NewInstance() for port in (0, 1))
        self.scan.ShallowCopy(self.source.GetOutputDataObject(0))
        self.truth.ShallowCopy(self.source.GetOutputDataObject(1))

    @property
    def left(self):
        return self.truth.GetNumberOfPoints() if self.truth else 0

    def take(self, instance):
        """A copy (from 0) goes; the others come to rest and are scanned. Whether any is left."""
        stay = numpy.delete(scripting.column(self.truth, "Transform", 4, 4), instance, axis=0)
        if not len(stay):
            self.truth = None
            return False
        self.source.SetInputDataObject(1, scripting.poses_of(stay))
        self.source.SetSettle(True)
        self.scan_again()
        return True


class Film:
    """What happens in a bin, for ParaView: DIR/NAME.pvd with the true parts, the parts found and the gripper, a time step for
    each trial."""

    def __init__(self, folder, name, station):
        self.folder, self.name, self.station, self.entries = folder, name, station, []
        scripting.make_folder(os.path.join(folder, name))

    def add(self, truth, gripper):
        instances = filters.vtkMEAMPoseInstances()
        instances.SetInputDataObject(truth)
        instances.SetInputDataObject(1, self.station.mesh)
        step = len(self.entries) // 2
        for part, (kind, data) in enumerate((("parts", scripting.update(instances).GetOutput()), ("gripper", gripper))):
            path = os.path.join(self.name, f"{kind}_{step:03}.vtp")
            writer = vtkXMLPolyDataWriter()
            writer.SetInputData(data)
            writer.SetDataModeToBinary()
            scripting.write_by(writer, os.path.join(self.folder, path))
            self.entries.append(f'    <DataSet timestep="{step}" part="{part}" name="{kind}" file="{path}"/>')
        with scripting.written(os.path.join(self.folder, self.name + ".pvd")) as file:
            file.write("\n".join(['<?xml version="1.0"?>', '<VTKFile type="Collection" version="0.1">', "  <Collection>",
                                  *self.entries, "  </Collection>", "</VTKFile>", ""]))


class Failures:
    """Where trials failed in a bin, and with which grasps."""

    def __init__(self):
        self.places = []

    def add(self, place, grasp):
        self.places.append((place, grasp))

    def order(self, picks, found):
        """The possible picks in the order in which they are tried: none again, and parts where one failed last."""
        if not picks.GetNumberOfPoints():
            return []
        places = scripting.column(found, "Transform", 4, 4)[scripting.column(picks, "Instance") - 1, :3, 3]
        here = {row: [grasp for place, grasp in self.places if numpy.linalg.norm(place - places[row]) < SAME_PLACE]
                for row in numpy.flatnonzero(scripting.column(picks, "Possible"))}
        return sorted((row for row, failed in here.items() if text(picks, "GraspName", row) not in failed),
                      key=lambda row: len(here[row]))


def trials(station, copies, seed, film=None, pictures=None):
    """Picks a bin empty; yields a row for each trial, the last one, without an outcome, of parts that cannot be picked."""
    bin, in_a_row, failures = Bin(station, copies, seed), 0, Failures()
    number = 0
    station.set_bin(bin.truth)
    while bin.left:
        detect_ms = plan_ms = 0.0
        for share in SHARES:
            start = time.perf_counter()
            found = station.find(bin.scan, share)
            detected = time.perf_counter()
            picks = station.plan(found, bin.scan)
            detect_ms += 1000 * (detected - start)
            plan_ms += 1000 * (time.perf_counter() - detected)
            possible = failures.order(picks, found)
            if possible:
                break
        number += 1
        row = {**dict.fromkeys(ROW, ""), "part": station.part, "sensor": station.sensor, "gripper": station.gripper.kind,
               "seed": seed, "copies": copies, "trial": number, "left": bin.left, "found": found.GetNumberOfPoints(), "possible": len(possible),
               "detect_ms": f"{detect_ms:.0f}", "plan_ms": f"{plan_ms:.0f}"}
        if not possible or in_a_row >= MOST_FAILURES:
            failed = picks.GetNumberOfPoints() and scripting.column(picks, "Possible").any()
            reason = ("given up after failures" if failed else "none of them is found" if not found.GetNumberOfPoints()
                      else picks.GetFieldData().GetAbstractArray("PickReport").GetValue(0))
            yield {**row, "reason": reason}
            return
        pick = possible[0]
        station.trial.SetInputDataObject(0, scripting.with_value(picks, "Rank", pick + 1))
        station.trial.SetInputDataObject(2, bin.truth)
        outcome = scripting.update(station.trial).GetOutput()
        instance = int(scripting.column(picks, "Instance")[pick])
        station.evaluation.SetInputDataObject(0, found)
        station.evaluation.SetInputDataObject(1, bin.truth)
        judged = scripting.update(station.evaluation).GetOutput()
        off = [judged.GetColumnByName(name).GetValue(instance - 1) for name in ("TranslationError", "RotationError")]
        row.update(outcome=text(outcome, "OutcomeName", 0), mm=f"{off[0]:.2f}", degrees=f"{off[1]:.1f}",
                   reason=f"{text(picks, 'GraspName', pick)}, clearance {scripting.column(picks, 'Clearance')[pick]:.1f} mm")
        if film or pictures:
            station.planning.SetShownGrippers(station.planning.AllPossible)
            gripper = scripting.with_value(scripting.update(station.planning).GetOutputDataObject(1), "Rank", pick + 1, cells=True)
            station.planning.SetShownGrippers(station.planning.BestOfEachInstance)
            if film:
                film.add(bin.truth, gripper)
            if pictures:
                pictures(bin.scan, bin.truth, found, gripper, row)
        yield row
        if row["outcome"] == "success":
            in_a_row = 0
            bin.take(int(scripting.column(outcome, "TrueInstance")[0]) - 1)
        else:
            in_a_row += 1
            failures.add(scripting.column(found, "Transform", 4, 4)[instance - 1, :3, 3], text(picks, "GraspName", pick))
            bin.scan_again()


def bin_of(row):
    return tuple(str(row[name]) for name in BIN)


def table(rows):
    """Table 9 in Markdown, and each failure with its reason."""
    lines, failures = [HEAD, PAPER], []
    for kind in dict.fromkeys((row["part"], row["sensor"], row["gripper"]) for row in rows):
        of_kind = [row for row in rows if (row["part"], row["sensor"], row["gripper"]) == kind]
        tried = [row for row in of_kind if row["outcome"]]
        right = sum(row["outcome"] == "success" for row in tried)
        left = [row for row in of_kind if not row["outcome"]]
        rate = f"{100 * right / len(tried):.1f} %" if tried else "-"
        detect, plan = (numpy.median([float(row[name]) for row in of_kind]) for name in ("detect_ms", "plan_ms"))
        cells = (*kind, len(set(map(bin_of, of_kind))), len(tried), right, len(tried) - right, rate,
                 sum(int(row["left"]) for row in left), f"{detect:.0f}", f"{plan:.0f}")
        lines.append("| " + " | ".join(map(str, cells)) + " |")
        failures += [f"- {row['part']}, {row['sensor']}, bin {row['seed']}, trial {row['trial']}: "
                     + (f"{row['outcome']} ({row['reason']}; the pose is {row['mm']} mm and {row['degrees']} degrees off)"
                        if row["outcome"] else f"{row['left']} left: {row['reason']}")
                     for row in of_kind if row["outcome"] != "success"]
    return "\n".join(lines) + "\n" + ("\nFailures, and bins that were left:\n\n" + "\n".join(failures) + "\n" if failures else "")


def chart(folder, rows):
    """Of Table 9 a bar chart, where there is a display."""
    kinds = list(dict.fromkeys((row["part"], row["sensor"], row["gripper"]) for row in rows))
    success, picked = [95.2], [100.0]  # the paper's
    for kind in kinds:
        of_kind = [row for row in rows if (row["part"], row["sensor"], row["gripper"]) == kind]
        right, tried = sum(row["outcome"] == "success" for row in of_kind), sum(row["outcome"] != "" for row in of_kind)
        left = sum(int(row["left"]) for row in of_kind if not row["outcome"])
        success.append(100 * right / tried if tried else numpy.nan)
        picked.append(100 * right / (right + left) if right + left else numpy.nan)
    charts.bars(os.path.join(folder, "table9.png"), "Table 9. Pickup success rate", ["the paper", *map(", ".join, kinds)],
                {"trials with success": success, "parts picked": picked}, "%")


def run(folder, parts, sensors, gripper, bins, copies, first, threads, show=False):
    """Table 9 in Markdown; DIR/cell.csv has a row for each trial and is gone on with, DIR/table9.md is the table, with
    a display DIR/table9.png a chart of it, DIR/NAME.pvd the film of each bin and, when it is shown, DIR/NAME.png a strip of pictures. A bin that was interrupted starts anew."""
    scripting.make_folder(folder)
    whole = world.Lines(os.path.join(folder, "bins.csv"), BIN)
    done = set(map(bin_of, whole.rows))
    record = world.Lines(os.path.join(folder, "cell.csv"), ROW, lambda row: bin_of(row) in done)
    wanted = [(part, sensor, gripper, str(seed), str(copies)) for part in parts for sensor in sensors for seed in range(first, first + bins)]
    todo = [each for each in wanted if each not in done]
    station, start = None, time.time()
    for count, (part, sensor, _, seed, _) in enumerate(todo):
        if station is None or (station.part, station.sensor) != (part, sensor):
            station = Station(part, sensor, gripper, threads)
        name = f"{part}_{sensor}_{gripper}_{copies}_{seed}"
        film = Film(folder, name, station)
        strip = None
        if show:
            from .cellpicture import Strip
            strip = Strip(station)
        rows = []
        for row in trials(station, copies, int(seed), film, strip.add if strip else None):
            rows.append(row)
            print(f"{part}, {sensor}, bin {seed}: {row['left']} left, trial {row['trial']}: {row['outcome'] or row['reason']}",
                  file=sys.stderr, flush=True)
        if strip:
            strip.write(os.path.join(folder, name + ".png"))
        record.add(rows)
        whole.add([dict(zip(BIN, (part, sensor, gripper, seed, copies)))])
        left = (time.time() - start) / (count + 1) * (len(todo) - count - 1)
        print(f"bin {len(wanted) - len(todo) + count + 1} of {len(wanted)} is done; {left / 60:.0f} min left", file=sys.stderr, flush=True)
    rows = [row for row in record.rows if bin_of(row) in set(wanted)]
    text = "Table 9. Pickup success rate: a simulated cell with " + str(copies) + " parts in a bin.\n\n" + table(rows)
    chart(folder, rows)
    with scripting.written(os.path.join(folder, "table9.md")) as file:
        file.write(text)
    return text
