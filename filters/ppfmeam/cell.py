# SPDX-License-Identifier: BSD-3-Clause
"""A picking cell, simulated: parts fall into a bin, are scanned, found and picked one by one, the gripper among the true parts,
until none is left or none can be picked."""
import itertools
import os
import sys
import time

import numpy
from vtkmodules.vtkCommonDataModel import vtkPolyData
from vtkmodules.vtkIOXML import vtkXMLPolyDataWriter

from . import filters, scripting, simulation
from .batch.progress import duration
from .lines import Lines

MOST_FAILURES = 3  # one after the other: then the bin is given up
PROBABILITY = 0.5  # of a pose that is picked
GRASPS = 300  # all that differ: at a wall or among others few of a part's can be reached
TILT = 75  # degrees: parts lean steeply at the walls
SHARES = (0, 1)  # of the edge points that vote: the preset's, and when nothing can be picked all
SAME_PLACE = 5  # mm: a part so near to where a pick failed is taken last
BIN = ("part", "sensor", "gripper", "bin", "copies", "seed")
ROW = (*BIN, "pick", "left", "found", "possible", "outcome", "reason", "mm", "degrees", "detect_ms", "plan_ms")


def text(data, name, row):
    return data.GetPointData().GetAbstractArray(name).GetValue(row)


def bin_of(row):
    return tuple(str(row[name]) for name in BIN)


def is_last(row):
    """Whether nothing is picked after this."""
    return not row["outcome"] or (row["outcome"] == "success" and int(row["left"]) == 1)


class Station:
    """What a cell knows of a part before the first scan: its model, its grasps, its gripper. `gripper`: jaws or cup; `lengths`:
    the gripper's, mm, by the names that ppfmeam.grasps() has, of the part's diameter."""

    def __init__(self, name, mesh, sensor, gripper, lengths, threads):
        self.name, self.mesh, self.sensor, self.gripper = name, mesh, sensor, gripper
        self.model = scripting.train(mesh)
        lengths = lengths(scripting.field(self.model, "Diameter"))
        definition = filters.vtkMEAMGraspDefinition()
        definition.SetInputDataObject(mesh)
        definition.SetInputDataObject(1, self.model)
        scripting.set_choice(definition, "Propose", "Suction" if gripper == "cup" else "ParallelJaws")
        definition.SetMaximumNumberOfGrasps(GRASPS)
        self.planning = filters.vtkMEAMPickPlanning()
        for filter in (definition, self.planning):
            for length, value in lengths.items():
                getattr(filter, "Set" + simulation.camel(length))(value)
        self.grasps = vtkPolyData()
        self.grasps.ShallowCopy(scripting.update(definition).GetOutput())
        if self.grasps.GetNumberOfPoints() == 0:
            raise scripting.Failure(f"no grasp of {name} is found for this gripper: choose another opening, or a cup")
        self.estimation = filters.vtkMEAMPoseEstimation()
        self.estimation.SetInputDataObject(self.model)
        self.estimation.SetMaximumNumberOfPoses(0)
        self.estimation.SetMinimumProbability(PROBABILITY)
        self.estimation.SetNumberOfThreads(threads)
        self.planning.SetInputDataObject(1, mesh)
        self.planning.SetInputDataObject(2, self.grasps)
        scripting.set_choice(self.planning, "Gripper", "SuctionCup" if gripper == "cup" else "ParallelJaws")
        self.planning.SetMaximumTilt(TILT)
        self.planning.SetBinToGiven()
        self.evaluation = filters.vtkMEAMPoseEvaluation()
        self.evaluation.SetInputDataObject(2, self.model)
        self.trial = filters.vtkMEAMPickTrial()
        self.trial.SetInputDataObject(1, mesh)

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
    """Copies of the part, scanned again after each pick. `size`: length, width and height, mm, or None."""

    def __init__(self, station, copies, seed, size=None):
        self.source = filters.vtkMEAMBinSceneSource()
        self.source.SetInputDataObject(station.mesh)
        self.source.SetCopies(copies)
        if size:
            for name, value in zip(("BinSize", "BinWidth", "WallHeight"), size):
                getattr(self.source, "Set" + name)(value)
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
        """A copy (from 0) goes; the others come to rest and are scanned."""
        stay = numpy.delete(scripting.column(self.truth, "Transform", 4, 4), instance, axis=0)
        if not len(stay):
            self.truth = None
            return
        self.source.SetInputDataObject(1, scripting.poses_of(stay))
        self.source.SetSettle(True)
        self.scan_again()


class Film:
    """What happens in a bin, for ParaView: DIR/NAME.pvd with the true parts and the gripper, a time step for each pick."""

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
    """Where picks failed in a bin, and with which grasps."""

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


def picks_of(station, bin, film=None, strip=None):
    """Picks a bin empty; yields what is new in a row for each pick, the last one, without an outcome, of parts that cannot be
    picked."""
    in_a_row, failures = 0, Failures()
    station.set_bin(bin.truth)
    for number in itertools.count(1):
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
        row = {"pick": number, "left": bin.left, "found": found.GetNumberOfPoints(), "possible": len(possible),
               "detect_ms": f"{detect_ms:.0f}", "plan_ms": f"{plan_ms:.0f}"}
        if not possible or in_a_row >= MOST_FAILURES:
            failed = picks.GetNumberOfPoints() and scripting.column(picks, "Possible").any()
            yield {**row, "reason": "given up after failures" if failed
                   else "none of them is found" if not found.GetNumberOfPoints()
                   else picks.GetFieldData().GetAbstractArray("PickReport").GetValue(0)}
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
        if film or strip:
            station.planning.SetShownGrippers(station.planning.AllPossible)
            station.planning.SetWholeGripper(pick + 1)
            gripper = scripting.with_value(scripting.update(station.planning).GetOutputDataObject(1), "Rank", pick + 1,
                                           cells=True)
            station.planning.SetShownGrippers(station.planning.BestOfEachInstance)
            if film:
                film.add(bin.truth, gripper)
            if strip:
                strip.add(bin.scan, bin.truth, found, gripper, row)
        yield row
        if row["outcome"] == "success":
            in_a_row = 0
            bin.take(int(scripting.column(outcome, "TrueInstance")[0]) - 1)
            if not bin.left:
                return
        else:
            in_a_row += 1
            failures.add(scripting.column(found, "Transform", 4, 4)[instance - 1, :3, 3], text(picks, "GraspName", pick))
            bin.scan_again()


def can_draw():
    """Whether pictures can be made here; says why not."""
    from . import picture
    try:
        picture.require_display()
    except scripting.Failure as failure:
        print(f"no pictures are made: {failure}", file=sys.stderr)
        return False
    return True


class Cell:
    """The picks in DIR/picks.csv, a row for each as it comes. Bins that are done are not picked again, one that was interrupted
    starts anew. Of each bin DIR/NAME.pvd is a film and, where there is a display or Xvfb, DIR/NAME.png a strip of pictures."""

    def __init__(self, folder):
        scripting.make_folder(folder)
        path = os.path.join(folder, "picks.csv")
        done = {bin_of(row) for row in Lines(path, ROW).rows if is_last(row)} if os.path.exists(path) else set()
        self.folder, self.lines, self.done = folder, Lines(path, ROW, lambda row: bin_of(row) in done), done

    def rows(self, wanted):
        """Of these bins, those that were interrupted included."""
        return [row for row in self.lines.rows if bin_of(row) in wanted]

    def run(self, wanted, station_of, size=None):
        """Picks the bins empty that are not done. `wanted`: of each the values of BIN; `station_of` makes the station of one."""
        wanted, station, start = list(wanted), None, time.monotonic()
        todo = [each for each in wanted if each not in self.done]
        waiting = all_of_them = sum(int(copies) for *_, copies, _ in todo)
        pictures = bool(todo) and can_draw()
        for each in todo:
            if station is None or known != each[:3]:
                known, station = each[:3], station_of(*each[:3])
            copies, seed = map(int, each[-2:])
            waiting -= copies
            name = "_".join(each)
            film, strip = Film(self.folder, name, station), None
            if pictures:
                from .cellpicture import Strip
                strip = Strip(station)
            for row in picks_of(station, Bin(station, copies, seed, size), film, strip):
                row = {**dict.fromkeys(ROW, ""), **dict(zip(BIN, each)), **row}
                self.lines.add([row])
                left = 0 if is_last(row) else int(row["left"]) - (row["outcome"] == "success")
                gone = all_of_them - waiting - left
                rest = f"; {duration((time.monotonic() - start) / gone * (waiting + left))} left" if gone else ""
                print(f"{', '.join(known)}, bin {seed}: {row['left']} of {copies} left, pick {row['pick']}: "
                      f"{row['outcome'] or row['reason']}{rest}", file=sys.stderr, flush=True)
            if strip:
                strip.write(os.path.join(self.folder, name + ".png"))
            self.done.add(each)
        return self.rows(wanted)


def summary(rows):
    """How many bins are done, how many of them are empty, how many picks were tried, how many took a part, and how many parts
    are left in bins that are done."""
    tried = [row for row in rows if row["outcome"]]
    left = [row for row in rows if not row["outcome"]]
    done = sum(map(is_last, rows))
    taken = sum(row["outcome"] == "success" for row in tried)
    return done, done - len(left), len(tried), taken, sum(int(row["left"]) for row in left)
