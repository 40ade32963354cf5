# SPDX-License-Identifier: BSD-3-Clause
"""The copies of one part, or of several, in scan after scan."""
from . import choices, filters, scripting


class Finder:
    """Holds the parts, trained models or of a single one its mesh, and the options of a script that detects."""

    def __init__(self, parts, options):
        self.parts, self.options = parts, options
        self.estimations = [self.estimation_of(part) for part in parts]

    def estimation_of(self, part):
        estimation = filters.vtkMEAMPoseEstimation()
        estimation.SetInputDataObject(part)
        choices.of_options("detect", self.options).set(estimation)
        if len(self.parts) > 1:
            estimation.SetMaximumNumberOfPoses(0)  # conflicts decide which poses stay
            estimation.SetTimeLimit(estimation.GetTimeLimit() / len(self.parts))
        return estimation

    def find(self, scene, boundary=None, image=None, image_camera=None):
        """The poses in a scan, best first; of several parts `PartId` tells which. They are good until the next scan."""
        for estimation in self.estimations:
            estimation.SetInputDataObject(1, scene)
            estimation.SetInputDataObject(2, boundary)
            estimation.SetInputDataObject(3, image)
            estimation.SetCameraFile(image_camera if image else None)
            scripting.update(estimation)
        if len(self.parts) == 1:
            return self.found()[0]
        edges = self.estimations[0].GetOutputDataObject(1)
        options = self.options
        return scripting.resolve_conflicts(self.found(), self.parts, scene, edges, options.preset, options.poses,
                                           options.threads)

    def found(self):
        """Of each part the poses that it has alone, which know the times."""
        return [estimation.GetOutput() for estimation in self.estimations]
