# SPDX-License-Identifier: BSD-3-Clause
"""A step of brightness, or of depth, becomes a line of points; images of all kinds and cameras; bad input."""
import math
import os
import tempfile

from vtkmodules.vtkCommonCore import vtkPoints, vtkUnsignedCharArray, vtkUnsignedShortArray
from vtkmodules.vtkCommonDataModel import vtkImageData, vtkStructuredGrid

from ppfmeam.filters import vtkMEAMSceneEdgeExtraction
from meamtest import box, check, close, connect, fails, points, prints, run, set_fields, tuples

W, H, EDGE = 40, 30, 20


def scan(image=None, depth=lambda x, y: 500.0, layers=1):
    """Points 1 mm apart; `image` gives the value or the values of a pixel."""
    grid, places = vtkStructuredGrid(), vtkPoints()
    for z in range(layers):
        for y in range(H):
            for x in range(W):
                places.InsertNextPoint(x, y, depth(x, y) + z)
    grid.SetDimensions(W, H, layers)
    grid.SetPoints(places)
    if image:
        grid.GetPointData().AddArray(pixels(image, [(x, y) for y in range(H) for x in range(W)]))
    return grid


def pixels(image, places, kind=vtkUnsignedCharArray):
    array = kind()
    values = [image(x, y) for x, y in places]
    array.SetName("RGB" if isinstance(values[0], tuple) else "Intensity")
    array.SetNumberOfComponents(3 if isinstance(values[0], tuple) else 1)
    for value in values:
        array.InsertNextTuple(value if isinstance(value, tuple) else (value,))
    return array


def picture(image, width=W, height=H, kind=vtkUnsignedCharArray):
    """VTK's images start at the lower left."""
    data = vtkImageData()
    data.SetDimensions(width, height, 1)
    data.GetPointData().SetScalars(pixels(image, [(x, y) for y in reversed(range(height)) for x in range(width)], kind))
    return data


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
check(edges.GetFieldData().GetAbstractArray("ScanReport").GetValue(0).startswith("Points 1.00 mm apart"), "in words, too")

# The same image as colours, as a second input, with 16 bits.
ids = tuples(edges, "PointId")
check(tuples(run(edges_of(scan(lambda x, y: (step(x, y),) * 3))), "PointId") == ids, "a grey RGB image is the same")
check(tuples(run(edges_of(scan(), picture(step))), "PointId") == ids, "an image of its own is the same")
wide = picture(lambda x, y: 257 * step(x, y), kind=vtkUnsignedShortArray)
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
small = picture(lambda x, y: 200 if x >= 20 else 50, 70, 40)
fails(edges_of(scan(), small), "70 x 40", "40 x 30", "camera")
seen = picture(lambda x, y: 200 if x >= 20 else 50, 70, 40)
set_fields(seen, CameraMatrix=CAMERA, CameraPose=POSE)
beside = edges_of(scan(), seen)
check(len(points(run(beside))) >= H // 2 and all(abs(x - EDGE) <= 2 for x, _, _ in points(beside.GetOutput())),
      f"the step is at {points(beside.GetOutput())}")
check(all(close([abs(c) for c in t], (0, 1, 0), 0.05) for t in tuples(beside.GetOutput(), "Tangent")), "tangents on the plane")
with tempfile.TemporaryDirectory() as folder:
    path = os.path.join(folder, "camera.json")
    with open(path, "w") as file:
        file.write('{"image_width": 70, "image_height": 40, "camera_matrix": [[250, 0, 60], [0, 250, 10], [0, 0, 1]], '
                   '"T_camera_scene": [[1, 0, 0, -100], [0, 1, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]]}')
    named = edges_of(scan(), small, CameraFile=path)
    check(points(run(named)) == points(beside.GetOutput()), "the same camera from a file")
    fails(edges_of(scan(), picture(step), CameraFile=path), "40 x 30", "70 x 40")
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
fails(edges_of(scan(layers=2), picture(step)), "40 x 30 x 2")
fails(edges_of(scan(), picture(step, 30, 20)), "30 x 20", "40 x 30")
fails(edges_of(scan(), vtkImageData()), "no pixels")
fails(edges_of(box(1, 1, 1)), "vtkStructuredGrid")
filter.SetNumberOfThreads(2)
filter.SetParametersToPaper()
check((filter.GetImageEdges(), filter.GetDepthEdges(), filter.GetCreases(), filter.GetImageTangents()) ==
      (True, False, False, False), "the paper's: edges of the image alone")
check(filter.GetNumberOfThreads() == 2, "the number of threads stays")
filter.SetParametersToRecommended()
check(filter.GetDepthEdges() and filter.GetCreases() and filter.GetImageTangents(), "the recommended: all")
prints(filter, "ImageEdges", "DepthEdges", "Creases", "CreaseAngle", "ImageTangents", "CameraFile", "NumberOfThreads",
       "Smoothing", "LowThreshold", "HighThreshold", "SearchRadius", "DepthJump")
