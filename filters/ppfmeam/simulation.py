# SPDX-License-Identifier: BSD-3-Clause
"""Simulated bins by the names of parts and sensors, kept in files for further runs where that is wanted."""
import os

from vtkmodules.vtkCommonDataModel import vtkPolyData, vtkStructuredGrid
from vtkmodules.vtkIOXML import (vtkXMLPolyDataReader, vtkXMLPolyDataWriter, vtkXMLStructuredGridReader,
                                 vtkXMLStructuredGridWriter)

from . import filters, scripting

PARTS = ("ribbed_flange", "ridged_disc", "arc_lever", "flap", "hole_plate", "pipe_elbow", "cap", "knob", "handle")
SENSORS = ("structured-light", "active-stereo", "time-of-flight")


def camel(name):
    """ribbed_flange or time-of-flight as RibbedFlange, TimeOfFlight."""
    return "".join(word.capitalize() for word in name.replace("-", "_").split("_"))


def part_mesh(name):
    """The mesh of a sample part."""
    source = filters.vtkMEAMSamplePartSource()
    scripting.set_choice(source, "Part", camel(name))
    return scripting.prepare_mesh(scripting.update(source).GetOutput())


def add_sensor_argument(parser):
    parser.add_argument("--sensor", choices=SENSORS, default=SENSORS[0],
                        help="what measures the depth (default: %(default)s)")


def set_sensor(source, name):
    """Sets the sensor of a vtkMEAMBinSceneSource."""
    scripting.set_choice(source, "Sensor", camel(name))


class Bins:
    """Scans of bins with copies of a sample part, and their true poses; read from `folder`, when there is one, where an
    earlier run has left them."""

    def __init__(self, copies, folder=None):
        self.copies, self.folder, self.last = copies, folder, {}
        if folder:
            scripting.make_folder(folder)

    def scene(self, part, sensor, seed):
        """The scan and the true poses of a bin. The last two bins are remembered."""
        name = f"{part}_{sensor}_{self.copies}_{seed}"
        if name not in self.last:
            self.last = dict([*self.last.items()][-1:])
            self.last[name] = self.read(name) or self.simulate(name, part, sensor, seed)
        return self.last[name]

    def read(self, name):
        """A bin's files; None where they are not there."""
        paths = self.paths(name)
        if not paths or not all(map(os.path.exists, paths)):
            return None
        return tuple(scripting.read_with(reader(), path)
                     for reader, path in zip((vtkXMLStructuredGridReader, vtkXMLPolyDataReader), paths))

    def simulate(self, name, part, sensor, seed):
        source = filters.vtkMEAMBinSceneSource()
        source.SetInputDataObject(part_mesh(part))
        source.SetCopies(self.copies)
        source.SetSeed(seed)
        set_sensor(source, sensor)
        scripting.update(source)
        scan, truth = vtkStructuredGrid(), vtkPolyData()
        for port, data in enumerate((scan, truth)):
            data.ShallowCopy(source.GetOutputDataObject(port))
        # The scan last: with it the bin is whole.
        for writer, path, data in reversed([*zip((vtkXMLStructuredGridWriter(), vtkXMLPolyDataWriter()), self.paths(name),
                                                 (scan, truth))]):
            writer.SetInputData(data)
            writer.SetDataModeToBinary()
            scripting.write_by(writer, path)
        return scan, truth

    def paths(self, name):
        """Of the scan and of the true poses; none without a folder."""
        return tuple(os.path.join(self.folder, name + extension) for extension in (".vts", ".vtp")) if self.folder else ()
