# SPDX-License-Identifier: BSD-3-Clause
"""T_robot_camera from a file of pairs, exact ones and one that does not belong; written and used; `ppfmeam hand-eye`."""
import json
import os
import subprocess

from vtkmodules.vtkCommonMath import vtkMatrix4x4
from vtkmodules.vtkCommonTransforms import vtkTransform

from ppfmeam.filters import vtkMEAMHandEyeCalibration, vtkMEAMPoseReader, vtkMEAMPoseWriter
from meamtest import Errors, Folder, check, close, connect, fails, field, poses, run, text, tuples

path = Folder()


def placed(x, y, z, angle, *axis):
    transform = vtkTransform()
    transform.Translate(x, y, z)
    transform.RotateWXYZ(angle, *axis)
    return transform.GetMatrix()


def product(*matrices):
    result = vtkMatrix4x4()
    for matrix in matrices:
        vtkMatrix4x4.Multiply4x4(result, matrix, result)
    return result


def inverse(matrix):
    result = vtkMatrix4x4()
    vtkMatrix4x4.Invert(matrix, result)
    return result


def rows(matrix):
    return [[matrix.GetElement(i, k) for k in range(4)] for i in range(4)]


def flat(matrix):
    return [value for row in rows(matrix) for value in row]


def lines(pairs):
    return "".join(",".join(map(repr, flat(g) + flat(t))) + "\n" for g, t in pairs)


def calibration(name, **properties):
    return connect(vtkMEAMHandEyeCalibration(), FileName=path(name), **properties)


camera, target = placed(400, -250, 900, 160, 1, 0.2, -0.1), placed(15, -8, 120, 40, -0.3, 1, 0.5)
grippers = [placed(100 + 30 * k, 50 * k * k - 200, 300 - 20 * k, 35 * k, k % 3, (k + 1) % 2, k - 2) for k in range(1, 9)]
beside = [(g, product(inverse(camera), g, target)) for g in grippers]
hand = [(g, product(inverse(camera), inverse(g), target)) for g in grippers]
path("hand.json", json.dumps({"mount": "hand", "pairs": [{"T_base_gripper": rows(g), "T_camera_target": rows(t)} for g, t in hand]}))
path("beside.csv", lines(beside))
off = [(g, product(placed(12 if k == 3 else 0, 0, 0, 0, 0, 0, 1), t)) for k, (g, t) in enumerate(beside)]
path("off.csv", lines(off))

# Exact pairs give the camera, by either mount.
for name, properties, mount in (("beside.csv", {}, "beside"), ("hand.json", {}, "hand"), ("hand.json", {"Mount": 2}, "hand")):
    filter = calibration(name, **properties)
    found = run(filter)
    check(close(tuples(found, "Transform")[0], flat(camera), 1e-6), f"{name}: {tuples(found, 'Transform')}")
    check(text(found, "CameraMount") == mount, name)
    check(field(found, "ResidualShift")[0][0] < 1e-6 and field(found, "ResidualTurn")[0][0] < 1e-6, "no residual")
    table = filter.GetOutputDataObject(1)
    check([table.GetColumnName(k) for k in range(3)] == ["Pair", "Shift", "Turn"] and table.GetNumberOfRows() == 8, "a row a pair")

# The wrong mount is an error; a pair that hardly belongs to the others shows in the residual.
fails(calibration("hand.json", Mount=1), "fit a camera on the hand: set the mount")
filter = calibration("off.csv")
run(filter)
shifts = [filter.GetOutputDataObject(1).GetValue(k, 1).ToDouble() for k in range(8)]
check(max(shifts) == shifts[3] > 3, f"pair 4 stands out: {shifts}")

# Written, and poses in the robot's frame by it.
filter = calibration("beside.csv")
for name in ("robot.json", "robot.yaml"):
    check(filter.WriteRobotFrame(path(name)) == 1, f"{name} is written")
    writer = connect(vtkMEAMPoseWriter(), poses(tuple(flat(target))), FileName=path("poses.txt"), RobotFrameFile=path(name))
    check(writer.Write() == 1, "the poses are written")
    read = run(connect(vtkMEAMPoseReader(), FileName=writer.GetFileName()))
    check(close(tuples(read, "Transform")[0], flat(product(camera, target)), 1e-6), f"the robot's, by {name}")
errors = Errors(filter)
check(filter.WriteRobotFrame(path("no/robot.json")) == 0 and "robot.json" in str(errors), f"{errors}")

# Errors.
path("few.csv", lines([(grippers[0], target)]))
fails(calibration("few.csv"), "3 pairs")
fails(calibration("missing.csv"), "missing.csv")
fails(vtkMEAMHandEyeCalibration(), "no file")


# The command.
def command(*arguments):
    return subprocess.run(["/usr/bin/python3", "-m", "ppfmeam", "hand-eye", *arguments], capture_output=True, text=True)


result = command(path("beside.csv"), "--out", path("command.json"))
check(result.returncode == 0 and "pair   8:" in result.stdout and "robot's base" in result.stdout, f"{result}")
matrix = json.loads(path.text("command.json"))["T_robot_camera"]
check(close([v for row in matrix for v in row], flat(camera), 1e-6), f"{matrix}")
result = command(path("beside.csv"), "--json", path("told.json"))
told = json.loads(path.text("told.json"))
check(told["T_robot_camera"] == matrix and told["mount"] == "beside" and [pair["pair"] for pair in told["pairs"]] == list(range(1, 9)) and
      told["report"] in result.stdout, f"{told}")
result = command(path("off.csv"), "--limit", "1", "--out", path("off.json"))
check(result.returncode == 1 and "larger than 1 mm" in result.stderr and not os.path.exists(path("off.json")), f"{result}")
result = command(path("few.csv"))
check(result.stderr.startswith("ppfmeam hand-eye: Hand-eye calibration needs 3 pairs"), f"{result}")
