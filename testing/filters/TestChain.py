# SPDX-License-Identifier: BSD-3-Clause
"""The chain of single filters and the one filter for all return the same poses: on a simulated scan, whose edges are found
in it, and on a scene of the Tohoku dataset, when $PPFMEAM_DATA/tohoku is there, whose boundary is given."""
import os
import sys

from vtkmodules.vtkIOGeometry import vtkSTLReader

from ppfmeam import filters, scripting
from meamtest import Trained, check, connect, field, pose_error, run, tuples
from chains import Detection, set_preset

PRESETS = ("recommended", "paper", "without-meam", "ppf", "b2b")


def detect(preset, model, part, surface, boundary=None):
    """By the single filters, and by all in one: the same poses to the last bit."""
    edges = boundary
    if not boundary:
        edges = connect(filters.vtkMEAMSceneEdgeExtraction(), surface)
        set_preset(edges, "recommended" if preset == "recommended" else "paper")
        sources = {source for source, in tuples(run(edges), "EdgeSource")}
        check(sources == ({0, 1, 2} if preset == "recommended" else {0}), f"{preset}: edges from {sources}")
    found = run(Detection(model, edges, surface, preset).selection)
    box = connect(filters.vtkMEAMPoseEstimation(), part, surface, *([boundary] if boundary else []), MaximumNumberOfPoses=0)
    scripting.set_preset(box, preset)
    for name in ("Transform", "Score", "Votes", "Probability", "Certainty", "VisibleFraction", "Covariance"):
        check(tuples(run(box), name) == tuples(found, name), f"{preset}: {name} of the chain and of the one filter differ")
    return found


# A scan of a bin of five sample parts.
source = connect(filters.vtkMEAMBinSceneSource(), Copies=5, Width=320, Height=240)
scan = run(source)
truth, mesh = (source.GetOutputDataObject(port) for port in (1, 2))
for preset in PRESETS:
    model = scripting.train(mesh, preset)
    found = detect(preset, model, mesh if preset in ("ppf", "b2b") else model, scan)  # those are trained soon
    check(found.GetNumberOfPoints() > 0, f"{preset}: no pose in the simulated scan")
    if preset == "recommended":
        mm, degrees = min(pose_error(tuples(found, "Transform")[0], t) for t in tuples(truth, "Transform"))
        check(mm < 2 and degrees < 2, f"the best pose in the simulated scan is off by {mm} mm and {degrees} degrees")

folder = os.path.join(os.environ.get("PPFMEAM_DATA", ""), "tohoku", "Part_3")
if not os.path.isdir(folder):
    print(f"the simulated scan alone: there is no dataset at {folder}")
    sys.exit()


def reader(kind, *path):
    return connect(kind(), FileName=os.path.join(folder, *path))


# The STL is in another frame than the published poses.
trained = Trained(reader(vtkSTLReader, "Part_3.STL"))
trained.prepared.SetOffset(-20.9645, -17.4974, -9.3144)
run(trained.model)
boundary = reader(filters.vtkMEAMPCDReader, "Scenes", "Scene_boundary0.pcd")
surface = reader(filters.vtkMEAMPCDReader, "Scenes", "Scene0.pcd")
published = tuples(run(reader(filters.vtkMEAMPoseReader, "Results", "trans0.txt")), "Transform")
check(len(published) == 20, f"{len(published)} published poses")

for paper in (False, True):
    if paper:
        trained.tangents.SetParametersToPaper()
        trained.model.SetParametersToPaper()
    found = detect("paper" if paper else "recommended", trained.model, trained.model, surface, boundary)
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
    found = detect(preset, scripting.train(mesh, preset), mesh, surface, boundary)
    errors = [min(pose_error(transform, p) for p in published) for transform in tuples(found, "Transform")[:5]]
    right = sum(mm < 4.9 and degrees < 5 for mm, degrees in errors)
    check(found.GetNumberOfPoints() > 0 and right >= least, f"{preset}: {errors}")
