# SPDX-License-Identifier: BSD-3-Clause
"""Poses from text files; files that are no poses."""

from ppfmeam.filters import vtkMEAMPoseReader
from meamtest import Folder, check, close, connect, fails, points, run, tuples

file = Folder()


def reader(text):
    return connect(vtkMEAMPoseReader(), FileName=file("poses.txt", text))


two = "# ground truth\n0 -1 0 1.5\n1 0 0 -2\n0 0 1 +1e-1\n0 0 0 1\n\n1 0 0 7 0 1 0 8 0 0 1 9 0 0 0 1"
read = run(reader(two))
check(tuples(read, "Transform") == [(0, -1, 0, 1.5, 1, 0, 0, -2, 0, 0, 1, 0.1, 0, 0, 0, 1),
                                    (1, 0, 0, 7, 0, 1, 0, 8, 0, 0, 1, 9, 0, 0, 0, 1)], "the matrices of the file")
check(points(read) == [(1.5, -2, 0.1), (7, 8, 9)], f"the origins are {points(read)}")
check(tuples(read, "Rank") == [(1,), (2,)], "ranks follow the file")
check(close(tuples(read, "Quaternion")[0], (0, 0, 0.5**0.5, 0.5**0.5)), "the quaternion is x y z w")
check(read.GetNumberOfVerts() == 2, "a vertex for each pose")
check(vtkMEAMPoseReader().CanReadFile(file("poses.txt")) == 1, "a pose file can be read")
check(run(reader("# nothing found\n")).GetNumberOfPoints() == 0, "a file without numbers has no poses")

fails(reader("1 2 3"), "4x4")
fails(reader("1 0 0 x" + " 0" * 12), "not a number")
fails(reader("2 0 0 0 0 1 0 0 0 0 1 0 0 0 0 1"), "not a rotation")
