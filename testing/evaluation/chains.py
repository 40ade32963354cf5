# SPDX-License-Identifier: BSD-3-Clause
"""The single filters, connected: the same steps as those of vtkMEAMPoseEstimation, with all their parameters."""
from vtkmodules.vtkCommonDataModel import vtkPolyData

from ppfmeam import evaluation, filters, scripting


def set_preset(algorithm, preset):
    """The parameters of a filter: "paper" or "recommended"."""
    getattr(algorithm, "SetParametersTo" + preset.capitalize())()


def connect(algorithm, port, data):
    """Connects a port to an algorithm's first output, or to a data object; None: to nothing."""
    if data is not None and data.IsA("vtkAlgorithm"):
        algorithm.SetInputConnection(port, data.GetOutputPort())
    else:
        algorithm.SetInputDataObject(port, data)


class Detection:
    """The steps from a scene's edge points to its ranked poses; parameters may be changed before Update()."""

    def __init__(self, model, edges=None, surface=None, preset="recommended", threads=0):
        self.tangents = filters.vtkMEAMTangentEstimation()
        self.detection = filters.vtkMEAMPoseDetection()
        self.screening = filters.vtkMEAMPoseScreening()
        self.candidates = filters.vtkMEAMPoseVerification()
        self.alternatives = filters.vtkMEAMPoseSelection()
        self.refinement = filters.vtkMEAMPoseRefinement()
        self.verification = filters.vtkMEAMPoseVerification()
        self.selection = filters.vtkMEAMPoseSelection()
        self.steps = [self.tangents, self.detection, self.screening, self.candidates, self.alternatives, self.refinement,
                      self.verification, self.selection]
        if preset != "recommended":
            self.steps.remove(self.screening)
            for step in self.steps:
                set_preset(step, "paper")
            if preset == "b2b":
                self.tangents.SetMethodToLineSegments()
            if preset == "ppf":
                self.detection.SetParametersToOriginalPPF()
                self.refinement.SetParametersToRecommended()
            if preset in ("b2b", "ppf"):
                for step in (self.candidates, self.alternatives, self.verification):
                    step.SetParametersToVotes()
        else:
            for step in (self.candidates, self.alternatives):
                step.SetParametersToCandidates()
        for before, step in zip(self.steps, self.steps[1:]):
            step.SetInputConnection(before.GetOutputPort())
        for step in self.steps:
            connect(step, 1, model)
            step.SetNumberOfThreads(threads)
        for step in self.on_poses:
            step.SetInputConnection(2, self.tangents.GetOutputPort())
        self.without_surface = []  # steps that look at the edges alone
        self.set_scene(edges, surface)

    @property
    def on_poses(self):
        """The steps that take poses: they look at the edges and the surface."""
        return self.steps[2:]

    def set_scene(self, edges, surface):
        """The edge points of a scene, and what its sensor measured, or None."""
        connect(self.tangents, 0, edges)
        connect(self.detection, 2, None if self.detection in self.without_surface else surface)
        for step in self.on_poses:
            connect(step, 3, None if step in self.without_surface else surface)

    def set_sensor(self, projection="Automatic", view_direction=(0, 0, -1), position=(0, 0, 0)):
        """Where the scene is seen from, for all steps that ask."""
        self.tangents.SetViewDirection(view_direction)
        for step in (self.detection, *self.on_poses):
            getattr(step, "SetProjectionTo" + projection)()
            step.SetViewDirection(view_direction)
            step.SetSensorPosition(position)


class Evaluation(evaluation.Evaluation):
    """Finds the poses of a scene step by step, with parameters that vtkMEAMPoseEstimation does not have."""

    def __init__(self, model, choose=lambda chain: None, preset="recommended", poses_asked_for=5, threads=0):
        super().__init__(model, poses_asked_for=poses_asked_for, threads=threads)
        self.chain = Detection(model, preset=preset, threads=threads)
        choose(self.chain)

    def find(self, surface, edges):
        self.chain.set_scene(edges, surface)
        poses = vtkPolyData()
        poses.ShallowCopy(scripting.update(self.chain.selection).GetOutput())
        return poses
