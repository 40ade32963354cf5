# SPDX-License-Identifier: BSD-3-Clause
"""A disk that is full: every script that writes says so in a sentence and leaves whole files alone behind. The disk is one
that takes no file beyond so many bytes."""
import os
import resource
import subprocess
import sys
import tempfile

import numpy

from ppfmeam import Error, bop, scripting, simulation
from ppfmeam.lines import Lines
from meamtest import check
import scenes

EXAMPLES = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", "examples")
PLATE = os.path.join(EXAMPLES, "parts", "hole_plate.stl")
FULL = 2000  # bytes


def small(size):
    resource.setrlimit(resource.RLIMIT_FSIZE, (size, resource.RLIM_INFINITY))


class small_disk:
    """In it files grow no further than so many bytes."""

    def __init__(self, size):
        self.size = size

    def __enter__(self):
        small(self.size)

    def __exit__(self, *_):
        small(resource.RLIM_INFINITY)


def left(folder):
    return sorted(os.path.relpath(os.path.join(place, name), folder) for place, _, names in os.walk(folder) for name in names)


def refused(path, work, size=FULL):
    """The work ends with a sentence that names the file."""
    try:
        with small_disk(size):
            work()
    except Error as error:
        text = str(error)
        check(os.path.basename(path) in text and "cannot" in text and "File too large" in text and "\n" not in text, text)
    else:
        check(False, f"{path} was written on a full disk")


def scripts_say_so():
    for name, *arguments in (("train.py", "--cad", PLATE, "--out", "plate.vtpc"),
                             ("train.py", "--cad", PLATE, "--out", "plate.meam"),
                             ("simulate.py", "--cad", PLATE, "--copies", "1", "--out", "bins")):
        result = subprocess.run([sys.executable, os.path.join(EXAMPLES, name), *arguments], capture_output=True, text=True,
                                preexec_fn=lambda: small(FULL))
        check(result.returncode == 1 and result.stderr.startswith(name + ": ") and result.stderr.count("\n") == 1
              and "File too large" in result.stderr, f"{name} {arguments}: {result.returncode}, {result.stderr}")
        check(left(".") == [], f"{name} {arguments} leaves {left('.')}")


def writers_say_so():
    """Those of datasets, scans, pictures and tables."""
    mesh = scripting.read_mesh(PLATE)
    pixels = numpy.random.default_rng(1).integers(0, 255, (90, 120)).astype("uint8")
    refused("a.png", lambda: bop.write_png("images/a.png", pixels))
    refused("obj_000001.ply", lambda: bop.write_part(".", mesh, "{}"))
    bins = scenes.Bins("bins")
    refused("hole_plate", lambda: bins.scene("hole_plate", simulation.SENSORS[2], 1, 1))
    poses = scripting.poses_of(numpy.tile(numpy.eye(4), (500, 1, 1)))
    for form in ("BOPCSV", "JSON", "Matrices"):
        refused("poses", lambda: scripting.write_poses(poses, "poses", form))
    refused("a.json", lambda: bop.write_json("a.json", {str(k): k for k in range(1000)}))
    check(left(".") == [], f"left behind: {left('.')}")
    bop.write_png("images/a.png", pixels)
    bop.write_part(".", mesh, "{}")
    bins.scene("hole_plate", simulation.SENSORS[2], 1, 2)
    check(len(left(".")) == 5, f"with room: {left('.')}")
    check((bop.pixels_of(scripting.read_image("images/a.png")) == pixels).all(), "another image")
    check(scripting.read_mesh("models/obj_000001.ply").GetNumberOfCells() == mesh.GetNumberOfCells(), "another mesh")
    check(bins.read("hole_plate_time-of-flight_1_2")[0].GetNumberOfPoints() > 0, "no scan")


def a_table_that_grows_is_gone_on_with():
    lines = Lines("grows.csv", ("a", "b"))
    lines.add([{"a": k, "b": "x" * 10} for k in range(10)])
    refused("grows.csv", lambda: lines.add([{"a": 10 + k, "b": "x" * 10} for k in range(100)]), 500)
    again = Lines("grows.csv", ("a", "b"))
    check(10 <= len(again.rows) < 110 and all(row == {"a": str(k), "b": "x" * 10} for k, row in enumerate(again.rows)),
          f"{len(again.rows)} rows, the last {again.rows[-1]}")


def a_device_stays_one():
    """It must not be renamed over."""
    os.mkfifo("pipe")
    reader = os.open("pipe", os.O_RDONLY | os.O_NONBLOCK)
    bop.write_json("pipe", {"a": 1})
    check(os.read(reader, 100).decode() == '{\n  "a": 1\n}\n', "the pipe does not get the text")
    check(left(".").count("pipe") == 1 and not os.path.isfile("pipe"), "the pipe is gone")
    try:
        bop.write_json("/dev/full", {"a": 1})
        check(False, "written to a full disk")
    except Error as error:
        check(str(error) == "cannot write /dev/full: No space left on device", str(error))
    check(not os.path.isfile("/dev/full"), "the device is gone")


for test in (scripts_say_so, writers_say_so, a_table_that_grows_is_gone_on_with, a_device_stays_one):
    with tempfile.TemporaryDirectory() as folder:
        os.chdir(folder)
        test()
        os.chdir("/")
