# SPDX-License-Identifier: BSD-3-Clause
"""The whole chain on a scene of the Tohoku dataset, whose folder is $PPFMEAM_DATA/tohoku."""
import os

from vtkmodules.vtkIOGeometry import vtkSTLReader

from ppfmeam import scripting
from ppfmeam.chains import Detection
from ppfmeam.filters import (
    vtkMEAMPCDReader,
    vtkMEAMPoseEstimation,
    vtkMEAMPoseReader,
)
from meamtest import Trained, check, connect, field, pose_error, run, skip, tuples

folder = os.path.join(os.environ.get("PPFMEAM_DATA", ""), "tohoku", "Part_3")
if not os.path.isdir(folder):
    skip(f"no dataset at {folder}: set PPFMEAM_DATA")


def reader(kind, *path):
    result = kind()
    result.SetFileName(os.path.join(folder, *path))
    return result


# The STL is in another frame than the published poses.
trained = Trained(reader(vtkSTLReader, "Part_3.STL"))
trained.prepared.SetOffset(-20.9645, -17.4974, -9.3144)
run(trained.model)
boundary = reader(vtkMEAMPCDReader, "Scenes", "Scene_boundary0.pcd")
surface = reader(vtkMEAMPCDReader, "Scenes", "Scene0.pcd")
published = tuples(run(reader(vtkMEAMPoseReader, "Results", "trans0.txt")), "Transform")
check(len(published) == 20, f"{len(published)} published poses")


def detect(preset, model, part):
    """By the single filters, and by all in one: the same poses to the last bit."""
    chain = Detection(model, boundary, surface, preset)
    found = run(chain.selection)
    box = connect(vtkMEAMPoseEstimation(), part, surface, boundary)
    box.SetMaximumNumberOfPoses(0)
    scripting.set_preset(box, preset)
    check(tuples(run(box), "Transform") == tuples(found, "Transform"), f"{preset}: the chain and the one filter differ")
    for name in ("Score", "Votes", "Probability", "Certainty", "VisibleFraction", "Covariance"):
        check(tuples(run(box), name) == tuples(found, name), f"{preset}: {name} of the chain and of the one filter differ")
    return found


for paper in (False, True):
    if paper:
        trained.tangents.SetParametersToPaper()
        trained.model.SetParametersToPaper()
    found = detect("paper" if paper else "recommended", trained.model, trained.model)
    diameter = field(found, "Diameter")[0][0]
    check(abs(diameter - 49.4) < 0.1, f"the diameter is {diameter}")
    check(found.GetNumberOfPoints() >= 5, f"{found.GetNumberOfPoints()} poses")
    right, most = 0, (1.5, 4.0) if paper else (0.05, 0.1)  # mm, degrees
    for rank, transform in enumerate(tuples(found, "Transform")[:5], 1):
        mm, degrees = min(pose_error(transform, p) for p in published)
        right += mm < most[0] and degrees < most[1]
        print(f"{'paper' if paper else 'recommended'} {rank}: {mm:.3f} mm, {degrees:.3f} degrees")
    check(right == 5, f"{right} of 5 poses are right")

# What the paper compares itself with, trained step by step, too.
mesh = run(trained.prepared)
for preset, least in (("without-meam", 1), ("ppf", 5), ("b2b", 0)):
    found = detect(preset, scripting.train(mesh, preset), mesh)
    errors = [min(pose_error(transform, p) for p in published) for transform in tuples(found, "Transform")[:5]]
    right = sum(mm < 4.9 and degrees < 5 for mm, degrees in errors)
    check(found.GetNumberOfPoints() > 0 and right >= least, f"{preset}: {errors}")
