# SPDX-License-Identifier: BSD-3-Clause
"""The whole chain in one filter on a simulated bin: with the CAD or its trained model, an image or ready-made edges."""
import json
import math
import re

from vtkmodules.vtkCommonCore import vtkStringArray, vtkUnsignedCharArray
from vtkmodules.vtkCommonDataModel import vtkPolyData, vtkStructuredGrid
from vtkmodules.vtkIOGeometry import vtkSTLReader, vtkSTLWriter

from ppfmeam import filters
from meamtest import (Errors, Folder, Trained, Warnings, bracket, check, cloud, collection, connect, distance, fails, field,
                      image, is_empty, plate, points, pose_error, run, scaled, set_fields, text, tuples, written)

STAGES = ["Training", "SceneEdges", "Scene", "Tangents", "Detection", "Screening", "Verification", "Refinement", "Selection",
          "Output", "Total"]

source = connect(filters.vtkMEAMBinSceneSource(), plate(), Copies=4, Width=640, Height=480)
scan = run(source)
truth, part = source.GetOutputDataObject(1), source.GetOutputDataObject(2)


def estimation(*inputs, **properties):
    return connect(filters.vtkMEAMPoseEstimation(), *[i for i in inputs if i], **properties)


def found(filter):
    return tuples(run(filter), "Transform")


def answer(filter):
    run(filter)
    return filter.GetOutputDataObject(5).GetValueByName(0, "Text").ToString().replace("\n", " ")


def seconds(filter, stage):
    return field(filter.GetOutput(), "Seconds" + stage)[0][0]


filter = estimation(part, scan, MaximumNumberOfPoses=2)
poses = run(filter)
expected = tuples(poses, "Transform")
check(len(expected) == 2, f"{len(expected)} poses")
evaluation = connect(filters.vtkMEAMPoseEvaluation(), poses, truth, PosesAskedFor=2)
check(field(run(evaluation), "StrictRate") == [(100,)], "both poses are right")

# How likely a part has to be to be shown is chosen afterwards: detection does not run again.
instances = connect(filters.vtkMEAMPoseInstances(), filter, part)
runs = []
for algorithm in (filter, instances):
    algorithm.AddObserver("StartEvent", lambda caller, event: runs.append(caller.GetClassName()))
cells = []
for likely in (0.0, 1.0, 0.5):
    instances.SetMinimumProbability(likely)
    cells.append(run(instances).GetNumberOfCells())
check(cells[0] == 2 * part.GetNumberOfCells() and cells[1] == 0 and cells[2] <= cells[0], f"copies shown: {cells}")
check(runs == ["vtkMEAMPoseInstances"] * 3, f"what ran: {runs}")

(first,), (second,) = tuples(poses, "Evidence")
check(tuples(poses, "Rank") == [(1,), (2,)] and first >= second > 0, f"evidence {first}, {second}")
parts = [seconds(filter, stage) for stage in STAGES]
check(all(s >= 0 for s in parts) and 0.97 * parts[-1] <= sum(parts[:-1]) <= parts[-1] * 1.001,
      f"the stages add up to the total: {parts}")
check(field(poses, "Diameter") == field(truth, "Diameter"), "the diameter travels along")
report = text(poses, "Report")
check(report == "2 of 2 poses are more likely there than not. How long the parts are along z cannot be checked in "
                "this scan: a longer or shorter part looks the same.", f"in words: {report}")
numbered = type(scan)()
numbered.ShallowCopy(scan)
of = run(estimation(part, set_fields(numbered, SceneId=3, ImageId=7), MaximumNumberOfPoses=1))
check([field(of, name) for name in ("SceneId", "ImageId")] == [[(3,)], [(7,)]] and not poses.GetFieldData().HasArray("SceneId"), "of which image")
doubtful = estimation(part, scan, MinimumProbability=1.0)
warnings = Warnings(doubtful)
check(is_empty(run(doubtful)) and "No part was found." in str(warnings), f"no part without a word: {warnings}")
check(answer(doubtful).startswith("No part was found. Selection left none of ") and "MinimumProbability" in answer(doubtful), answer(doubtful))
edges = filter.GetOutputDataObject(1)
check(field(poses, "SceneEdgePoints") == [(edges.GetNumberOfPoints(),)], "the edges are the second output")

explained = [r for r, in tuples(edges, "Rank")]
counts = [explained.count(rank) for rank in range(3)]
check(sum(counts) == len(explained) and min(counts) > 0.03 * len(explained), f"edges that no or which pose explains: {counts}")
copies = filter.GetOutputDataObject(2)
check(copies.GetNumberOfPolys() == 2 * part.GetNumberOfPolys(), "the third output has the part at each pose")
check([r for r, in tuples(copies, "Rank")[::part.GetNumberOfPoints()]] == [1, 2], "in the order of the poses")
labels = [poses.GetPointData().GetAbstractArray("Label").GetValue(i) for i in range(2)]
sure = [f", rotation {round(100 * c)} %" if c < 0.95 else "" for c, in tuples(poses, "Certainty")]
check(labels == [f"{i + 1}: {round(100 * p)} %{sure[i]}" for i, (p,) in enumerate(tuples(poses, "PlaceProbability"))],
      f"labels {labels}")
check(re.fullmatch(r"No more than 2 were asked for: .*\nThe part is \d+ pixels long, .* 2 of 2 poses are likely\.", filter.GetSuggestion()),
      f"what the scan suggests: {filter.GetSuggestion()}")
check(answer(filter).startswith("No more than 2 were asked for: ") and
      answer(estimation(part, scan, MaximumNumberOfPoses=0, ShownProbability=0.0)) == "", answer(filter))
scores, stages = filter.GetOutputDataObject(3), filter.GetOutputDataObject(4)
check([scores.GetValueByName(i, "Pose").ToString() for i in range(scores.GetNumberOfRows())] == ["1", "2"], "rows of poses")
check(scores.GetValueByName(1, "Probability").ToDouble() == tuples(poses, "Probability")[1][0], "probabilities to plot")
check([(stages.GetValueByName(i, "Stage").ToString(), stages.GetValueByName(i, "Seconds").ToDouble())
       for i in range(stages.GetNumberOfRows())] == list(zip(STAGES, parts))[:-1], "the stages to plot")
check(field(poses, "ScenePoints")[0][0] > 0.9 * 640 * 480, "points are counted")

# One column orders poses: their ranks, and their scores in files, follow it.
all_poses = estimation(part, scan, MaximumNumberOfPoses=0)
everything = run(all_poses)
evidence = [e for e, in tuples(everything, "Evidence")]
likely = [p for p, in tuples(everything, "PlaceProbability")]
mean = [(place + p) / 2 for place, (p,) in zip(likely, tuples(everything, "Probability"))]
check(len(evidence) > 2 and evidence == sorted(evidence, reverse=True), f"evidence {evidence}")
check(mean == sorted(mean, reverse=True), f"place and rotation are worth the same: {mean}")
hidden = sum(0 < p < 0.5 for p in likely)
check(hidden and answer(all_poses) == f"{hidden} of {len(likely)} poses are not shown: a copy is there with less than 50 % "
      "(ShownProbability).", answer(all_poses))
check([r for r, in tuples(everything, "Rank")] == list(range(1, len(evidence) + 1)), "ranks")
folder = Folder()
for name in ("poses.csv", "poses.detections.json"):
    written(folder(name), everything, filters.vtkMEAMPoseWriter)
check([float(row.split(",")[3]) for row in folder.text("poses.csv").splitlines()[1:]]
      == [p for p, in tuples(everything, "Probability")], "scores in the file")
detection = json.loads(folder.text("poses.detections.json"))["detections"][0]
size = sorted(1000 * s for s in detection["bbox"]["size"].values())
check(abs(math.hypot(*size) / field(poses, "Diameter")[0][0] - 1) < 0.2, f"the part's box in the file is {size} mm")
check(0 < detection["results"][0]["pose"]["covariance"][0] < 1e-4, f"covariance {detection}")

# Training is not done again for another scene or other settings of the detection; it is for another seed.
filter.SetMaximumNumberOfPoses(1)
check(found(filter) == expected[:1], "the best pose alone")
again = seconds(filter, "Training")
check(again < 0.1 * parts[0], f"trained again: {again} s after {parts[0]} s")
filter.SetSeed(2)
run(filter)
check(seconds(filter, "Training") > 0.2 * parts[0], "another seed has to be trained")

# The same poses with the trained model, on one thread, and with the edges as input.
model = run(Trained(part).model)
filter = estimation(model, scan, MaximumNumberOfPoses=2)
check(found(filter) == expected, "the trained model")
copies = filter.GetOutputDataObject(2)
check(copies.GetNumberOfVerts() == copies.GetNumberOfPoints() > 200, "points of its surface at each pose")
check(found(estimation(model, scan, MaximumNumberOfPoses=2, NumberOfThreads=1)) == expected, "one thread")
ready = run(connect(filters.vtkMEAMSceneEdgeExtraction(), scan))
own, given = (estimation(model, *inputs, MaximumNumberOfPoses=4) for inputs in ((scan,), (scan, ready)))
four, others = found(own), found(given)  # all but sure, and nearly as likely: in whatever order
places = [min(range(4), key=lambda k: math.dist(pose, four[k])) for pose in others]
check(sorted(places) == [0, 1, 2, 3] and all(math.dist(pose, four[k]) < 1e-3 for pose, k in zip(others, places)), "ready-made edges")
ranks = [0, *(k + 1 for k in places)]
check([ranks[int(r)] for r, in tuples(given.GetOutputDataObject(1), "Rank")] == [r for r, in tuples(own.GetOutputDataObject(1), "Rank")],
      "they are explained in their order")
# A part in another unit and frame, brought back: both are among the four that are all but sure there, in whatever order.
moved = found(estimation(scaled(part, 0.001), scan, MaximumNumberOfPoses=4, CADScale=1000.0, CADOffset=(0, 0, 5)))
for pose in expected:
    shift = min(math.dist([m[4 * k + 3] + 5 * m[4 * k + 2] for k in range(3)], [pose[4 * k + 3] for k in range(3)])
                for m in moved)
    check(shift < 0.2, f"the offset part is {shift} mm away")
# The points of the scan in no order need a sensor and edges.
surface = cloud([scan.GetPoint(i) for i in range(0, scan.GetNumberOfPoints(), 4) if scan.IsPointVisible(i)])
loose = estimation(model, surface, ready, MaximumNumberOfPoses=2, ViewDirection=(0, 0, 1))
loose.SetProjectionToPerspective()
evaluation = connect(filters.vtkMEAMPoseEvaluation(), run(loose), truth)
check(field(run(evaluation), "PaperRate") == [(100,)], "the poses in an unorganized scene are right")
# The paper's preset runs and gives something else.
paper = estimation(part, scan, MaximumNumberOfPoses=2)
paper.SetPresetToPaper()
check(run(paper).GetNumberOfPoints() > 0 and found(paper) != expected, "the paper's preset")

# The number of reference points follows where the edges come from; another one leads to other candidates.
check(found(estimation(model, scan, MaximumNumberOfPoses=0, ReferenceShare=1))
      != found(estimation(model, scan, MaximumNumberOfPoses=0)), "of a scan")
elsewhere = cloud(points(ready), Tangent=tuples(ready, "Tangent"))
few = found(estimation(model, scan, elsewhere, MaximumNumberOfPoses=0, Features=0))
candidates = {}
for name, edges in (("scan", ready), ("elsewhere", elsewhere)):
    edges = run(connect(filters.vtkMEAMTangentEstimation(), edges, model))
    detection = connect(filters.vtkMEAMPoseDetection(), edges, model, Features=0)
    candidates[name] = run(detection).GetNumberOfPoints()
check(100 <= candidates["elsewhere"] < 0.5 * candidates["scan"], f"{candidates}")
share = (candidates["elsewhere"] - 0.5) / edges.GetNumberOfPoints()  # each is of one reference point
check(few == found(estimation(model, scan, elsewhere, MaximumNumberOfPoses=0, Features=0, ReferenceShare=share)),
      "of edges from elsewhere")
check(few != found(estimation(model, scan, elsewhere, MaximumNumberOfPoses=0, Features=0, ReferenceShare=0.5)), "another share")

# Both features find the parts; a model of one alone says what it has not.
for features in (0, 1):
    evaluation = connect(filters.vtkMEAMPoseEvaluation(), run(estimation(part, scan, MaximumNumberOfPoses=2, Features=features)), truth)
    evaluation.SetPosesAskedFor(2)
    check(field(run(evaluation), "Top1Rate") == [(100,)], f"the first pose by features {features} is right")
edges_alone = Trained(part).model
edges_alone.SetFeaturesToEdges()
fails(estimation(run(edges_alone), scan, Features=1), "edge points alone", "Features")

# The trained model comes out, too, and finds the same.
check(found(estimation(filter.GetOutputDataObject(6), scan, MaximumNumberOfPoses=2)) == expected, "by the model that came out")

# In a region, a box or a mask of the scan, only the part whose middle lies there.
middle = [sum(expected[1][4 * row + k] * x for k, x in enumerate((*field(poses, "PartMiddle")[0], 1))) for row in range(3)]
of_box = estimation(model, scan, MaximumNumberOfPoses=0, Region=[x + d for x in middle for d in (-15, 15)])
sure = [t for t, (p,) in zip(found(of_box), tuples(of_box.GetOutput(), "PlaceProbability")) if p > 0.5]
check(len(sure) == 1 and distance(sure[0][3::4], expected[1][3::4]) < 0.5, f"in the box: {sure}")
check(field(of_box.GetOutput(), "ScenePoints")[0][0] < 0.9 * field(poses, "ScenePoints")[0][0], "the scan is cropped")
masked = scan.NewInstance()
masked.ShallowCopy(scan)
mask = vtkUnsignedCharArray()
mask.SetName("Region")
for x, y, z in points(scan):
    mask.InsertNextValue(int(abs(x - middle[0]) < 15 and abs(y - middle[1]) < 15))
masked.GetPointData().AddArray(mask)
of_mask = estimation(model, masked, MaximumNumberOfPoses=0)
sure = [t for t, (p,) in zip(found(of_mask), tuples(of_mask.GetOutput(), "PlaceProbability")) if p > 0.5]
check(len(sure) == 1 and distance(sure[0][3::4], expected[1][3::4]) < 0.5, f"in the mask: {sure}")
fails(estimation(model, scan, Region=(0, 1, 0, 1, -5, -4)), "region")

# Two types of part, of which one is there: names and numbers tell them apart.
both = estimation(bracket(), scan, MaximumNumberOfPoses=2)
flap = vtkSTLReader()
flap.SetFileName(written(folder("flap.stl"), bracket(), vtkSTLWriter))
both.SetInputConnection(0, flap.GetOutputPort())
named = vtkPolyData()
named.ShallowCopy(part)
name = vtkStringArray()
name.SetName("Name")
name.InsertNextValue("plate")
named.GetFieldData().AddArray(name)
both.AddInputDataObject(0, named)
together = run(both)
errors = [pose_error(a, b) for a, b in zip(tuples(together, "Transform"), expected)]
check(tuples(together, "PartId") == [(1,)] * 2 and all(d < 0.2 and turn < 0.3 for d, turn in errors), f"of two types {errors}")
labels = together.GetPointData().GetAbstractArray("Label")
check(labels.GetValue(0).startswith("1 (plate): "), labels.GetValue(0))
check(together.GetPointData().GetScalars().GetName() == "PartId", "the legend beside the labels is that of the types")
names = together.GetFieldData().GetAbstractArray("PartName")
check([names.GetValue(k) for k in range(2)] == ["flap", "plate"] and len(field(together, "Diameter")) == 2, "names and diameters")
copies = both.GetOutputDataObject(2)
check(set(tuples(copies, "PartId")) == {(1,)} and set(tuples(copies, "Rank")) == {(1,), (2,)}, "their copies")
name.SetValue(0, "flap")
named.Modified()
names = run(both).GetFieldData().GetAbstractArray("PartName")
check([names.GetValue(k) for k in range(2)] == ["flap", "flap 2"], "two files of one name")
both.RemoveInputConnection(0, 0)
check(not run(both).GetPointData().HasArray("PartId") and found(both) == expected, "of one type again")

# Asked to stop, it stops without an error and works again.
filter = estimation(model, scan, MaximumNumberOfPoses=2)
observer = filter.AddObserver("ProgressEvent", lambda caller, event: caller.GetProgress() > 0.6 and caller.AbortExecuteOn())
errors = Errors(filter)
filter.Update()
check(is_empty(filter.GetOutput()) and not errors.messages, f"stopped: {errors}")
filter.RemoveObserver(observer)
filter.AbortExecuteOff()
filter.Modified()
check(found(filter) == expected, "it works again")

nothing = vtkStructuredGrid()
fails(filters.vtkMEAMPoseEstimation())
fails(estimation(vtkPolyData(), scan), "mesh")
fails(estimation(cloud([(0, 0, 0), (1, 0, 0), (0, 1, 0)]), scan), "no faces")
fails(estimation(model, nothing), "scene", "no points")
fails(estimation(model, cloud([(math.nan, 0, 0)] * 9), ready), "NaN")
fails(estimation(model, surface, vtkPolyData()), "boundary", "no points")
fails(estimation(model, scaled(scan, 0.001)), "units", "1000")
wrong_image = estimation(model, scan)
wrong_image.SetInputDataObject(3, image(30, 20))
fails(wrong_image, "no pixels")
fails(estimation(collection(("a", part)), scan))
sideways = estimation(model, surface, ready, ViewDirection=(0, 0, 0))
fails(sideways, "view direction")
fails(estimation(part, scan, CADScale=0.0), "scale")
fails(estimation(model, image()), "vtkStructuredGrid")
