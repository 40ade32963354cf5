# SPDX-License-Identifier: BSD-3-Clause
"""What the tests of many scans share: small bins as a dataset, runs that are killed. Not a test."""
import glob
import os
import signal
import subprocess
import sys
import time

from ppfmeam import bop, filters, scripting
from meamtest import check, connect, plate, rows_of

BATCH = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", "examples", "batch.py")
W, H = 320, 240


def dataset(folder, scenes, width=W, height=H, copies=3):
    """Writes bins of plates, one in each scene. Returns the trained model and the last scan."""
    mesh = scripting.prepare_mesh(plate())
    training = scripting.Training(mesh)
    source = connect(filters.vtkMEAMBinSceneSource(), mesh, Copies=copies, Width=width, Height=height)
    os.makedirs(folder)
    for scene in range(scenes):
        source.SetSeed(scene + 1)
        scripting.update(source)
        scan, truth, part, image = (source.GetOutputDataObject(port) for port in range(4))
        bop.write_scene(folder, scene, scan, truth, image)
    bop.write_part(folder, part, training.symmetric_samples().GetFieldData().GetAbstractArray("ModelsInfo").GetValue(0))
    bop.write_camera(folder, scan, image)
    return training.model(), scan


def content(path):
    with open(path, "rb") as file:
        return file.read()


def children(process):
    """The processes that a process has started."""
    with open(f"/proc/{process}/task/{process}/children", encoding="ascii") as file:
        return [int(word) for word in file.read().split()]


def killed(out, victim, *command):
    """Starts a run and kills the process that victim(its number) names once a scan is done: kill -9."""
    process = subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    while not any(b'"rows"' in content(path) for path in glob.glob(f"{out}.run/*.jsonl")):
        check(process.poll() is None, f"the run has ended before a scan was done: {process.returncode}")
        time.sleep(0.01)
    os.kill(victim(process.pid), signal.SIGKILL)
    process.wait()
    check(process.returncode != 0 and not os.path.exists(out), f"a killed run has written {out}")
    check(os.path.isdir(f"{out}.run"), "a killed run leaves what is done")


def finished(*command):
    """Runs to the end. Returns the output."""
    done = subprocess.run(command, capture_output=True, text=True)
    check(done.returncode == 0, f"{command}: {done.returncode}, {done.stderr}")
    return done.stdout


# A run in which a scan ends the process that reads it, or keeps it for ever.
DEADLY = """
import os, signal, sys, time
from ppfmeam import scripting
from ppfmeam.batch import scans
from ppfmeam.commands import batch

def deadly(read):
    def deadly_read(self, name, *rest):
        if name in ("000002/000000", "deadly.pcd"):
            WHAT
        return read(self, name, *rest)
    return deadly_read

for kind in (scans.BOP, scans.Files):
    kind.read = deadly(kind.read)
sys.argv[0] = "batch.py"
scripting.run(batch.main)
"""


def deadly(*arguments, what="os.kill(os.getpid(), signal.SIGSEGV)"):
    """The command of a run that the scan 000002/000000, or deadly.pcd, crashes, or does something else to."""
    with open("deadly.py", "w", encoding="utf-8") as file:
        file.write(DEADLY.replace("WHAT", what))
    return (sys.executable, "deadly.py", *arguments)


def survives(out, *command):
    """A run that crashes goes on when it is started again, and the scan that has crashed it is a row."""
    first = subprocess.run(command, capture_output=True, text=True)
    check(first.returncode != 0 and not os.path.exists(out), f"nothing has crashed: {first.returncode}, {first.stderr}")
    finished(*command)
    failures = {row["scan"]: row["failure"] for row in rows_of(out) if row["failure"]}
    check(failures.get("000002/000000") == "it ended the process that searched it: SIGSEGV", f"{failures}")


def command(*arguments):
    return (sys.executable, BATCH, *arguments)
