# SPDX-License-Identifier: BSD-3-Clause
"""Small PLY clouds: alone, and brought back onto the pixels of their camera; bad files."""
import json

from ppfmeam.filters import vtkMEAMPLYReader
from meamtest import Folder, check, close, connect, fails, points, run, tuples

write = Folder()


def ply(rows, more="", name="cloud.ply"):
    return write(name, f"ply\nformat ascii 1.0\nelement vertex {len(rows)}\nproperty float x\nproperty float y\n"
                 f"property float z\n{more}end_header\n" + "".join(" ".join(map(str, row)) + "\n" for row in rows))


def reader(path, **properties):
    return connect(vtkMEAMPLYReader(), FileName=path, **properties)


CAMERA = {"FocalLength": (100, 100), "PrincipalPoint": (1, 1), "ImageSize": (4, 3)}
path = ply([(0, 0, 0.6, 10), (0, 0, 0.5, 20), ("nan", 0, 1, 30), (0.01, -0.005, 0.5, 40)], "property uchar intensity\n")

# Without a camera: the points.
same = reader(path, Scale=1000)
cloud = run(same)
check(cloud.IsA("vtkPolyData") and cloud.GetNumberOfVerts() == 3, "vertices, without those that are not finite")
check(close(points(cloud)[2], (10, -5, 500), 1e-4), f"metres become millimetres: {points(cloud)[2]}")
check(tuples(cloud, "Intensity") == [(10,), (20,), (40,)], "intensities")

# With one: the same reader gives a grid.
grid = run(connect(same, **CAMERA))
check(grid.IsA("vtkStructuredGrid"), "with a camera the cloud is organized")
size = [0, 0, 0]
grid.GetDimensions(size)
check(size == [4, 3, 1], f"the size is {size}")
check([i for i in range(12) if grid.IsPointVisible(i)] == [3, 5], "the pixels that see points")
check(close(points(grid)[5], (0, 0, 500), 1e-4), f"the nearest point: {points(grid)[5]}")
check(tuples(grid, "Intensity")[2:6] == [(40,), (40,), (20,), (20,)], "the image has no holes")
calibration = write("camera.json", json.dumps({"fx": 100, "fy": 100, "cx": 1, "cy": 1, "width": 4, "height": 3}))
again = run(reader(path, Scale=1000, CameraFile=calibration))
check(points(again)[5] == points(grid)[5] and tuples(again, "Intensity") == tuples(grid, "Intensity"), "a calibration file")

colours = "".join(f"property uchar {name}\n" for name in ("red", "green", "blue"))
normals = "".join(f"property float n{axis}\n" for axis in "xyz")
cloud = run(reader(ply([(1, 2, 3, 9, 8, 7, 0, 0, -1)], colours + normals, "rich.ply")))
check(tuples(cloud, "RGB") == [(9, 8, 7)] and tuples(cloud, "Normals") == [(0, 0, -1)], "colours and normals")

mesh = write("mesh.ply", "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
             "element face 1\nproperty list uchar int vertex_indices\nend_header\n0 0 1\n1 0 1\n0 1 1\n3 0 1 2\n")
check(vtkMEAMPLYReader().CanReadFile(path) == 1, "a cloud can be read")
check(vtkMEAMPLYReader().CanReadFile(mesh) == 0, "a mesh is for another reader")

fails(reader(__file__), "not a PLY file")
fails(reader(ply([("nan", 0, 1)], name="nan.ply")), "NaN")
fails(reader(write("cut.ply", open(path).read()[:-8])), "cut off")
fails(reader(path, CameraFile="/no/such/camera.json"), "/no/such/camera.json")
fails(reader(path, FocalLength=(100, 100)), "width and height")
fails(reader(path, **{**CAMERA, "PrincipalPoint": (900, 900)}), "sees no point")
# An error takes the old output away.
same.SetPrincipalPoint(900, 900)
fails(same, "sees no point")
