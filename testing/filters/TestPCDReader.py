# SPDX-License-Identifier: BSD-3-Clause
"""Small PCD files: organized and not, intensity and colours, points without depth, bad files."""
import math
import os

from ppfmeam.filters import vtkMEAMPCDReader
from meamtest import Folder, check, close, connect, fails, points, run, tuples

file = Folder()


def pcd(rows, width, height, fields="x y z", viewpoint="0 0 0 1 0 0 0"):
    count = len(fields.split())
    return file("cloud.PCD", f"VERSION .7\nFIELDS {fields}\nSIZE{' 4' * count}\nTYPE{' F' * count}\nCOUNT{' 1' * count}\n"
                f"WIDTH {width}\nHEIGHT {height}\nVIEWPOINT {viewpoint}\nPOINTS {width * height}\nDATA ascii\n" +
                "".join(" ".join(map(str, row)) + "\n" for row in rows))


def reader(path, scale=1.0):
    return connect(vtkMEAMPCDReader(), FileName=path, Scale=scale)


NAN = (math.nan,) * 3
GRID = [(0, 0, 5), (1, 0, 5), NAN, (0, 1, 6), (1, 1, 6), (2, 1, 6)]

# Organized: everything stays in its place, what has no depth is blanked.
path = pcd([p + (10 * i, 0, 0, -1) for i, p in enumerate(GRID)], 3, 2, "x y z intensity normal_x normal_y normal_z")
grid = run(reader(path))
check(grid.IsA("vtkStructuredGrid"), f"an organized file gives a {grid.GetClassName()}")
size = [0, 0, 0]
grid.GetDimensions(size)
check(size == [3, 2, 1], f"the size is {size}")
check(points(grid)[5] == (2, 1, 6), f"the last point is {points(grid)[5]}")
check([grid.IsPointVisible(i) for i in range(6)] == [1, 1, 0, 1, 1, 1], "only the third point is blanked")
check(tuples(grid, "Intensity") == [(0,), (10,), (20,), (30,), (40,), (50,)], "whole grey values are kept")
check(tuples(grid, "Normals")[0] == (0, 0, -1), "normals are read")

# Not organized: points without depth are left out, with what belongs to them.
path = pcd([p + (0.2 * i,) for i, p in enumerate(GRID)], 6, 1, "x y z intensity")
cloud = run(reader(path, 1000))
check(cloud.IsA("vtkPolyData") and cloud.GetNumberOfVerts() == 5, "an unorganized file gives vertices")
check(close(points(cloud)[2], (0, 1000, 6000)), f"metres become millimetres: {points(cloud)[2]}")
check(tuples(cloud, "Intensity") == [(0,), (51,), (153,), (204,), (255,)], "other grey values are spread")

# The packed colour of PCL: 0xRRGGBB in the bits of a float.
path = pcd([(1, 2, 3, 1.1479e-41)], 1, 1, "x y z rgb")  # bits 0x00002000
check(tuples(run(reader(path)), "RGB") == [(0, 32, 0)], "colours are unpacked")

# One reader, another file: the output follows.
same = reader(pcd(GRID, 6, 1))
check(run(same).IsA("vtkPolyData"), "not organized")
organized = file("organized.pcd")
os.replace(pcd(GRID, 3, 2), organized)
same.SetFileName(organized)
check(run(same).IsA("vtkStructuredGrid"), "organized")

check(vtkMEAMPCDReader().CanReadFile(organized) == 1, "a PCD file can be read")

# With its camera a cloud that is not organized comes back onto its pixels; one that is organized needs none.
flat = pcd([(0, 0, 500), (0, 0, 600), (10, -5, 500)], 3, 1)
with_camera = reader(flat)
with_camera.SetFocalLength(100, 100)
with_camera.SetPrincipalPoint(1, 1)
with_camera.SetImageSize(4, 3)
grid = run(with_camera)
check(grid.IsA("vtkStructuredGrid") and [i for i in range(12) if grid.IsPointVisible(i)] == [3, 5], "the pixels that see points")
with_camera.SetFileName(organized)
fails(with_camera, "leave the camera away")

fails(reader(__file__), "not a PCD file")
fails(reader(pcd([], 0, 1)), "no points")
fails(reader(pcd([NAN] * 4, 2, 2)), "NaN")
fails(reader(pcd([NAN] * 4, 4, 1)), "NaN")
fails(reader(pcd(GRID[:4], 3, 2)), "cut off")
# An error takes the old output away.
same.SetFileName(pcd([], 0, 1))
fails(same, "no points")

# Where a file says that its sensor stood, of points that are in another frame than its own.
table = [(100 + x, y, 0) for x in range(3) for y in range(3)]
for place, told in (("100 0 300 0 1 0 0", True), ("0 0 0 1 0 0 0", False)):
    sensor = run(reader(pcd(table, 9, 1, viewpoint=place), 10.0)).GetFieldData().GetArray("Sensor")
    check((sensor is not None) == told, f"the sensor of VIEWPOINT {place}: {sensor}")
    check(not told or sensor.GetTuple(0)[:3] == (1000, 0, 3000), "the sensor's place is scaled with the points")
