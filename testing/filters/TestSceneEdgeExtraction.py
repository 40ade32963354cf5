# SPDX-License-Identifier: BSD-3-Clause
"""A step of brightness, or of depth, becomes a line of points; images of all kinds and cameras; bad input."""
import math

import numpy
from vtkmodules.util.numpy_support import numpy_to_vtk
from vtkmodules.vtkCommonDataModel import vtkImageData, vtkStructuredGrid

from ppfmeam.filters import vtkMEAMSceneEdgeExtraction
from meamtest import Folder, box, check, close, connect, fails, grid, picture, points, run, set_fields, text, tuples

W, H, EDGE = 40, 30, 20


def scan(image=None, depth=lambda x, y: 500.0, layers=1):
    """Points 1 mm apart; `image` gives the value or the values of a pixel."""
    data = grid(W, H, [(x, y, depth(x, y) + z) for z in range(layers) for y in range(H) for x in range(W)], layers)
    if image:
        values = numpy.array(pixels(image), "uint8").reshape(W * H, -1)
        array = numpy_to_vtk(values, deep=True)
        array.SetName("RGB" if values.shape[1] == 3 else "Intensity")
        data.GetPointData().AddArray(array)
    return data


def pixels(image, width=W, height=H):
    return [[image(x, y) for x in range(width)] for y in range(height)]


def step(x, y):
    """Bright on the right, only in the upper half: a scan upside down would show it."""
    return 200 if x >= EDGE and y < H // 2 else 50


def edges_of(*inputs, **properties):
    return connect(vtkMEAMSceneEdgeExtraction(), *inputs, **properties)


filter = edges_of(scan(step))
edges = run(filter)
upright = [(x, y) for x, y, _ in points(edges) if y < H // 2 - 3]
check(len({y for _, y in upright}) >= 10 and all(x in (EDGE - 1, EDGE) for x, _ in upright), f"the edge is {upright}")
check(not [p for p in points(edges) if p[1] > H // 2 + 1], "there is no edge in the lower half")
check([i for i, in tuples(edges, "PointId")] == [y * W + x for x, y, _ in points(edges)], "ids are grid indices")
check(all(close([abs(c) for c in t], (0, 1, 0), 0.1) for t, (_, y, _) in zip(tuples(edges, "Tangent"), points(edges)) if y < H // 2 - 4),
      "tangents run along the edge")
check(not run(edges_of(scan(step), ImageTangents=False)).GetPointData().HasArray("Tangent"), "tangents can be left out")
check(tuples(edges, "EdgeSource") == [(0,)] * edges.GetNumberOfPoints(), "all are the image's")
check(edges.GetNumberOfVerts() == edges.GetNumberOfPoints(), "a vertex for each point")
marked = filter.GetOutputDataObject(1)
check(marked.IsA("vtkImageData") and marked.GetNumberOfPoints() == W * H, "the second output is the edge image")
values = [v for v, in tuples(marked, "Edges")]
check([i for i in range(W * H) if values[(H - 1 - i // W) * W + i % W] == 255] == [i for i, in tuples(edges, "PointId")],
      "it shows the same points")

# How well the sensor measured: points 1 mm apart, all of them, without noise.
quality = edges.GetFieldData().GetArray("ScanQuality")
check({quality.GetComponentName(i): quality.GetComponent(0, i) for i in range(quality.GetNumberOfComponents())}
      == {"PointDistance": 1, "Noise": 0, "Smoothing": 1, "DepthStep": 0, "JumpGap": 0, "Flying": 0, "Coverage": 1},
      f"the quality is {quality}")
check(text(edges, "ScanReport").startswith("Points 1.00 mm apart"), "in words, too")

# The same image as colours, as a second input, with 16 bits.
ids = tuples(edges, "PointId")
check(tuples(run(edges_of(scan(lambda x, y: (step(x, y),) * 3))), "PointId") == ids, "a grey RGB image is the same")
check(tuples(run(edges_of(scan(), picture(pixels(step)))), "PointId") == ids, "an image of its own is the same")
wide = picture(257 * numpy.array(pixels(step)), "uint16")
check(tuples(run(edges_of(scan(), wide)), "PointId") == ids, "16 bits are the same")

# At a jump of depth the edge belongs to the nearer side.
near = run(edges_of(scan(step, lambda x, y: 450.0 if x >= EDGE else 500.0)))
check(all(x == EDGE and z == 450 for x, y, z in points(near) if y < H // 2 - 3), "the edge is on the nearer side")
# Settings reach the core: Sobel answers a step of 150 with 600.
tall = scan(lambda x, y: 200 if x >= EDGE else 50)
check(run(edges_of(tall, Smoothing=0, HighThreshold=601)).GetNumberOfPoints() == 0, "the step is below 601")
check(run(edges_of(tall, Smoothing=0, HighThreshold=599)).GetNumberOfPoints() > 0, "the step is above 599")
check(run(edges_of(scan(lambda x, y: 7))).GetNumberOfPoints() == 0, "one colour has no edges")

# Edges of the cloud alone need no image.
cliff = scan(depth=lambda x, y: 450.0 if x >= EDGE else 500.0)
jump = run(edges_of(cliff, ImageEdges=False, DepthEdges=True))
check(points(jump) == [(EDGE, y, 450) for y in range(H)] and tuples(jump, "EdgeSource") == [(1,)] * H, "the cliff's edge")
ridge = run(edges_of(scan(depth=lambda x, y: 500.0 + abs(x - EDGE)), ImageEdges=False, Creases=True))
check(ridge.GetNumberOfPoints() > H // 2 and {x for x, _, _ in points(ridge)} == {EDGE}, "the ridge is a crease")
check(set(tuples(ridge, "EdgeSource")) == {(2,)}, "and labelled as one")
check(run(edges_of(scan(depth=lambda x, y: 500.0 + abs(x - EDGE)), ImageEdges=False, Creases=True,
                   CreaseAngle=100)).GetNumberOfPoints() == 0, "it is 90 degrees")

# A camera beside the sensor, 100 mm to the right with half a pixel a millimetre, sees the step of the plane 500 mm
# away 50 pixels to the left: at column (EDGE - 100) / 2 + 60 = 20. From the image's field data, and from a file.
CAMERA = (250, 0, 60, 0, 250, 10, 0, 0, 1)
POSE = (1, 0, 0, -100, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1)
small = picture(pixels(lambda x, y: 200 if x >= 20 else 50, 70, 40))
fails(edges_of(scan(), small), "70 x 40", "40 x 30", "camera")
seen = set_fields(picture(pixels(lambda x, y: 200 if x >= 20 else 50, 70, 40)), CameraMatrix=CAMERA, CameraPose=POSE)
beside = edges_of(scan(), seen)
check(len(points(run(beside))) >= H // 2 and all(abs(x - EDGE) <= 2 for x, _, _ in points(beside.GetOutput())),
      f"the step is at {points(beside.GetOutput())}")
check(all(close([abs(c) for c in t], (0, 1, 0), 0.05) for t in tuples(beside.GetOutput(), "Tangent")), "tangents on the plane")
folder = Folder()
path = folder("camera.json", '{"image_width": 70, "image_height": 40, "camera_matrix": [[250, 0, 60], [0, 250, 10], [0, 0, 1]], '
                             '"T_camera_scene": [[1, 0, 0, -100], [0, 1, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]]}')
check(points(run(edges_of(scan(), small, CameraFile=path))) == points(beside.GetOutput()), "the same camera from a file")
fails(edges_of(scan(), picture(pixels(step)), CameraFile=path), "40 x 30", "70 x 40")
fails(edges_of(scan(), small, CameraFile="/nowhere.yaml"), "nowhere")
set_fields(seen, CameraMatrix=(1, 2))
fails(edges_of(scan(), seen), "CameraMatrix", "9")
for threads in (1, 3):
    check(points(run(edges_of(scan(step), NumberOfThreads=threads))) == points(edges), f"{threads} threads")

fails(vtkMEAMSceneEdgeExtraction())
fails(edges_of(scan(step), ImageEdges=False, DepthEdges=False, Creases=False), "No edges")
fails(edges_of(vtkStructuredGrid()), "no points")
fails(edges_of(scan(step, lambda x, y: math.nan)), "NaN")
fails(edges_of(scan()), "no image", "Intensity")
fails(edges_of(scan(layers=2), picture(pixels(step))), "40 x 30 x 2")
fails(edges_of(scan(), picture(pixels(step, 30, 20))), "30 x 20", "40 x 30")
fails(edges_of(scan(), vtkImageData()), "no pixels")
fails(edges_of(box(1, 1, 1)), "vtkStructuredGrid")
