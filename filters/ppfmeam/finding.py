# SPDX-License-Identifier: BSD-3-Clause
"""The copies of one part, or of several, in scan after scan."""
from . import choices, filters, regions, scripting


class Finder:
    """Holds the parts, trained models or their meshes, and the options of a script that detects."""

    def __init__(self, parts, options):
        self.estimation = filters.vtkMEAMPoseEstimation()
        for part in parts:
            self.estimation.AddInputDataObject(0, part)
        choices.of_options("detect", options).set(self.estimation)
        scripting.set_viewpoint(self.estimation, options.viewpoint, options.scene_scale)
        box, self.mask = regions.of(options.roi)
        self.estimation.SetRegion(*(box or regions.EVERYWHERE))

    def find(self, scene, boundary=None, image=None, image_camera=None):
        """The poses in a scan, best first, with the times; of several parts `PartId` tells which. They are good until the next
        scan."""
        self.estimation.SetInputDataObject(1, regions.masked(scene, self.mask))
        self.estimation.SetInputDataObject(2, boundary)
        self.estimation.SetInputDataObject(3, image)
        self.estimation.SetCameraFile(image_camera if image else None)
        return scripting.update(self.estimation).GetOutput()
