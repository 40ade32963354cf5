# SPDX-License-Identifier: BSD-3-Clause
"""Scenes with their true poses: those of the Tohoku University 6D Pose Estimation Dataset, DIR/Part_P/{Part_P.STL, Scenes,
Results}, and simulated bins of the sample parts, kept in files for further runs where that is wanted."""
import argparse
import math
import os

import numpy
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkPoints
from vtkmodules.vtkCommonDataModel import vtkStructuredGrid
from vtkmodules.vtkIOXML import vtkXMLPolyDataReader, vtkXMLPolyDataWriter, vtkXMLStructuredGridReader, vtkXMLStructuredGridWriter

from ppfmeam import evaluation, filters, scripting, simulation

OFFSETS = {3: (-20.9645, -17.4974, -9.3144)}  # mm: that part's STL is in another frame than its true poses
TOHOKU = (1, 2, 3)
PARTS = ("ribbed_flange", "ridged_disc", "arc_lever", "flap", "hole_plate", "pipe_elbow", "cap", "knob", "handle")
NOISE_HELP = "normal noise of every coordinate of the scenes' points: mm, or % of the part's diameter, such as 0.3 or 1%"


def noise(text):
    """0.3 (mm) or 1% (of a part's diameter): a function of the diameter in mm that returns the deviation in mm."""
    try:
        amount = float(text.removesuffix("%"))
    except ValueError:
        amount = -1
    if not 0 <= amount < math.inf:
        raise argparse.ArgumentTypeError(f"noise is a number of mm or a percentage, 0 or more, not {text}")
    return lambda diameter: amount / 100 * diameter if text.endswith("%") else amount


def tohoku_mesh(folder, part):
    """The part of the dataset, in the frame of its true poses."""
    return scripting.read_mesh(os.path.join(folder, f"Part_{part}", f"Part_{part}.STL"), OFFSETS.get(int(part), (0, 0, 0)))


def tohoku_truth(folder, part, scene):
    """The true poses of a scene."""
    return scripting.read_with(filters.vtkMEAMPoseReader(), os.path.join(folder, f"Part_{part}", "Results", f"trans{scene}.txt"))


def tohoku_clouds(folder, part, scene):
    """The measured surface and the edge points of a scene."""
    names = (f"Scene{scene}.pcd", f"Scene_boundary{scene}.pcd")
    return tuple(scripting.read(os.path.join(folder, f"Part_{part}", "Scenes", name)) for name in names)


def tohoku_scenes(folder, part, most):
    """Of the first scenes of a part, up to `most`, those of which there is a scan or a file of true poses."""
    folder = os.path.join(folder, f"Part_{part}")
    return [k for k in range(most) if any(os.path.exists(os.path.join(folder, *names)) for names in (
        ("Scenes", f"Scene{k}.pcd"), ("Results", f"trans{k}.txt")))]


def tohoku_scene(folder, part, scene, model, deviation=0):
    """Of a scene the surface and the edge points, with noise of that deviation (mm), and the true poses with their visibility."""
    surface, edges = tohoku_clouds(folder, part, scene)
    truth = evaluation.with_visibility(tohoku_truth(folder, part, scene), model, edges, surface)
    return *with_noise((surface, edges), deviation, scene), truth


def with_noise(clouds, deviation, seed):
    """The clouds with normal noise of every coordinate, of `deviation` (mm)."""
    random, noisy = numpy.random.default_rng(seed), []
    for cloud in clouds:
        places = vtk_to_numpy(cloud.GetPoints().GetData())
        places = places + random.normal(0.0, deviation, places.shape) if deviation else places
        noisy.append(cloud.NewInstance())
        noisy[-1].ShallowCopy(cloud)
        noisy[-1].SetPoints(vtkPoints())
        noisy[-1].GetPoints().SetData(numpy_to_vtk(places.astype(numpy.float32), deep=True))
    return noisy


def require_found(folder, parts):
    """Raises a Failure when another program has left no poses of a part in a folder."""
    for part in parts:
        if not os.path.isdir(os.path.join(folder, f"Part_{part}")):
            raise scripting.Failure(f"{folder} has no folder Part_{part} with the poses of part {part}")


def part_mesh(name):
    """The mesh of a sample part."""
    source = filters.vtkMEAMSamplePartSource()
    scripting.set_choice(source, "Part", simulation.camel(name))
    return scripting.prepare_mesh(scripting.update(source).GetOutput())


def bin_source(mesh, copies, seed=1, sensor=simulation.SENSORS[0], **properties):
    """A source of a simulated bin."""
    source = filters.vtkMEAMBinSceneSource()
    source.SetInputDataObject(mesh)
    simulation.set_sensor(source, sensor)
    for name, value in {"Copies": copies, "Seed": seed, **properties}.items():
        getattr(source, "Set" + name)(value)
    return source


def outputs_of(source, *ports):
    """Copies of what a source returns at these ports, which stay when it runs again."""
    scripting.update(source)
    copies = []
    for port in ports:
        copies.append(source.GetOutputDataObject(port).NewInstance())
        copies[-1].ShallowCopy(source.GetOutputDataObject(port))
    return copies


def without_bin(scan):
    """The scan with nothing but the parts."""
    result = vtkStructuredGrid()
    result.DeepCopy(scan)
    vtk_to_numpy(result.GetPoints().GetData())[vtk_to_numpy(scan.GetPointData().GetArray("Instance")) < 0] = numpy.nan
    return result


def pixels_of(points, scan):
    """Column and row of the pixel in which the sensor sees each point, and whether it is in the image."""
    size = [0, 0, 0]
    scan.GetDimensions(size)
    fx, _, cx, _, fy, cy, _, _, _ = scan.GetFieldData().GetArray("CameraMatrix").GetTuple(0)
    x, y, z = points.T
    column, row = (numpy.rint(value).astype(int) for value in (fx * x / z + cx, fy * y / z + cy))
    return column, row, (column >= 0) & (row >= 0) & (column < size[0]) & (row < size[1])


class Bins:
    """Scans of bins with copies of a sample part, and their true poses; read from `folder`, when there is one, where an earlier
    run has left them."""

    def __init__(self, folder=None):
        self.folder, self.last = folder, {}
        if folder:
            scripting.make_folder(folder)

    def scene(self, part, sensor, copies, seed):
        """The scan and the true poses of a bin. The last two bins are remembered."""
        name = f"{part}_{sensor}_{copies}_{seed}"
        if name not in self.last:
            self.last = dict([*self.last.items()][-1:])
            self.last[name] = self.read(name) or self.simulate(name, part, sensor, copies, seed)
        return self.last[name]

    def read(self, name):
        """A bin's files; None where they are not there."""
        paths = self.paths(name)
        if not paths or not all(map(os.path.exists, paths)):
            return None
        return tuple(scripting.read_with(reader(), path)
                     for reader, path in zip((vtkXMLStructuredGridReader, vtkXMLPolyDataReader), paths))

    def simulate(self, name, part, sensor, copies, seed):
        scene = outputs_of(bin_source(part_mesh(part), int(copies), int(seed), sensor), 0, 1)
        # The scan last: with it the bin is whole.
        for writer, path, data in reversed([*zip((vtkXMLStructuredGridWriter(), vtkXMLPolyDataWriter()), self.paths(name),
                                                 scene)]):
            writer.SetInputData(data)
            writer.SetDataModeToBinary()
            scripting.write_by(writer, path)
        return scene

    def paths(self, name):
        """Of the scan and of the true poses; none without a folder."""
        return tuple(os.path.join(self.folder, name + extension) for extension in (".vts", ".vtp")) if self.folder else ()
