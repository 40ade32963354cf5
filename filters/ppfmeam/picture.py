# SPDX-License-Identifier: BSD-3-Clause
"""A picture of a scan with the part at every pose, in the colours of the ranks."""
import os

import numpy
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkLookupTable, vtkPoints
from vtkmodules.vtkCommonDataModel import vtkPolyData, vtkStructuredGrid
from vtkmodules.vtkFiltersCore import vtkPolyDataNormals
from vtkmodules.vtkFiltersGeneral import vtkVertexGlyphFilter
from vtkmodules.vtkIOImage import vtkPNGWriter
from vtkmodules.vtkRenderingCore import (
    vtkActor, vtkPolyDataMapper, vtkRenderer, vtkRenderWindow, vtkTextActor, vtkWindowToImageFilter)
import vtkmodules.vtkRenderingFreeType  # noqa: F401  the legend's letters
import vtkmodules.vtkRenderingOpenGL2  # noqa: F401

from .filters import vtkMEAMPoseInstances
from .scripting import Failure, update

WIDTH = 1600  # pixels
STRIP = 56  # pixels above the scene, for the legend
MARGIN = 14  # pixels
TILT = 25  # degrees from the sensor's line of sight: shows depth
BACKGROUND = (0.11, 0.12, 0.14)


def require_display():
    """Raises a Failure when pictures cannot be made here."""
    if not os.environ.get("DISPLAY"):
        raise Failure("a picture needs a display: use examples/run.sh, which starts a virtual one, or xvfb-run -a")


def save(path, scene, poses, part, looks=None):
    """Writes a PNG. `part` is the mesh, or the trained model; the sensor `looks` along +z at an organized
    scene and from above, along -z, at any other."""
    require_display()
    if looks is None:
        looks = (0, 0, 1) if isinstance(scene, vtkStructuredGrid) else (0, 0, -1)
    points = vtk_to_numpy(scene.GetPoints().GetData())
    valid = numpy.isfinite(points).all(axis=1)
    instances = vtkMEAMPoseInstances()
    instances.SetInputDataObject(0, poses)
    instances.SetInputDataObject(1, shape_of(part))
    update(instances)

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
    window = vtkRenderWindow()
    window.SetOffScreenRendering(True)
    window.SetMultiSamples(8)
    window.SetSize(WIDTH, height + STRIP)
    window.AddRenderer(renderer)
    window.AddRenderer(strip)
    window.Render()
    grabber = vtkWindowToImageFilter()
    grabber.SetInput(window)
    grabber.ReadFrontBufferOff()
    writer = vtkPNGWriter()
    writer.SetInputConnection(grabber.GetOutputPort())
    writer.SetFileName(path)
    update(writer, "Write")


def shape_of(part):
    """What stands for the part: its mesh, or the surface points of a trained model."""
    if part.IsA("vtkPolyData"):
        return part
    names = [part.GetMetaData(i).Get(part.NAME()) for i in range(part.GetNumberOfPartitionedDataSets())]
    if "Surface" not in names:
        raise Failure("the model has no surface to draw: give the CAD file, too")
    return part.GetPartition(names.index("Surface"), 0)


def scan(scene, points, valid, looks):
    """The scan's points: in their grey values, or the nearer to the sensor the brighter."""
    values = scene.GetPointData().GetArray("Intensity")
    if values:
        values = vtk_to_numpy(values)[valid].astype(float)
    else:
        values = -points[valid] @ numpy.array(looks, dtype=float)
    data, coordinates = vtkPolyData(), vtkPoints()
    coordinates.SetData(numpy_to_vtk(points[valid], deep=True))
    data.SetPoints(coordinates)
    data.GetPointData().SetScalars(numpy_to_vtk(values, deep=True))
    vertices = vtkVertexGlyphFilter()
    vertices.SetInputData(data)
    grey = vtkLookupTable()
    grey.SetHueRange(0, 0)
    grey.SetSaturationRange(0, 0)
    grey.SetValueRange(0.3, 0.8)
    mapper = vtkPolyDataMapper()
    mapper.SetInputConnection(vertices.GetOutputPort())
    mapper.SetLookupTable(grey)
    mapper.SetScalarRange(*numpy.percentile(values, (1, 99)))
    actor = vtkActor()
    actor.SetMapper(mapper)
    actor.GetProperty().SetPointSize(float(numpy.clip(WIDTH / len(values) ** 0.5, 2, 5)))
    actor.GetProperty().LightingOff()
    return actor


def copies(instances):
    """The part at every pose, drawn over scan points that lie on its surface."""
    normals = vtkPolyDataNormals()
    normals.SetInputConnection(instances.GetOutputPort())
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
    actor.GetProperty().SetLighting(instances.GetOutput().GetNumberOfPolys() > 0)
    return actor


def legend(copies_made, poses):
    """The best poses in a row: rank and score on the colour of the rank."""
    ranks = vtk_to_numpy(copies_made.GetPointData().GetArray("Rank")) if poses.GetNumberOfPoints() else ()
    shown = min(poses.GetNumberOfPoints(), 6)
    labels = []
    for i in range(max(shown, 1)):
        label = vtkTextActor()
        label.SetPosition(MARGIN + i * WIDTH // 6, MARGIN)
        style = label.GetTextProperty()
        style.SetFontSize(26)
        if shown == 0:
            label.SetInput("no part found")
        else:
            score = poses.GetPointData().GetArray("Score").GetValue(i)
            label.SetInput(f" rank {i + 1}:  {score:.2f} ")
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
