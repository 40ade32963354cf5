# SPDX-License-Identifier: BSD-3-Clause
"""make FOLDER [COPIES]: a part (part.stl), a simulated scan of a bin of them (scan.pcd), the true poses (truth.txt) and the camera in a
robot's frame (robot.json).
check FOLDER: what the C++ programs found (found.txt, picks.txt) is true, and the same that Python finds with the model that
C++ trained (part.meam)."""
import json
import os
import sys

import numpy
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkIOGeometry import vtkSTLWriter

import ppfmeam
from ppfmeam.filters import vtkMEAMBinSceneSource

WIDTH, HEIGHT = 480, 360
MILLIMETRES = 1.0
ROBOT = [[1, 0, 0, 100], [0, -1, 0, 200], [0, 0, -1, 900], [0, 0, 0, 1]]


def make():
    source = vtkMEAMBinSceneSource()
    source.SetWidth(WIDTH)
    source.SetHeight(HEIGHT)
    source.SetCopies(int(sys.argv[3]) if len(sys.argv) > 3 else 4)
    source.Update()
    scan, truth, part, _ = (source.GetOutputDataObject(port) for port in range(4))
    writer = vtkSTLWriter()
    writer.SetInputData(part)
    writer.SetFileName("part.stl")
    writer.SetFileTypeToBinary()
    writer.Write()
    rows = numpy.empty((WIDTH * HEIGHT, 4), numpy.float32)
    rows[:, :3] = vtk_to_numpy(scan.GetPoints().GetData())
    rows[:, 3] = vtk_to_numpy(scan.GetPointData().GetArray("Intensity"))
    with open("scan.pcd", "wb") as file:
        file.write(f"VERSION 0.7\nFIELDS x y z intensity\nSIZE 4 4 4 4\nTYPE F F F F\nCOUNT 1 1 1 1\nWIDTH {WIDTH}\n"
                   f"HEIGHT {HEIGHT}\nVIEWPOINT 0 0 0 1 0 0 0\nPOINTS {len(rows)}\nDATA binary\n".encode())
        file.write(rows.tobytes())
    numpy.savetxt("truth.txt", vtk_to_numpy(truth.GetPointData().GetArray("Transform")))
    with open("robot.json", "w", encoding="utf-8") as file:
        json.dump({"units": "mm", "T_robot_camera": ROBOT}, file)


def printed(name):
    """Lines and matrices as the examples print them: a line, and four of the matrix."""
    with open(name, encoding="utf-8") as file:
        lines = file.read().splitlines()
    poses = [[[float(word) for word in line.split()] for line in lines[k + 1:k + 5]] for k in range(0, len(lines), 5)]
    return lines[::5], numpy.array(poses)


def check():
    truth = numpy.loadtxt("truth.txt").reshape(-1, 4, 4)
    model = ppfmeam.load("part.meam")
    told, poses = printed("found.txt")
    probabilities = [float(line.split()[1]) for line in told]
    assert len(poses) >= 2, f"{len(poses)} poses"
    nearest = [min(numpy.linalg.norm(pose[:3, 3] - T[:3, 3]) for T in truth) for pose in poses]
    print(f"found.txt: {len(poses)} poses, {sum(d < MILLIMETRES for d in nearest)} of them true")
    assert nearest[0] < MILLIMETRES and probabilities[0] > 0.5, f"{nearest}, {probabilities}"
    found = ppfmeam.detect(model, "scan.pcd")
    assert len(found) == len(poses), f"Python finds {len(found)} poses"
    assert numpy.allclose(found.poses, poses, rtol=1e-5, atol=1e-3), "Python finds others"  # as printed

    told, frames = printed("picks.txt")
    grasps = ppfmeam.grasps("part.stl", file="part.grasps.json", symmetries=model, opening=60, finger_width=8, finger_thickness=5)
    picks = ppfmeam.pick(ppfmeam.detect(model, "scan.pcd", poses=0, probability=0.5), grasps, "scan.pcd", robot_frame="robot.json")
    print(f"picks.txt: {len(told)} picks; Python: {picks.report}")
    assert len(told) == picks.possible.sum() > 0, f"picks.txt: {len(told)} picks, Python plans {picks.possible.sum()}"
    assert told[0].startswith(f"copy {picks.instances[0]}, {picks.names[0]}, clearance "), told[0]
    assert numpy.allclose(picks.robot_transforms[picks.possible], frames, rtol=1e-5, atol=5e-3), "Python plans others"


os.chdir(sys.argv[2])
{"make": make, "check": check}[sys.argv[1]]()
