# SPDX-License-Identifier: BSD-3-Clause
"""Picks as pictures: the scan, the parts that were found and the gripper at its picks; and a strip of them, a bin from the
first pick to the last."""
import os
import tempfile

import numpy
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkIOImage import vtkPNGWriter

from . import picture, scripting

POSSIBLE, NOT = (0.16, 0.67, 0.2), (0.86, 0.12, 0.12)
TILE = (420, 420)
TILES_IN_ROW = 4
SLANT = (0.35, 0.55, -1.0)  # from where it is looked at, in the sensor's frame


def gripper_actors(gripper):
    """Green where a pick is possible, red where it is not."""
    shown = []
    for value, color in ((1, POSSIBLE), (0, NOT)):
        data = scripting.with_value(gripper, "Possible", value, cells=True)
        if data.GetNumberOfCells():
            actor = picture.solid(data, color)
            actor.GetProperty().SetOpacity(0.85)
            shown.append(actor)
    return shown


def actors(scan, found, mesh, gripper):
    """What a picture of picks shows."""
    points = vtk_to_numpy(scan.GetPoints().GetData())
    valid = numpy.isfinite(points).all(axis=1)
    instances = picture.posed(found, [mesh])
    return [picture.scan(scan, points, valid, (0, 0, 1)), picture.copies(instances), *gripper_actors(gripper)]


def frame(truth, size):
    """A camera that looks into the bin from a side."""
    values = scripting.tuples(truth, "Bin")[0]
    pose, inner = numpy.array(values[:16]).reshape(4, 4), numpy.array(values[16:19])
    corners = numpy.array([(x, y, z) for x in (-0.5, 0.5) for y in (-0.5, 0.5) for z in (0, 1.5)]) * inner
    return picture.frame_of(corners @ pose[:3, :3].T + pose[:3, 3], SLANT, size, (0, -1, 0), 1.15)


class Strip:
    """Tiles of a bin's picks, one after the other."""

    def __init__(self, station):
        self.station, self.folder, self.tiles = station, tempfile.TemporaryDirectory(), []

    def add(self, scan, truth, found, gripper, row):
        path = os.path.join(self.folder.name, f"{len(self.tiles)}.png")
        color = POSSIBLE if row["outcome"] == "success" else NOT
        picture.save_actors(path, actors(scan, found, self.station.mesh, gripper), frame(truth, TILE), TILE,
                            [(f"{row['left']} left: {row['outcome']}", color)])
        self.tiles.append(path)

    def write(self, path):
        """PNG; nothing when there was no pick."""
        if not self.tiles:
            return
        rows = -(-len(self.tiles) // TILES_IN_ROW)
        width, height = TILE[0] * min(len(self.tiles), TILES_IN_ROW), TILE[1] * rows
        pixels = numpy.full((height, width, 3), 255, numpy.uint8)
        for place, tile in enumerate(self.tiles):
            image = scripting.read_image(tile)
            image = vtk_to_numpy(image.GetPointData().GetScalars()).reshape(TILE[1], TILE[0], -1)
            row, column = divmod(place, TILES_IN_ROW)
            low = height - TILE[1] * (row + 1)  # VTK's images start at the lower left
            pixels[low:low + TILE[1], TILE[0] * column:TILE[0] * (column + 1)] = image[:, :, :3]
        writer = vtkPNGWriter()
        writer.SetInputData(scripting.vtk_image(pixels))
        scripting.write_by(writer, path)
