#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""A picking cell in one file, to be copied and changed: scans come in, the best pick of each goes to the robot.

    cell.py part.meam part.stl part.grasps.json scan.pcd                                # prints the line of one scan
    cell.py part.meam part.stl part.grasps.json --watch scans --robot-frame robot.json  # those that arrive, for a robot
    cell.py part.meam part.stl part.grasps.json --replay cell.log                       # the same scans once more

The robot's program connects, sends NEXT, and gets a line of the newest scan, PICK ... or NONE ... (docs/robot.md). cell.cpp is
the same program with nothing under the GPL in it; the package ppfmeam holds CGAL, which is."""
import argparse
import os
import select
import socket
import sys
import time

import numpy
import ppfmeam
from vtkmodules.vtkCommonCore import vtkMath

# What to change for a cell of your own; mm.
GRIPPER = {"opening": 60, "finger_width": 8, "finger_thickness": 5}  # for a cup: {"cup_diameter": 20}, and KIND "cup"
KIND = "jaws"
BIN = "detected"    # found in each scan by its rim; "none"; or (T, length, width, height, wall), as ppfmeam.pick() takes it
PROBABILITY = 0.5   # that a copy is there: less likely ones are not picked
WAY_IN = 80.0       # straight to the grasp, free of everything
QUIET = 0.2         # seconds: a file is whole when nothing was written to it for so long
SCANS = (".pcd", ".ply", ".xyz", ".png", ".tif", ".tiff", ".pgm", ".pfm")  # images are depth images, with --camera


class Answer:
    """What the robot is told of a scan: a pick, or why there is none."""

    def __init__(self, scan, reason="", transform=None, numbers=(), part=()):
        self.scan, self.reason, self.transform, self.numbers, self.part = scan, reason, transform, numbers, part

    def line(self, T_base_gripper=numpy.eye(4)):
        if self.transform is None:
            return "NONE " + " ".join(self.reason.split())
        T = T_base_gripper @ self.transform
        quaternion = numpy.zeros(4)
        vtkMath.Matrix3x3ToQuaternion(T[:3, :3].tolist(), quaternion)
        w, x, y, z = quaternion if quaternion[0] >= 0 else -quaternion
        start = T[:3, 3] - WAY_IN * T[:3, 2]
        return " ".join(["PICK"] + [f"{value:.3f}" for value in T[:3, 3]] + [f"{value:.6f}" for value in (x, y, z, w)] +
                        [f"{value:.3f}" for value in (*start, *self.numbers)] + [str(number) for number in self.part])


class Cell:
    def __init__(self, options):
        self.options = options
        self.models, self.grasps = [], []
        for model, cad, grasps in ((options.model, options.cad, options.grasps), *options.beside):
            self.models.append(ppfmeam.load(model))
            self.grasps.append(ppfmeam.grasps(cad, file=grasps, symmetries=self.models[-1], **GRIPPER))
            ppfmeam.pick(numpy.zeros((0, 4, 4)), self.grasps[-1], bin="none", gripper=KIND,
                         robot_frame=options.robot_frame)  # what is wrong with these shows now

    def take(self, scan):
        """The answer to a scan; whatever is wrong with it is a reason."""
        try:
            found = ppfmeam.detect(self.models, scan, camera=self.options.camera, poses=0, probability=PROBABILITY,
                                   time_limit=self.options.time_limit)
            if not len(found):
                return Answer(scan, "no part was found")
            picks = ppfmeam.pick(found, self.grasps, scan, gripper=KIND, bin=BIN, robot_frame=self.options.robot_frame,
                                 camera=self.options.camera, way_in=WAY_IN)
            best = picks[0]
            if not best.possible:
                return Answer(scan, f"{picks.report} {picks.advice}")
            transforms = picks.transforms if picks.robot_transforms is None else picks.robot_transforms
            return Answer(scan, "", transforms[0], (best.width, best.clearance, found.probabilities[best.instance]),
                          (best.part + 1,) if len(self.models) > 1 else ())
        except Exception as error:  # the next scan is not to wait for it
            return Answer(scan, str(error))

    def note(self, kind, answer, line):
        """A line of the log: time, SCAN or SENT, the scan, what it was answered with. Of a scan --out has it, too."""
        try:
            if self.options.log:
                with open(self.options.log, "a", encoding="utf-8") as file:
                    file.write(f"{time.strftime('%Y-%m-%dT%H:%M:%SZ', time.gmtime())}\t{kind}\t{answer.scan}\t{line}\n")
            if self.options.out and kind == "SCAN":
                with open(self.options.out + ".part", "w", encoding="utf-8") as file:
                    file.write(line + "\n")
                os.replace(self.options.out + ".part", self.options.out)  # whole or not at all
        except OSError as error:
            print(f"cannot write {error.filename}: {error.strerror}", file=sys.stderr)
        print(kind, answer.scan, line, flush=True)


class Folder:
    """Scans that arrive. Those that lie there at the start are old: what was in the bin may have gone."""

    def __init__(self, path):
        self.path, self.files = path, {}  # of each its state, since when, and whether it was taken
        self.look(is_start=True)

    def look(self, is_start=False):
        """The scans that are whole and new, by when they were written."""
        now, whole = time.monotonic(), []
        for entry in os.scandir(self.path):
            if not entry.name.lower().endswith(SCANS):
                continue
            try:
                info = entry.stat()
            except FileNotFoundError:
                continue
            state, since, taken = self.files.get(entry.path, (None, 0, False))
            if state != (info.st_mtime_ns, info.st_size, info.st_ino):
                self.files[entry.path] = (info.st_mtime_ns, info.st_size, info.st_ino), now, is_start
            elif not taken and now - since >= QUIET:
                self.files[entry.path] = state, since, True
                whole.append((info.st_mtime_ns, entry.path))
        return [path for _, path in sorted(whole)]


class Robot:
    """The robot's program, at the other end of a connection: the one that came last."""

    def __init__(self, port):
        self.server, self.link, self.text, self.request = socket.create_server(("", port)), None, b"", None

    def connect(self, link):
        if self.link:
            self.link.close()
        self.link, self.text, self.request = link, b"", None

    def listen(self, seconds):
        """Waits at most so long for the next request."""
        ready = select.select([self.server] + ([self.link] if self.link else []), [], [], seconds)[0]
        if self.server in ready:
            self.connect(self.server.accept()[0])
        elif ready:
            try:
                data = self.link.recv(1024)
            except OSError:
                data = b""
            *lines, self.text = (self.text + data).split(b"\n")
            if not data or len(self.text) > 1024:  # it has gone, or is no robot
                self.connect(None)
            elif lines:
                self.request = lines[-1].decode(errors="replace").split()

    def send(self, line):
        """Whether it was sent; of one that was not the robot may ask again."""
        self.request = None
        try:
            self.link.sendall(line.encode() + b"\n")
            return True
        except OSError:
            self.connect(None)
            return False


def gripper_of(request):
    """T_base_gripper of NEXT x y z qx qy qz qw, mm: where the gripper was at the scan, of a camera on it; of NEXT none."""
    T, values = numpy.eye(4), numpy.array(request[1:], float)
    if request[:1] != ["NEXT"] or len(values) not in (0, 7) or not numpy.isfinite(values).all():
        raise ValueError
    if len(values):
        if not 0.99 < numpy.linalg.norm(values[3:]) < 1.01:
            raise ValueError
        turn = numpy.zeros((3, 3))
        vtkMath.QuaternionToMatrix3x3(values[[6, 3, 4, 5]] / numpy.linalg.norm(values[3:]), turn)
        T[:3, :3], T[:3, 3] = turn, values[:3]
    return T


def serve(cell, folder, robot):
    """Each scan is answered once; a newer one takes the place of one that nobody has asked for."""
    newest = None
    while True:
        for scan in folder.look():
            newest = cell.take(scan)
            cell.note("SCAN", newest, newest.line())
        robot.listen(0.02)
        if robot.request is not None:
            try:
                T_base_gripper = gripper_of(robot.request)
            except ValueError:
                robot.send("NONE the request has to be NEXT, or NEXT x y z qx qy qz qw, where the gripper was at the scan")
                continue
            if newest:
                line = newest.line(T_base_gripper)
                if robot.send(line):
                    cell.note("SENT", newest, line)
                    newest = None


def replay(cell, log):
    """Whether the scans of a log are answered as they were. There is no limit of time."""
    with open(log, encoding="utf-8") as file:
        rows = [line.rstrip("\n").split("\t") for line in file]
    differ, cell.options.time_limit = 0, 0.0
    for _, _, scan, line in (row for row in rows if len(row) == 4 and row[1] == "SCAN"):
        now = cell.take(scan).line()
        differ += now != line
        print(f"{scan}: the same" if now == line else f"{scan}: it was {line}\n{scan}: it is  {now}")
    return 1 if differ else 0


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("model", help="of `ppfmeam train`")
    parser.add_argument("cad", help="the part, mm")
    parser.add_argument("grasps", help="JSON")
    parser.add_argument("scans", nargs="*", help="scans that are there already")
    parser.add_argument("--beside", nargs=3, action="append", default=[], metavar=("MODEL", "CAD", "GRASPS"),
                        help="of another type of part in the same bin; each PICK then ends with the type, from 1")
    parser.add_argument("--watch", metavar="FOLDER", help="scans that arrive")
    parser.add_argument("--port", type=int, default=5050, help="that the robot connects to (default: %(default)s)")
    parser.add_argument("--robot-frame", metavar="FILE",
                        help="of `ppfmeam hand-eye` or ROS; without, picks are in the scan's frame")
    parser.add_argument("--time-limit", type=float, default=2.0, metavar="SECONDS",
                        help="of the search; the best that are found by then are used (default: %(default)s)")
    parser.add_argument("--camera", metavar="FILE", help="the calibration of the sensor, of depth images and points alone")
    parser.add_argument("--out", metavar="FILE", help="has the line of the newest scan")
    parser.add_argument("--log", metavar="FILE", help="gets a line for each scan and for each answer that was sent")
    parser.add_argument("--replay", metavar="LOG", help="takes the scans of a log once more")
    options = parser.parse_intermixed_args()
    if not options.scans and not options.watch and not options.replay:
        parser.error("give scans, --watch or --replay")
    if not options.time_limit >= 0 or not 0 <= options.port <= 65535:
        parser.error("--time-limit has to be 0 or more, --port a whole number up to 65535")
    cell = Cell(options)
    if options.replay:
        return replay(cell, options.replay)
    for scan in options.scans:
        answer = cell.take(scan)
        cell.note("SCAN", answer, answer.line())
    if options.watch:
        serve(cell, Folder(options.watch), Robot(options.port))
    return 0


if __name__ == "__main__":
    try:
        sys.exit(main())
    except (ppfmeam.Error, OSError) as error:
        sys.exit(f"cell.py: {error}")
    except KeyboardInterrupt:
        pass
