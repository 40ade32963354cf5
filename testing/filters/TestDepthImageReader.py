# SPDX-License-Identifier: BSD-3-Clause
"""Small depth images: camera from a file and from properties, image, scale, bad files."""
import json

from ppfmeam.filters import vtkMEAMDepthImageReader
from meamtest import Folder, check, close, connect, fails, png, points, run, tuples

file = Folder()


def reader(**properties):
    return connect(vtkMEAMDepthImageReader(), **properties)


depth = png(file("depth.png"), [[(0,), (5000,), (65534,)], [(1,), (2,), (3,)]], "uint16")
grey = png(file("grey.png"), [[(0,), (50,), (100,)], [(150,), (200,), (255,)]])
colour = png(file("colour.png"), [[(1, 2, 3)] * 3] * 2)
camera = file("camera.json", json.dumps({"fx": 100, "fy": 200, "cx": 1, "cy": 0.5, "width": 3, "height": 2, "depth_scale": 0.1}))

# A camera in properties: a point for each pixel, what has no depth is blanked.
same = reader(FileName=depth, FocalLength=(100, 200), PrincipalPoint=(1, 0.5), ImageFileName=grey)
grid = run(same)
size = [0, 0, 0]
grid.GetDimensions(size)
check(size == [3, 2, 1], f"the size is {size}")
check(close(points(grid)[1], (0, -12.5, 5000), 1e-3), f"the second point is {points(grid)[1]}")
check([grid.IsPointVisible(i) for i in range(6)] == [0, 1, 1, 1, 1, 1], "only the first point is blanked")
check(tuples(grid, "Intensity") == [(0,), (50,), (100,), (150,), (200,), (255,)], "the image is from the top left")
same.SetDepthScale(2)
check(close(points(run(same))[1], (0, -25, 10000), 1e-3), "the scale")

# A calibration file, with its scale, and colours.
same = reader(FileName=depth, CameraFile=camera, ImageFileName=colour)
check(close(points(run(same))[1], (0, -1.25, 500), 1e-3), "the scale of the calibration")
check(tuples(run(same), "RGB")[4] == (1, 2, 3), "red, green, blue")
same.SetDepthScale(1)
check(close(points(run(same))[1], (0, -12.5, 5000), 1e-3), "the property comes before the file")

fails(reader(FileName=depth), "no camera")
fails(reader(FileName=depth, CameraFile="/no/such/camera.json"), "/no/such/camera.json")
fails(reader(FileName=depth, CameraFile=__file__), "neither")
fails(reader(FileName=__file__, CameraFile=camera), "not a PNG")
fails(reader(FileName=grey, CameraFile=camera), "8 bits")
small = png(file("small.png"), [[(5,)]], "uint16")
fails(reader(FileName=small, CameraFile=camera), "1 x 1", "3 x 2")
fails(reader(FileName=depth, CameraFile=camera, ImageFileName=small), "not registered")
none = png(file("none.png"), [[(0,)] * 3] * 2, "uint16")
fails(reader(FileName=none, CameraFile=camera), "NaN")
# An error takes the old output away.
same.SetFileName(none)
fails(same, "NaN")
