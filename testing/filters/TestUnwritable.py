# SPDX-License-Identifier: BSD-3-Clause
"""A folder that nobody may write to: every sub-command and program that writes says so in a sentence and leaves nothing behind."""
import json
import os
import shutil
import subprocess
import sys

from ppfmeam import scripting
from ppfmeam.commands import SUMMARIES
from batchtest import H, W, dataset
from meamtest import check, skip, write
from scripttest import EVALUATION, write_pcd
from vtkmodules.util.numpy_support import vtk_to_numpy

PLATE = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", "examples", "parts", "hole_plate.stl")
# Root writes to any folder, unless it has put down the right to.
AS_OTHERS = ()
if os.geteuid() == 0:
    AS_OTHERS = ("setpriv", "--bounding-set=-dac_override,-dac_read_search,-fowner", "--")
    if not shutil.which("setpriv") or subprocess.run([*AS_OTHERS, "true"], stderr=subprocess.DEVNULL).returncode:
        skip("root cannot put down its right to write to any folder here")


def content(folder):
    return sorted(os.path.join(place, name) for place, folders, files in os.walk(folder) for name in folders + files)


def refuses(*arguments):
    """Status 1, one sentence that names the folder or the file in it, nothing in the folder or beside it."""
    before = content(".")
    installed = arguments[0] in SUMMARIES
    program = ("-m", "ppfmeam", *arguments) if installed else (os.path.join(EVALUATION, arguments[0]), *arguments[1:])
    result = subprocess.run([*AS_OTHERS, sys.executable, *program], capture_output=True, text=True)
    what = f"{' '.join(arguments)}: status {result.returncode}, {result.stderr}"
    check(result.returncode == 1 and result.stderr.count("\n") == 1, what)
    check(result.stderr.startswith(f"{'ppfmeam ' if installed else ''}{arguments[0]}: cannot write protected"), what)
    check(content(".") == before, f"left behind: {set(content('.')) - set(before)} by {what}")


os.makedirs("protected")
os.makedirs("protected/scans")
model, scan = dataset("bins", 1)
scripting.write_model(model, "plate.meam")
for path in ("scan.pcd", "protected/scans/scan.pcd"):
    write_pcd(path, vtk_to_numpy(scan.GetPoints().GetData()), W, H, "x y z")
axes = ([1, 0, 0], [0, 1, 0], [0, 0, 1])
turns = [[axes[k], axes[(k + 1) % 3], axes[(k + 2) % 3]] for k in range(3)]
poses = [[[*row, 10.0 * k + i] for i, row in enumerate(turn)] + [[0, 0, 0, 1]] for k, turn in enumerate(turns)]
write("pairs.json", json.dumps({"pairs": [{"T_base_gripper": pose, "T_camera_target": pose} for pose in poses]}))
os.chmod("protected/scans", 0o555)
os.chmod("protected", 0o555)

detect = ("detect", "--model", "plate.meam", "--scene", "scan.pcd")
for command in (("train", "--cad", PLATE, "--out", "protected/plate.meam"),
                ("train", "--cad", PLATE, "--out", "protected/plate.vtpc"),
                ("train", "--cad", PLATE, "--out", "plate.meam", "--models-info", "protected/info.json"),
                (*detect, "--out", "protected/poses.csv"),
                (*detect, "--matrices", "protected/poses.txt"),
                ("batch", "bins", "--model", "plate.meam", "--out", "protected/poses.csv"),
                ("batch", "--watch", "protected/scans", "--model", "plate.meam"),
                ("simulate", "--cad", PLATE, "--copies", "1", "--out", "protected/bins"),
                ("cell", "--cad", PLATE, "--copies", "1", "--out", "protected/cell"),
                ("hand-eye", "pairs.json", "--out", "protected/robot.json"),
                ("evaluate", "bop", "bins", "--out", "protected/results.csv"),
                ("evaluate", "bop", "bins", "--report", "protected/found.html"),
                ("paper.py", "--quick", "--table", "1", "--out", "protected/paper"),
                ("world.py", "protected/world"),
                ("world.py", "world", "--scenes", "protected/scenes")):
    refuses(*command)
os.chmod("protected", 0o755)  # the folder is removed at the end
os.chmod("protected/scans", 0o755)
