# SPDX-License-Identifier: BSD-3-Clause
"""A series of three scans is played: poses, labels, parts and the tables to plot follow each scan, are right by its true
poses, and the pictures of the animation differ. The argument is the folder of the repository."""
import os
import subprocess
import sys
import tempfile

from paraview import simple

from pictures import pixels, red

SCENES = 3
root = sys.argv[1]
folder = tempfile.TemporaryDirectory()
bins = os.path.join(folder.name, "bins")
cad = os.path.join(root, "examples", "parts", "hole_plate.stl")


def check(condition, message):
    if not condition:
        raise AssertionError(message)


def data(source, port=0):
    return source.GetClientSideObject().GetOutputDataObject(port)


def positions(poses):
    """Where each pose takes the middle of the part's box, mm."""
    lower = [data(part).GetBounds()[2 * k] for k in range(3)]
    upper = [data(part).GetBounds()[2 * k + 1] for k in range(3)]
    middle = [(a + b) / 2 for a, b in zip(lower, upper)]
    transforms = poses.GetPointData().GetArray("Transform")
    return [[sum(t[4 * k + i] * middle[i] for i in range(3)) + t[4 * k + 3] for k in range(3)]
            for t in (transforms.GetTuple(i) for i in range(transforms.GetNumberOfTuples()))]


subprocess.run(["/usr/bin/python3", "-c", f"import batchtest; batchtest.dataset({bins!r}, {SCENES})"], check=True,
               cwd=os.path.join(root, "testing", "filters"))
part = simple.STLReader(FileNames=[cad])
part.UpdatePipeline()
series = simple.BOPReader(FileName=bins)
found = simple.MEAMPoseEstimation(Input=part, Scene=simple.OutputPort(series, 0), MaximumNumberOfPoses=1)
view = simple.GetActiveViewOrCreate("RenderView")
view.ViewSize = [320, 240]
for source, port in ((series, 0), (found, 0), (found, 2)):
    simple.Show(simple.OutputPort(source, port), view)
animation = simple.GetAnimationScene()
animation.UpdateAnimationUsingDataTimeSteps()
check(len(animation.TimeKeeper.TimestepValues) == SCENES, f"times {animation.TimeKeeper.TimestepValues}")
seen = []
for time in animation.TimeKeeper.TimestepValues:
    animation.AnimationTime = time
    simple.Render(view)
    poses, truth, parts, scores = data(found), data(series, 1), data(found, 2), data(found, 3)
    best, = positions(poses)
    error = min(sum((a - b) ** 2 for a, b in zip(best, true)) ** 0.5 for true in positions(truth))
    check(error < 2.0, f"scan {time}: the best pose is {error:.1f} mm from the nearest true one")
    check(poses.GetPointData().GetAbstractArray("Label").GetValue(0).startswith("1: "), f"scan {time}: no label")
    bounds = parts.GetBounds()
    check(all(bounds[2 * k] <= best[k] <= bounds[2 * k + 1] for k in range(3)), f"scan {time}: the part is not at its pose")
    check(scores.GetNumberOfRows() == 1 and scores.GetValueByName(0, "Probability").ToDouble()
          == poses.GetPointData().GetArray("Probability").GetValue(0), f"scan {time}: what is plotted is not of its pose")
    seen.append(best)
check(all(a != b for i, a in enumerate(seen) for b in seen[:i]), "the poses are those of another scan")

simple.SaveAnimation(os.path.join(folder.name, "played.png"), view, ImageResolution=[320, 240], FrameWindow=[0, SCENES - 1])
pictures = sorted(name for name in os.listdir(folder.name) if name.endswith(".png"))
check(len(pictures) == SCENES, f"pictures {pictures}")
reds = [set(red(pixels(os.path.join(folder.name, name))).nonzero()[0].tolist()) for name in pictures]
check(all(len(r) > 100 for r in reds), f"red pixels: {[len(r) for r in reds]}")
check(all(len(a & b) < 0.9 * len(a | b) for i, a in enumerate(reds) for b in reds[:i]), "the pictures are of the same scan")
