# SPDX-License-Identifier: BSD-3-Clause
"""ParaView's writer of pages, xml/PageWriter.xml: of what MEAM Pose Estimation found, the page that `detect --report` makes."""
import os

import paraview.modules.vtkPVVTKExtensionsIOCore  # noqa: F401  wraps ParaView's reader of series, which knows its file
from vtkmodules.util.vtkAlgorithm import VTKPythonAlgorithmBase
from vtkmodules.vtkCommonCore import vtkOutputWindow
from vtkmodules.vtkParallelCore import vtkMultiProcessController

from .. import inputs, scripting
from . import page
from .content import Part
from .told import Told


class PageWriter(VTKPythonAlgorithmBase):
    """Writes the page of a vtkMEAMPoseEstimation that its input comes from."""

    def __init__(self):
        super().__init__(nInputPorts=1, nOutputPorts=0, inputType="vtkPolyData")
        self.path = None

    def SetFileName(self, path):
        self.path = path

    def GetFileName(self):
        return self.path

    def Write(self):
        """What goes wrong is an error of ParaView's. Of several processes the first one has all data."""
        if vtkMultiProcessController.GetGlobalController().GetLocalProcessId() > 0:
            return
        try:
            write(self, self.path)
        except scripting.Failure as failure:
            vtkOutputWindow.GetInstance().DisplayErrorText(f"{failure}\n")


def write(algorithm, path):
    page.require(path)
    scripting.require_folder_of(path)
    found = next((filter for filter in scripting.upstream(algorithm) if filter.IsA("vtkMEAMPoseEstimation")), None)
    if not found:
        raise scripting.Failure(f"{path} was not written: a page is of what MEAM Pose Estimation found; select that first")
    data = [[found.GetInputDataObject(port, k) for k in range(found.GetNumberOfInputConnections(port))] for port in range(4)]
    parts, (scan,), boundary, image = data[0], data[1], *((given or [None])[0] for given in data[2:])
    poses, camera = found.GetOutputDataObject(0), found.GetCameraFile() if image else None
    told = Told.of_filter(found, name_of(found.GetInputAlgorithm(1, 0)), poses, parts, (scan, boundary, image))
    shown = [Part(name, shape_of(part, found)) for name, part in zip(told.names, parts)]
    page.write(path, page.html(inputs.scan_of(scan, image=image, image_camera=camera), poses, shown, told))


def name_of(source):
    """Of the file or folder that a scan comes from."""
    readers = [getattr(filter, "GetCurrentFileName", None) or getattr(filter, "GetFileName", None) for filter in scripting.upstream(source)]
    paths = filter(None, (name() for name in readers if name))
    return next((os.path.basename(path.rstrip("/")) for path in paths), "a scan")


def shape_of(part, found):
    """Its mesh in mm, or the points of a trained model."""
    return scripting.prepare_mesh(part, found.GetCADOffset(), found.GetCADScale()) if part.IsA("vtkPolyData") else scripting.shape_of(part)
