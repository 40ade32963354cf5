# SPDX-License-Identifier: BSD-3-Clause
"""Small texts of points: alone, and brought back onto the pixels of their camera; bad files."""
from ppfmeam.filters import vtkMEAMXYZReader
from meamtest import Folder, check, close, connect, fails, points, run, tuples

write = Folder()


def reader(path, **properties):
    return connect(vtkMEAMXYZReader(), FileName=path, **properties)


CAMERA = {"FocalLength": (100, 100), "PrincipalPoint": (1, 1), "ImageSize": (4, 3)}
path = write("cloud.csv", "x;y;z;intensity\n0;0;0,6;10\n0;0;0,5;20\n;;;30\n0,01;-0,005;0,5;40\n")
cloud = run(reader(path, Scale=1000))
check(cloud.IsA("vtkPolyData") and cloud.GetNumberOfVerts() == 3, "vertices, without those that were not measured")
check(close(points(cloud)[2], (10, -5, 500), 1e-4), f"metres become millimetres: {points(cloud)[2]}")
check(tuples(cloud, "Intensity") == [(10,), (20,), (40,)], "intensities")
grid = run(reader(path, Scale=1000, **CAMERA))
check(grid.IsA("vtkStructuredGrid") and close(points(grid)[5], (0, 0, 500), 1e-4), "with a camera the cloud is organized")
rich = run(reader(write("rich.xyz", "1 2 3 9 8 7 0 0 -1\n")))
check(tuples(rich, "RGB") == [(9, 8, 7)] and tuples(rich, "Normals") == [(0, 0, -1)], "colours and normals")

check(vtkMEAMXYZReader().CanReadFile(path) == 1, "points can be read")
check(vtkMEAMXYZReader().CanReadFile(__file__) == 0, "a program is no text of points")
fails(reader(__file__), "where a point's x, y and z are expected")
fails(reader(write("nan.xyz", "nan 0 1\n")), "NaN")
fails(reader(path, FocalLength=(100, 100)), "width and height")
