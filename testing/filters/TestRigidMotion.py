# SPDX-License-Identifier: BSD-3-Clause
"""A scene that is moved in double precision, by the filter of the whole method and by the chain of its steps: its poses
move with it, whatever the motion, and nothing else changes. Also in a shuffled order of its points. With --long by more
motions."""
import os
import random

from vtkmodules.vtkCommonCore import vtkIdList, vtkPoints
from vtkmodules.vtkCommonDataModel import vtkPolyData
from vtkmodules.vtkCommonTransforms import vtkTransform
from vtkmodules.vtkFiltersGeneral import vtkTransformFilter
from vtkmodules.vtkIOGeometry import vtkSTLReader

from ppfmeam.filters import (
    vtkMEAMPCDReader,
    vtkMEAMPoseEstimation,
)
from meamtest import LONG, MovedView, Trained, bracket, check, connect, is_rotation, pose_error, run, tuples
from chains import Detection


class Scene:
    """Edge points, surface, and the way the sensor looks."""

    def __init__(self, edges, surface, looking):
        self.edges, self.surface, self.looking = edges, surface, looking

    def moved(self, motion):
        def move(data):
            mover = connect(vtkTransformFilter(), Transform=motion)
            mover.SetOutputPointsPrecision(vtkTransformFilter.DOUBLE_PRECISION)
            mover.SetInputDataObject(data)
            mover.Update()
            return mover.GetOutput()

        return Scene(move(self.edges), move(self.surface), motion.TransformVector(self.looking))

    def shuffled(self):
        def shuffle(data):
            order = list(range(data.GetNumberOfPoints()))
            random.shuffle(order)
            ids, points, result = vtkIdList(), vtkPoints(), vtkPolyData()
            for i in order:
                ids.InsertNextId(i)
            data.GetPoints().GetPoints(ids, points)
            result.SetPoints(points)
            return result

        return Scene(shuffle(self.edges), shuffle(self.surface), self.looking)


def at_once(model, scene):
    box = connect(vtkMEAMPoseEstimation(), model, scene.surface, scene.edges,
                  MaximumNumberOfPoses=0, ViewDirection=scene.looking)
    return run(box)


def step_by_step(model, scene):
    chain = Detection(model, scene.edges, scene.surface)
    chain.set_sensor(view_direction=scene.looking)
    return run(chain.selection)


def check_same(poses, expected, motion, what):
    """The poses, in order, after the motion: to 1e-3 mm and 1e-3 degrees."""
    found, before = tuples(poses, "Transform"), tuples(expected, "Transform")
    check(len(found) == len(before), f"{what}: {len(found)} poses instead of {len(before)}")
    for i, transform in enumerate(before):
        moved = connect(vtkTransform(), Matrix=transform)
        moved.PostMultiply()
        moved.Concatenate(motion)
        matrix = moved.GetMatrix()
        error = pose_error(found[i], tuple(matrix.GetElement(r, c) for r in range(4) for c in range(4)))
        check(max(error) < 1e-3, f"{what}: pose {i} is off by {error}")
        check(is_rotation(found[i]), f"{what}: pose {i} is {found[i]}")
    for name in ("Score", "Probability", "VisibleFraction"):
        for (one,), (other,) in zip(tuples(poses, name), tuples(expected, name)):
            check(abs(one - other) < 1e-3, f"{what}: {name} {one} instead of {other}")


def check_scene(model, scene, motions):
    random.seed(3)
    for find in (at_once, step_by_step):
        expected = find(model, scene)
        check(expected.GetNumberOfPoints() > 0, "nothing was found")
        check_same(find(model, scene.shuffled()), expected, vtkTransform(), f"{find.__name__}, shuffled")
        for _ in range(motions):
            motion = vtkTransform()
            motion.Translate(*(random.uniform(-1000.0, 1000.0) for _ in range(3)))
            motion.RotateWXYZ(random.uniform(0.0, 360.0), *(random.gauss(0.0, 1.0) for _ in range(3)))
            check_same(find(model, scene.moved(motion)), expected, motion, find.__name__)


trained = Trained(bracket())
view = MovedView(trained)
for data in (view.edges, view.surface):
    data.GetPointData().Initialize()  # edge points as measured, without tangents
check_scene(run(trained.model), Scene(view.edges, view.surface, view.looking), 3 if LONG else 1)

folder = os.path.join(os.environ.get("PPFMEAM_DATA", ""), "tohoku", "Part_1")
if os.path.isdir(folder):
    part = connect(vtkSTLReader(), FileName=os.path.join(folder, "Part_1.STL"))
    model = run(Trained(part).model)
    clouds = []
    for name in ("Scene_boundary0.pcd", "Scene0.pcd"):
        clouds.append(run(connect(vtkMEAMPCDReader(), FileName=os.path.join(folder, "Scenes", name))))
    check_scene(model, Scene(*clouds, vtkMEAMPoseEstimation().GetViewDirection()), 2 if LONG else 1)
else:
    print(f"no dataset at {folder}: set PPFMEAM_DATA to check measured scenes, too")
print("ok")
