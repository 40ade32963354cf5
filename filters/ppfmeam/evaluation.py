# SPDX-License-Identifier: BSD-3-Clause
"""Poses of scene after scene beside the true ones, and the figures over them."""
import argparse
import math
import statistics
import warnings

from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkCommonDataModel import vtkPolyData

from . import dataset, filters, scripting

FIGURES = {"paper": "PaperRate", "strict": "StrictRate", "top1": "Top1Rate", "recall": "Recall",
           "AP": "AveragePrecision", "AP_mm": "AveragePrecisionMSSD", "recall_99": "RecallAtPrecision99", "mm": "MedianTranslationError", "deg": "MedianRotationError",
           "axis_deg": "MedianAxisError", "roll_deg": "MedianRollError", "mean_mm": "MeanTranslationError",
           "mean_deg": "MeanRotationError"}
# Median score of true poses: on their own scenes 0.84 and more, in simulated bins 0.59 and more; in another bin 0.15 and less,
# of another part 0.17 and less, but of a flat part where another flat one of its size lies up to 0.71.
LEAST_FIT = 0.35
HALF = 0.5  # visible
STAGES = scripting.STAGES[scripting.STAGES.index("Scene"):scripting.STAGES.index("Selection") + 1]


def numbers(text):
    """1,2,5-7 as a list, as argparse wants it."""
    result = []
    for item in text.split(","):
        first, dash, last = item.partition("-")
        if not first.isdecimal() or dash and not last.isdecimal() or int(last or first) < int(first):
            raise argparse.ArgumentTypeError(f"it has to be whole numbers such as 1,5-7, not {text}")
        result += range(int(first), int(last or first) + 1)
    return result


def half_visible(truth):
    """The true poses by which others are told from those of another scene: of what is hidden a score says little. All of
    them where the dataset does not know what is."""
    visible = truth.GetPointData().GetArray("VisibleFraction")
    known = visible and visible.GetRange()[1] > 0
    return dataset.points_between(truth, "VisibleFraction", HALF, math.inf) if known else truth


def with_visibility(truth, model, edges, surface):
    """The true poses with the share of each instance that nothing hides. Raises a Failure when they are not of this scene."""
    tangents = filters.vtkMEAMTangentEstimation()
    tangents.SetInputDataObject(edges)
    tangents.SetInputDataObject(1, model)
    verification = filters.vtkMEAMPoseVerification()
    for port, data in enumerate((truth, model, scripting.update(tangents).GetOutputDataObject(0), surface)):
        verification.SetInputDataObject(port, data)
    poses = scripting.update(verification).GetOutput()
    scores = scripting.column(poses, "Score")
    if len(scores) and statistics.median(scores) < LEAST_FIT:
        raise scripting.Failure(f"the true poses fit {100 * statistics.median(scores):.0f} % of what should be seen of them (median): they "
                                "are of another part or another scene")
    return poses


def scene_edges(scan, image=None, camera=None):
    """The edge points of a scan by its image, or by that of a camera beside it."""
    extraction = filters.vtkMEAMSceneEdgeExtraction()
    extraction.SetInputDataObject(scan)
    extraction.SetInputDataObject(1, image)
    extraction.SetCameraFile(camera if image else None)
    extraction.SetImageEdges(image is not None or scripting.has_image(scan))
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")  # detection says the same
        return scripting.update(extraction).GetOutput()


class Evaluation:
    """Finds the poses of scene after scene with a trained model and compares them with the true ones."""

    def __init__(self, model, preset="recommended", poses_asked_for=5, threads=0, references=0, features="both", mesh=None):
        self.estimation = filters.vtkMEAMPoseEstimation()
        self.estimation.SetInputDataObject(model)
        scripting.set_preset(self.estimation, preset)
        scripting.set_choice(self.estimation, "Features", features)
        self.estimation.SetMaximumNumberOfPoses(0)  # those beyond the poses asked for matter for recall and AP
        self.estimation.SetNumberOfThreads(threads)
        self.estimation.SetReferenceShare(references)
        self.model, self.mesh, self.poses_asked_for = model, mesh, poses_asked_for
        self.judge = self.new_judge()
        self.times = []

    def new_judge(self):
        """What judges poses, without any scene."""
        judge = filters.vtkMEAMPoseEvaluation()
        judge.SetDiameter(scripting.field(self.model, "Diameter"))
        judge.SetPosesAskedFor(self.poses_asked_for)
        judge.SetInputDataObject(2, self.model)  # its symmetries
        judge.SetInputDataObject(3, self.mesh)
        return judge

    def find(self, surface, edges=None, image=None, camera=None):
        """The poses in a scene, best first; without edges those of its image, or of an image that a camera beside
        the sensor took, with that camera's calibration file."""
        self.estimation.SetInputDataObject(1, surface)
        self.estimation.SetInputDataObject(2, edges)
        self.estimation.SetInputDataObject(3, image)
        self.estimation.SetCameraFile(camera if image else None)
        poses = vtkPolyData()
        poses.ShallowCopy(scripting.update(self.estimation).GetOutput())
        self.times.append({stage: 1000 * scripting.field(poses, "Seconds" + stage) for stage in scripting.STAGES})
        return poses

    def add(self, poses, truth):
        """A scene, its poses found and its true ones."""
        self.judge.AddInputDataObject(0, poses)
        self.judge.AddInputDataObject(1, truth)

    def judged_image(self, poses, truth):
        """Of one image the columns of vtkMEAMPoseEvaluation, by name: of each pose, and of each true instance."""
        judge = self.new_judge()
        judge.SetInputDataObject(0, poses)
        judge.SetInputDataObject(1, truth)
        tables = [scripting.update(judge).GetOutputDataObject(port) for port in range(2)]
        return [{table.GetColumnName(k): vtk_to_numpy(table.GetColumn(k)) for k in range(table.GetNumberOfColumns())} for table in tables]

    def judged(self, name):
        """A column of vtkMEAMPoseEvaluation, of each pose, scene by scene."""
        return vtk_to_numpy(scripting.update(self.judge).GetOutput().GetColumnByName(name))

    def right(self):
        """Whether each pose is right, 1 or 0, scene by scene."""
        return self.judged("Right")

    def figures(self):
        """Over all scenes: how many poses were judged, FIGURES (AP_mm with a mesh), and the median ms of a scene and its
        stages."""
        def median(of):
            return statistics.median(of(times) for times in self.times) if self.times else float("nan")

        table = scripting.update(self.judge).GetOutput()
        row = {"poses": int(scripting.field(table, "Poses"))}
        row.update((name, scripting.field(table, array)) for name, array in FIGURES.items()
                   if table.GetFieldData().HasArray(array))
        row["ms"] = median(lambda times: times["Total"] - times["Training"])
        row.update((f"{stage}_ms", median(lambda times: times[stage])) for stage in STAGES)
        return row
