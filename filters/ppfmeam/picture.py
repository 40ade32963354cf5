# SPDX-License-Identifier: BSD-3-Clause
"""A picture of a scan with the part at every pose, in the colours of the ranks; and pictures of single steps."""
import atexit
import os
import shutil
import subprocess

import numpy
from vtkmodules.util.numpy_support import numpy_to_vtkIdTypeArray, vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkLookupTable
from vtkmodules.vtkCommonDataModel import vtkCellArray, vtkPolyData, vtkStructuredGrid
from vtkmodules.vtkFiltersCore import vtkPolyDataNormals
from vtkmodules.vtkFiltersGeneral import vtkVertexGlyphFilter
from vtkmodules.vtkIOImage import vtkJPEGWriter, vtkPNGWriter
from vtkmodules.vtkRenderingCore import (
    vtkActor, vtkPolyDataMapper, vtkRenderer, vtkRenderWindow, vtkTextActor, vtkWindowToImageFilter)
import vtkmodules.vtkRenderingFreeType  # noqa: F401  the legend's letters
import vtkmodules.vtkRenderingOpenGL2  # noqa: F401

from .filters import vtkMEAMPoseInstances
from .scripting import Failure, bytes_of, shape_of, update, vtk_array, vtk_points, written

EXTENSIONS = (".png", ".jpg", ".jpeg")
WIDTH = 1600  # pixels
JPEG_QUALITIES = range(85, 40, -5)
STRIP = 56  # pixels above the scene, for the legend
MARGIN = 14  # pixels
LABELS = 10  # most of a picture, of the ranks that have colors of their own
TILT = 25  # degrees from the sensor's line of sight: shows depth
BACKGROUND = (0.11, 0.12, 0.14)


def require(path):
    """Raises a Failure when a picture of this name cannot be made here; nothing without one."""
    if path:
        if not path.lower().endswith(EXTENSIONS):
            raise Failure(f"{path}: the name of a picture ends in .png or .jpg")
        require_display()


def require_display():
    """Starts a virtual display, for this process alone, where there is none; raises a Failure when that cannot be done."""
    if os.environ.get("DISPLAY"):
        return
    program = shutil.which("Xvfb")
    if not program:
        raise Failure("a picture needs a display: install the Debian package xvfb, which has a virtual one")
    told, tells = os.pipe()
    server = subprocess.Popen([program, "-displayfd", str(tells), "-screen", "0", "1600x1200x24", "-nolisten", "tcp"], pass_fds=[tells],
                              stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, start_new_session=True)  # not to get Ctrl-C
    os.close(tells)
    atexit.register(server.terminate)
    with os.fdopen(told) as file:
        number = file.readline().strip()
    if not number:
        raise Failure("a picture needs a display, and Xvfb gives none: start the command with xvfb-run -a")
    os.environ["DISPLAY"] = ":" + number


def save(path, scene, poses, *parts, looks=None):
    """Writes a PNG or a JPEG. A part is the mesh, or the trained model; of several each stands at the poses with its `PartId`. The
    sensor `looks` along +z at an organized scene and from above, along -z, at any other."""
    require_display()
    if looks is None:
        looks = (0, 0, 1) if isinstance(scene, vtkStructuredGrid) else (0, 0, -1)
    points = vtk_to_numpy(scene.GetPoints().GetData())
    valid = numpy.isfinite(points).all(axis=1)
    instances = posed(poses, parts)

    renderer = vtkRenderer()
    renderer.SetBackground(BACKGROUND)
    renderer.AddActor(scan(scene, points, valid, looks))
    renderer.AddActor(copies(instances))
    height = look(renderer.GetActiveCamera(), points[valid], looks)
    renderer.ResetCameraClippingRange()
    strip = vtkRenderer()
    strip.SetBackground(BACKGROUND)
    for label in legend(instances.GetOutput(), poses):
        strip.AddActor2D(label)
    share = height / (height + STRIP)
    renderer.SetViewport(0, 0, 1, share)
    strip.SetViewport(0, share, 1, 1)
    write(window_of((WIDTH, height + STRIP), renderer, strip), path)


def window_of(size, *renderers):
    """A window that nobody sees."""
    window = vtkRenderWindow()
    window.SetOffScreenRendering(True)
    window.SetMultiSamples(8)
    window.SetSize(*size)
    for renderer in renderers:
        window.AddRenderer(renderer)
    return window


def write(window, path, most_bytes=None):
    """Renders a window to a JPEG or a PNG, by the name of the file; a JPEG no larger than `most_bytes`, if it can be."""
    window.Render()
    grabber = vtkWindowToImageFilter()
    grabber.SetInput(window)
    grabber.ReadFrontBufferOff()
    jpeg = path.lower().endswith((".jpg", ".jpeg"))
    writer = vtkJPEGWriter() if jpeg else vtkPNGWriter()
    writer.SetInputConnection(grabber.GetOutputPort())
    for quality in JPEG_QUALITIES if jpeg else (None,):
        if jpeg:
            writer.SetQuality(quality)
        content = bytes_of(writer)
        if most_bytes is None or len(content) <= most_bytes:
            break
    with written(path, mode="wb") as file:
        file.write(content)


def save_actors(path, actors, frame, size, labels=(), most_bytes=None):
    """Writes a picture of actors on white. `frame(camera)` turns the camera; `labels` are (text, colour or None)."""
    require_display()
    renderer = vtkRenderer()
    renderer.SetBackground(1, 1, 1)
    for actor in actors:
        renderer.AddViewProp(actor)
    frame(renderer.GetActiveCamera())
    renderer.ResetCameraClippingRange()
    for i, (text, color) in enumerate(labels):
        label = vtkTextActor()
        label.SetInput(f" {text} ")
        label.SetPosition(MARGIN, MARGIN + (len(labels) - 1 - i) * 34)
        style = label.GetTextProperty()
        style.SetFontSize(22)
        style.SetColor((1, 1, 1) if color is not None and sum(color) < 1.65 else (0.1, 0.1, 0.1))
        style.SetBackgroundColor(color or (1, 1, 1))
        style.SetBackgroundOpacity(1)
        renderer.AddActor2D(label)
    write(window_of(size, renderer), path, most_bytes)


def frame_of(points, towards, size, up=(0, 0, 1), margin=1.08):
    """A camera that stands in a direction from the points and has them all in the picture."""
    towards = numpy.array(towards, dtype=float) / numpy.linalg.norm(towards)
    right = numpy.cross(up, towards)
    right /= numpy.linalg.norm(right)
    axes = numpy.stack((right, numpy.cross(towards, right), towards))
    low, high = (points @ axes.T).min(axis=0), (points @ axes.T).max(axis=0)
    extent, middle = high - low, (low + high) / 2 @ axes

    def frame(camera):
        camera.ParallelProjectionOn()
        camera.SetFocalPoint(middle)
        camera.SetPosition(middle + 2 * extent.max() * towards)
        camera.SetViewUp(axes[1])
        camera.SetParallelScale(margin / 2 * max(extent[1], extent[0] * size[1] / size[0]))
    return frame


def solid(mesh, color=(0.93, 0.93, 0.93), edges=False):
    """A mesh in one colour, a little behind what lies on it; with its triangles' edges on request."""
    normals = vtkPolyDataNormals()
    normals.SetInputData(mesh)
    normals.SetFeatureAngle(30)
    mapper = vtkPolyDataMapper()
    mapper.SetInputConnection(normals.GetOutputPort())
    mapper.ScalarVisibilityOff()
    mapper.SetResolveCoincidentTopologyToPolygonOffset()
    mapper.SetRelativeCoincidentTopologyPolygonOffsetParameters(1, 60)
    actor = vtkActor()
    actor.SetMapper(mapper)
    actor.GetProperty().SetColor(color)
    actor.GetProperty().SetAmbient(0.45)
    actor.GetProperty().SetDiffuse(0.55)
    if edges:
        actor.GetProperty().EdgeVisibilityOn()
        actor.GetProperty().SetEdgeColor(0.25, 0.35, 0.5)
    return actor


def bare(points, values=None):
    """The points alone, a vertex each, and what they are coloured by."""
    data = vtkPolyData()
    data.SetPoints(vtk_points(points))
    if values is not None:
        data.GetPointData().SetScalars(vtk_array(values))
    vertices = vtkVertexGlyphFilter()
    vertices.SetInputData(data)
    return update(vertices).GetOutput()


def dots(points, colors, size=4):
    """Points as dots, in one colour (0 to 1) or one for each (0 to 255)."""
    single = isinstance(colors, tuple)
    actor = flat(bare(points, None if single else numpy.asarray(colors, dtype=numpy.uint8)))
    if single:
        actor.GetProperty().SetColor(colors)
    actor.GetProperty().SetPointSize(size)
    actor.GetProperty().SetRenderPointsAsSpheres(size > 3)
    return actor


def strokes(starts, ends, color, width=2.0, opacity=1.0):
    """Lines from point to point; one colour (0 to 1) or one for each line (0 to 255)."""
    data, cells = vtkPolyData(), vtkCellArray()
    count = len(starts)
    pairs = numpy.stack((numpy.arange(count), numpy.arange(count) + count), axis=1).ravel()
    cells.SetData(2, numpy_to_vtkIdTypeArray(pairs, deep=True))
    data.SetPoints(vtk_points(numpy.concatenate((starts, ends))))
    data.SetLines(cells)
    if not isinstance(color, tuple):
        data.GetCellData().SetScalars(vtk_array(numpy.asarray(color, dtype=numpy.uint8)))
    actor = flat(data)
    if isinstance(color, tuple):
        actor.GetProperty().SetColor(color)
    actor.GetProperty().SetLineWidth(width)
    actor.GetProperty().SetOpacity(opacity)
    return actor


def flat(data):
    """Points or lines in their colours, without light."""
    mapper = vtkPolyDataMapper()
    mapper.SetInputData(data)
    mapper.SetColorModeToDirectScalars()
    actor = vtkActor()
    actor.SetMapper(mapper)
    actor.GetProperty().LightingOff()
    return actor


def scan(scene, points, valid, looks, greys=(0.3, 0.8)):
    """The scan's points: in their grey values, or the nearer to the sensor the brighter."""
    values = scene.GetPointData().GetArray("Intensity")
    if values:
        values = vtk_to_numpy(values)[valid].astype(float)
    else:
        values = -points[valid] @ numpy.array(looks, dtype=float)
    grey = vtkLookupTable()
    grey.SetHueRange(0, 0)
    grey.SetSaturationRange(0, 0)
    grey.SetValueRange(*greys)
    mapper = vtkPolyDataMapper()
    mapper.SetInputData(bare(points[valid], values))
    mapper.SetLookupTable(grey)
    mapper.SetScalarRange(*numpy.percentile(values, (1, 99)))
    actor = vtkActor()
    actor.SetMapper(mapper)
    actor.GetProperty().SetPointSize(float(numpy.clip(WIDTH / len(values) ** 0.5, 2, 5)))
    actor.GetProperty().LightingOff()
    return actor


def copies(instances, port=0):
    """The part at every pose, drawn over scan points that lie on its surface; port 1: how uncertain the poses are."""
    normals = vtkPolyDataNormals()
    normals.SetInputConnection(instances.GetOutputPort(port))
    normals.SetFeatureAngle(30)
    mapper = vtkPolyDataMapper()
    mapper.SetInputConnection(normals.GetOutputPort())
    mapper.SetScalarModeToUsePointFieldData()
    mapper.SelectColorArray("RankColor")
    mapper.SetColorModeToDirectScalars()
    mapper.SetResolveCoincidentTopologyToPolygonOffset()
    mapper.SetRelativeCoincidentTopologyPolygonOffsetParameters(0, -400)  # no slope: it brings hidden walls forward
    actor = vtkActor()
    actor.SetMapper(mapper)
    actor.GetProperty().SetSpecular(0.2)
    actor.GetProperty().SetSpecularPower(20)
    actor.GetProperty().SetPointSize(3)  # of a model without faces
    actor.GetProperty().SetLighting(instances.GetOutputDataObject(port).GetNumberOfPolys() > 0)
    return actor


def posed(poses, parts):
    """Each part at its poses."""
    instances = vtkMEAMPoseInstances()
    instances.SetInputDataObject(0, poses)
    for part in parts:
        instances.AddInputDataObject(1, shape_of(part))
    return update(instances)


def legend(copies_made, poses):
    """The best of the poses that are shown in a row: on the colour of the rank how likely the part is there, or the score of a
    pose of which that is not known."""
    ranks = vtk_to_numpy(copies_made.GetPointData().GetArray("Rank")) if copies_made.GetNumberOfPoints() else ()
    shown = [i for i in range(poses.GetNumberOfPoints()) if i + 1 in ranks][:LABELS]
    labels = []
    for column, i in enumerate(shown or [None]):
        label = vtkTextActor()
        label.SetPosition(MARGIN + column * WIDTH // LABELS, MARGIN)
        style = label.GetTextProperty()
        style.SetFontSize(26)
        if i is None:
            label.SetInput("nothing sure found" if poses.GetNumberOfPoints() else "no part found")
        else:
            values = poses.GetPointData()
            place = values.GetArray("PlaceProbability").GetValue(i) if values.HasArray("PlaceProbability") else 0
            label.SetInput(f" {i + 1}: {100 * place:.0f} % " if place > 0 else f" {i + 1}: {values.GetArray('Score').GetValue(i):.2f} ")
            color = copies_made.GetPointData().GetArray("RankColor").GetTuple(int(numpy.argmax(ranks == i + 1)))
            style.SetBackgroundColor([c / 255 for c in color])
            style.SetBackgroundOpacity(1)
            style.SetColor((1, 1, 1) if sum(color) < 420 else (0, 0, 0))
        labels.append(label)
    return labels


def look(camera, points, looks):
    """Turns the camera so that the scene fills the picture; returns the picture's height in pixels."""
    looks = numpy.array(looks, dtype=float)
    up = numpy.array((0, -1, 0) if looks[2] > 0 else (0, 1, 0), dtype=float)
    tilt = numpy.radians(TILT)
    into = numpy.cos(tilt) * looks + numpy.sin(tilt) * up
    into /= numpy.linalg.norm(into)
    right = numpy.cross(into, up)
    right /= numpy.linalg.norm(right)
    up = numpy.cross(right, into)
    # What lies in the bin, not the floor around it; a few stray points may stay outside.
    depths = points @ looks
    near, far = numpy.percentile(depths, (0.2, 99.8))
    points = points[depths <= far - 0.1 * (far - near)]
    low, high = numpy.percentile(points @ numpy.stack((right, up, into), axis=1), (0.2, 99.8), axis=0)
    middle, size = (low + high) / 2, high - low
    focus = middle[0] * right + middle[1] * up + middle[2] * into
    camera.ParallelProjectionOn()
    camera.SetFocalPoint(focus)
    camera.SetPosition(focus - (size[2] + size.max()) * into)
    camera.SetViewUp(up)
    margin = 1.05
    height = int(numpy.clip(WIDTH * size[1] / size[0], WIDTH / 3, WIDTH))
    camera.SetParallelScale(margin / 2 * max(size[1], size[0] * height / WIDTH))
    return height
