# SPDX-License-Identifier: BSD-3-Clause
"""What the scripts that measure share: scenes with their true poses, and the figures over them."""
import argparse
import math
import os
import statistics
import warnings

import numpy
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkPoints
from vtkmodules.vtkCommonDataModel import vtkPolyData

from . import chains, dataset, filters, scripting

# mm. Part 3's STL is in another frame than its true poses.
OFFSETS = {3: (-20.9645, -17.4974, -9.3144)}
FIGURES = {"paper": "PaperRate", "strict": "StrictRate", "top1": "Top1Rate", "recall": "Recall",
           "AP": "AveragePrecision", "AP_mm": "AveragePrecisionMSSD", "recall_99": "RecallAtPrecision99", "mm": "MedianTranslationError", "deg": "MedianRotationError",
           "axis_deg": "MedianAxisError", "roll_deg": "MedianRollError", "mean_mm": "MeanTranslationError",
           "mean_deg": "MeanRotationError"}
# Median score of true poses: on their own scenes 0.84 and more, in simulated bins 0.59 and more; in another bin 0.15 and less,
# of another part 0.17 and less, but of a flat part where another flat one of its size lies up to 0.71.
LEAST_FIT = 0.35
HALF = 0.5  # visible
STAGES = scripting.STAGES[scripting.STAGES.index("Scene"):scripting.STAGES.index("Selection") + 1]
NOISE_HELP = ("normal noise of every coordinate of the scenes' points: mm, or %% of the part's diameter, such as 0.3 or 1%% "
              "(default: %(default)s)")


def numbers(text):
    """1,2,5-7 as a list."""
    result = []
    for item in text.split(","):
        first, _, last = item.partition("-")
        result += range(int(first), int(last or first) + 1)
    return result


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
    """The part of the Tohoku dataset in DIR/Part_P, in the frame of its true poses."""
    return scripting.read_mesh(os.path.join(folder, f"Part_{part}", f"Part_{part}.STL"), OFFSETS.get(part, (0, 0, 0)))


def tohoku_truth(folder, part, scene):
    """The true poses of a scene."""
    path = os.path.join(folder, f"Part_{part}", "Results", f"trans{scene}.txt")
    return scripting.read_with(filters.vtkMEAMPoseReader(), path)


def tohoku_clouds(folder, part, scene):
    """The measured surface and the edge points of a scene."""
    names = (f"Scene{scene}.pcd", f"Scene_boundary{scene}.pcd")
    return tuple(scripting.read(os.path.join(folder, f"Part_{part}", "Scenes", name)) for name in names)


def tohoku_scenes(folder, part, most):
    """Of the first scenes of a part, up to `most`, those of which there is a scan or a file of true poses."""
    folder = os.path.join(folder, f"Part_{part}")
    return [k for k in range(most) if any(os.path.exists(os.path.join(folder, *names)) for names in (
        ("Scenes", f"Scene{k}.pcd"), ("Results", f"trans{k}.txt")))]


def require_found(folder, parts):
    """Raises a Failure when another program has left no poses of a part in a folder."""
    for part in parts:
        if not os.path.isdir(os.path.join(folder, f"Part_{part}")):
            raise scripting.Failure(f"{folder} has no folder Part_{part} with the poses of part {part}")


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


def tohoku_scene(folder, part, scene, model, deviation=0):
    """Of a scene the surface and the edge points, with noise of that deviation (mm), and the true poses with their visibility."""
    surface, edges = tohoku_clouds(folder, part, scene)
    truth = with_visibility(tohoku_truth(folder, part, scene), model, edges, surface)
    return *with_noise((surface, edges), deviation, scene), truth


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


class Chain(Evaluation):
    """Finds the poses of a scene step by step, with parameters that vtkMEAMPoseEstimation does not have."""

    def __init__(self, model, choose, poses_asked_for, threads):
        super().__init__(model, poses_asked_for=poses_asked_for, threads=threads)
        self.chain = chains.Detection(model, threads=threads)
        choose(self.chain)

    def find(self, surface, edges):
        self.chain.set_scene(edges, surface)
        poses = vtkPolyData()
        poses.ShallowCopy(scripting.update(self.chain.selection).GetOutput())
        return poses
