# SPDX-License-Identifier: BSD-3-Clause
"""Reads datasets in the form of the BOP benchmark, and writes results as the benchmark wants them."""
import csv
import os

import numpy
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkCommonDataModel import vtkPolyData, vtkStructuredGrid
from vtkmodules.vtkCommonExecutionModel import vtkStreamingDemandDrivenPipeline
from vtkmodules.vtkFiltersCore import vtkThresholdPoints

from . import filters, scripting

BESIDE = ("rgb_beside", "gray_beside")  # images of the camera of image_camera.json, where the sensor has none


def points_where(points, name, value):
    """Those whose array has the value."""
    return points_between(points, name, value, value)


def points_between(points, name, least, most):
    """Those whose array has a value from `least` to `most`."""
    if not points.GetNumberOfPoints():
        return points
    threshold = vtkThresholdPoints()
    threshold.SetInputData(points)
    threshold.SetInputArrayToProcess(0, 0, 0, vtkPolyData.FIELD_ASSOCIATION_POINTS, name)
    threshold.ThresholdBetween(least, most)
    return scripting.update(threshold).GetOutput()


class Image:
    """An image of a dataset: the organized scan, the true poses of all objects, and the image that a camera beside the
    sensor took, or None."""

    def __init__(self, scan, truth, folder):
        self.scan, self.truth = vtkStructuredGrid(), vtkPolyData()
        self.scan.ShallowCopy(scan)
        self.truth.ShallowCopy(truth)
        self.scene, self.number = (int(scripting.field(scan, name)) for name in ("SceneId", "ImageId"))
        paths = (os.path.join(folder, kind, f"{self.number:06d}.png") for kind in BESIDE)
        path = next(filter(os.path.exists, paths), None)
        self.beside = scripting.read_image(path) if path else None

    def truth_of(self, number):
        """The true poses of an object; no points where it is not in the image or nothing is known of it."""
        return points_where(self.truth, "ObjectId", number)


class Dataset:
    """The folder of a dataset: models/, and the scenes of a split."""

    def __init__(self, path, split="test"):
        self.path, self.split = path, os.path.join(path, split)
        if not os.path.isdir(self.split):
            raise scripting.Failure(f"{path} has no folder {split}: give a BOP dataset, and the --split of it to use")

    def objects(self):
        """The numbers of all objects in models/."""
        models = os.path.join(self.path, "models")
        names = os.listdir(models) if os.path.isdir(models) else ()
        numbers = sorted(int(name[4:-4]) for name in names if name[:4] + name[-4:] == "obj_.ply" and name[4:-4].isdigit())
        if not numbers:
            raise scripting.Failure(f"{models} has no obj_000001.ply or other object")
        return numbers

    def mesh_file(self, number):
        """The path of an object's mesh."""
        return os.path.join(self.path, "models", f"obj_{number:06d}.ply")

    def mesh(self, number):
        """The mesh of an object."""
        return scripting.read_mesh(self.mesh_file(number))

    def train(self, number, preset, features="both"):
        """The trained model of an object, with the symmetries of models_info.json where that knows it."""
        training = scripting.Training(self.mesh(number), preset, features)
        info = os.path.join(self.path, "models", "models_info.json")
        if str(number) in (scripting.read_json(info) if os.path.exists(info) else ()):
            training.symmetries.SetModelsInfoFile(info)
            training.symmetries.SetObjectId(number)
        return training.model()

    def beside(self):
        """The calibration of the camera beside the sensor, or None."""
        path = os.path.join(self.path, "image_camera.json")
        return path if os.path.exists(path) else None

    def scenes(self):
        """The numbers of all scenes."""
        return sorted(int(name) for name in os.listdir(self.split) if name.isdigit())

    def scene(self, number):
        """A scene by its number."""
        return Scene(os.path.join(self.split, f"{number:06d}"))


class Scene:
    """The images of a scene: one for each of its `steps`."""

    def __init__(self, folder):
        self.folder = folder
        self.reader = filters.vtkMEAMBOPReader()
        self.reader.SetFileName(folder)
        scripting.update(self.reader, "UpdateInformation")
        steps = self.reader.GetOutputInformation(0).Get(vtkStreamingDemandDrivenPipeline.TIME_STEPS())
        self.steps = steps or (0,)  # reading it says what is wrong with a scene that has none

    def image(self, step):
        """The image of a step."""
        scripting.update(self.reader, "UpdateTimeStep", step)
        return Image(self.reader.GetOutputDataObject(0), self.reader.GetOutputDataObject(1), self.folder)


def image_at(path):
    """The dataset and the image of DIR/SPLIT/SSSSSS/IIIIII; None for a path of another kind."""
    folder, number = os.path.split(os.path.normpath(path))
    split, scene = os.path.split(folder)
    cameras = os.path.join(folder, "scene_camera.json")
    if not (number.isdecimal() and scene.isdecimal() and os.path.exists(cameras)):
        return None
    numbers = sorted(map(int, scripting.read_json(cameras)))
    if int(number) not in numbers:
        raise scripting.Failure(f"{folder} has no image {int(number)}: its images are {', '.join(map(str, numbers))}")
    data = Dataset(os.path.dirname(split) or ".", os.path.basename(split))
    return data, data.scene(int(scene)).image(numbers.index(int(number)))


BOP_FIGURES = ("ADD", "ADI", "MSSD", "MSPD", "VSD")


class BOPFigures:
    """Recalls of a part over images as the benchmark measures them."""

    def __init__(self, mesh, model):
        self.judge = filters.vtkMEAMBOPEvaluation()
        self.judge.SetInputDataObject(2, mesh)
        self.judge.SetInputDataObject(4, model)
        self.targets = 0
        self.found = {name: [] for name in BOP_FIGURES}  # of each image, at each threshold

    def add(self, poses, truth, scan):
        """The poses found in an image and the true ones."""
        self.judge.SetInputDataObject(0, poses)
        self.judge.SetInputDataObject(1, truth)
        self.judge.SetInputDataObject(3, scan)
        table = scripting.update(self.judge).GetOutput()
        self.targets += int(scripting.field(table, "Targets"))
        for name, counts in self.found.items():
            column = table.GetColumnByName(name)
            counts.append([column.GetValue(k) for k in range(column.GetNumberOfTuples())])

    def recalls(self):
        """In %: ADD and ADI at a tenth of the diameter, MSSD, MSPD and VSD as means over ten thresholds, and AR, the mean
        of these three; none where no copy had to be found."""
        if not self.targets:
            return {}
        sums = {name: [sum(counts) for counts in zip(*images)] for name, images in self.found.items()}
        recalls = {name: 100 * (at[1] if name in ("ADD", "ADI") else sum(at) / len(at)) / self.targets
                   for name, at in sums.items()}
        recalls["AR"] = sum(recalls[name] for name in ("MSSD", "MSPD", "VSD")) / 3
        return recalls

    def row(self, precision):
        """BIN_FIGURES as words, with the AP at 2 to 20 mm; empty ones where no copy had to be found."""
        if not self.targets:
            return {"targets": 0}
        return {"targets": self.targets, **{name: f"{value:.2f}" for name, value in self.recalls().items()},
                "AP2-20": f"{precision:.2f}"}


def stored_poses(path):
    """The poses of a scene that another program has left in a file, best first; none where there is no file, or an empty
    one. Where they have no scores, the first of every scene are the likeliest."""
    if not os.path.exists(path) or not os.path.getsize(path):
        return vtkPolyData()
    poses = scripting.read_with(filters.vtkMEAMPoseReader(), path)
    if not poses.GetPointData().HasArray("Score"):
        poses.GetPointData().AddArray(scripting.vtk_array(1 / numpy.arange(1.0, poses.GetNumberOfPoints() + 1), "Score"))
    return poses


def by_score(poses):
    """The poses, best first."""
    arrays = poses.GetPointData()
    if not arrays.HasArray("Score"):
        return poses
    order = numpy.argsort(-vtk_to_numpy(arrays.GetArray("Score")), kind="stable")
    result = vtkPolyData()
    result.SetPoints(scripting.vtk_points(vtk_to_numpy(poses.GetPoints().GetData())[order]))
    for k in range(arrays.GetNumberOfArrays()):
        result.GetPointData().AddArray(scripting.vtk_array(vtk_to_numpy(arrays.GetArray(k))[order], arrays.GetArrayName(k)))
    return result


BIN_FIGURES = ("targets", *BOP_FIGURES, "AR", "AP2-20")  # of a bin; AP2-20 by the ranks in this bin alone


def mean_of(rows, name):
    """One of BIN_FIGURES over bins, by their targets; None without any."""
    counted = [(int(row["targets"]), float(row[name])) for row in rows if row[name] != ""]
    targets = sum(count for count, _ in counted)
    return sum(count * figure for count, figure in counted) / targets if targets else None


class Found:
    """The poses that another program has found in the images of a dataset: a file of BOP results, or a folder of files
    obj_OOOOOO/SSSSSS_IIIIII.txt of 16 numbers each, best first; none where there is no file."""

    def __init__(self, path, objects):
        self.folder, self.all = path, None
        if not os.path.isdir(path):
            self.folder, self.all = None, scripting.read_with(filters.vtkMEAMPoseReader(), path)
            known = set(vtk_to_numpy(self.all.GetPointData().GetArray("ObjectId"))) if self.all.GetNumberOfPoints() else set()
        else:
            known = {number for number in objects if os.path.isdir(self.folder_of(number))}
        if not known.intersection(objects):
            raise scripting.Failure(f"{path} has no poses of object {', '.join(map(str, objects))}: "
                                    + ("it needs folders such as obj_000001" if self.folder else
                                       f"its objects are {', '.join(map(str, sorted(known))) or 'none'}"))

    def folder_of(self, number):
        return os.path.join(self.folder, f"obj_{number:06d}")

    def poses(self, image, number):
        """Of an object in an image."""
        if self.folder:
            return stored_poses(os.path.join(self.folder_of(number), f"{image.scene:06d}_{image.number:06d}.txt"))
        poses = self.all
        for name, value in (("SceneId", image.scene), ("ImageId", image.number), ("ObjectId", number)):
            poses = points_where(poses, name, value)
        return by_score(poses)


class Results:
    """A file of results, written as the rows come."""

    def __init__(self, file):
        self.writer = csv.writer(file, lineterminator="\n")
        self.writer.writerow(("scene_id", "im_id", "obj_id", "score", "R", "t", "time"))

    def add(self, image, found, most):
        """The poses of each object (number, poses best first) in an image, no more than `most` of each; 0: all. The score is the
        probability, by which poses of all images can be ordered, where that is known."""
        seconds = sum(scripting.field(poses, "SecondsTotal") - scripting.field(poses, "SecondsTraining")
                      for poses in found.values())
        for number, poses in found.items():
            scores, probabilities, transforms = (poses.GetPointData().GetArray(name)
                                                 for name in ("Score", "Probability", "Transform"))
            count = poses.GetNumberOfPoints()
            for i in range(min(count, most) if most else count):
                T = transforms.GetTuple(i)
                R, t = (*T[0:3], *T[4:7], *T[8:11]), (T[3], T[7], T[11])
                self.writer.writerow((image.scene, image.number, number, repr(probabilities and probabilities.GetValue(i) or scores.GetValue(i)),
                                      " ".join(map(repr, R)), " ".join(map(repr, t)), repr(seconds)))
