# SPDX-License-Identifier: BSD-3-Clause
"""Of a simulated bin: what came out is found, hidden parts are hidden, and the numbers and points are told."""
import math
import os
import re

from vtkmodules.vtkCommonDataModel import vtkPolyData

from ppfmeam import scripting
from ppfmeam.filters import vtkMEAMBinSceneSource, vtkMEAMPoseDiagnosis, vtkMEAMPoseEstimation, vtkMEAMSceneEdgeExtraction
from meamtest import check, cloud, connect, fails, field, is_empty, plate, points, poses, read, run, text, texts, tuples
from chains import Detection

source = connect(vtkMEAMBinSceneSource(), plate(), Copies=12, Width=640, Height=480)
scan = run(source)
truth, mesh = source.GetOutputDataObject(1), source.GetOutputDataObject(2)
estimation = connect(vtkMEAMPoseEstimation(), mesh, scan, MaximumNumberOfPoses=0, MinimumProbability=0.5)
found = run(estimation)


def tuples_of(data):
    """The place that a diagnosis is of."""
    return data.GetFieldData().GetArray("Transform").GetTuple(0)


def distance(a, b):
    return math.dist((a[3], a[7], a[11]), (b[3], b[7], b[11]))


diagnosis = connect(vtkMEAMPoseDiagnosis(), mesh, scan, None, None, truth, MaximumNumberOfPoses=0)
diagnosis.SetMinimumProbability(0.5)
diagnosis.SetPlaceToRankedPose()
diagnosis.SetFit(False)
transforms, visible = tuples(truth, "Transform"), [v for (v,) in tuples(truth, "VisibleFraction")]
ranks, verdicts = [], []
for k in range(len(transforms)):
    diagnosis.SetRankOfPose(k + 1)
    shares = []
    observer = diagnosis.AddObserver("ProgressEvent", lambda caller, event: shares.append(caller.GetProgress()))
    output = run(diagnosis)
    diagnosis.RemoveObserver(observer)
    check(k == 0 or min(s for s in shares if s > 0) >= 0.8, f"the detection is not done again: {shares[:3]}")
    ranks.append(int(field(output, "Rank")[0][0]))
    verdicts.append(text(output, "Verdict"))
    check((text(output, "LostIn") == "") == verdicts[-1].startswith("Found as"), f"{verdicts[-1]}, {text(output, 'LostIn')}")
    check(verdicts[-1].endswith("."), verdicts[-1])
    if ranks[-1]:
        off = distance(tuples(found, "Transform")[ranks[-1] - 1], transforms[k])
        check(off < 5, f"{verdicts[-1]}: the pose of this rank is {off} mm away")
    else:
        check(visible[k] < 0.8 or "Lost" in verdicts[-1] or "probability" in verdicts[-1], f"{visible[k]}: {verdicts[-1]}")
print(*(f"{v:.2f} {verdict}" for v, verdict in zip(visible, verdicts)), sep="\n")
came_out = [rank for rank in ranks if rank]
check(len(came_out) >= 5 and len(set(came_out)) == len(came_out), f"each that came out is one of the true: {ranks}")
check(sum(1 for r, v in zip(ranks, visible) if v > 0.9 and r) >= 4, f"those in sight are found: {ranks}, {visible}")
hidden = [v for verdict, v in zip(verdicts, visible) if verdict.startswith("Hidden: something lies in front of")]
check(hidden and max(hidden) < 0.5, f"hidden parts: {hidden}, {verdicts}")
# The least likely one is too unlikely when more is asked for.
last = max(came_out)
(least,) = tuples(found, "PlaceProbability")[last - 1]
diagnosis.SetRankOfPose(ranks.index(last) + 1)
diagnosis.SetMinimumProbability(0.5 * (least + 1.0))
verdict = text(run(diagnosis), "Verdict")
check(verdict.startswith(f"Found as rank {last}, {100 * least:.0f} %, ") and "only poses of at least" in verdict, verdict)
diagnosis.SetMinimumProbability(0.5)

# The points lie on the scan where they match, and have their names.
best = ranks.index(1)
diagnosis.SetRankOfPose(best + 1)
output = run(diagnosis)
states = [int(s) for (s,) in tuples(output, "State")]
NAMES = ("explained", "turned", "hidden", "not measured", "seen past", "missing")
check(states.count(0) > 0.6 * len(states), f"of what was found most matches: {states.count(0)} of {len(states)}")
isEdge = [int(e) for (e,) in tuples(output, "IsEdge")]
check(set(isEdge) == {0, 1}, "surface and edges")
residual = [int(r) for (r,) in tuples(output, "Residual")]
check(residual == [5 if s == 4 and e else s for s, e in zip(states, isEdge)] and 5 in residual, "edge points that are missing")
check(texts(output, "StateName") == [NAMES[r] for r in residual], "the names of states")
answers = []
for more in (True, False):
    diagnosis.SetMore(more)
    run(diagnosis)
    answers.append(diagnosis.GetOutputDataObject(3).GetValueByName(0, "Text").ToString())
check("logarithm" in answers[0] and "logarithm" not in answers[1] and all("Most for it: " in answer for answer in answers), f"{answers}")
middle = [transforms[best][i] for i in (3, 7, 11)]
check(all(math.dist(p, middle) < field(output, "Diameter")[0][0] for p in points(output)), "the points are those of the part")
table = diagnosis.GetOutputDataObject(1)
check([table.GetColumnName(i) for i in range(4)] == ["Step", "Quantity", "Value", "Of"], "the columns")
steps = [table.GetValueByName(row, "Step").ToString() for row in range(table.GetNumberOfRows())]
check({"edges", "surface", "voting", "screening", "score", "refinement", "selection"} <= set(steps), f"all steps: {steps}")
check(not is_empty(diagnosis.GetOutputDataObject(2)), "the part is shown")

# A picked point: that of the pose on it. The place is told.
matched = [p for p, s in zip(points(output), states) if s == 0]
diagnosis.SetPlaceToPoint()
diagnosis.SetPosition(matched[0])
output = run(diagnosis)
check(int(field(output, "Rank")[0][0]) == 1 and text(output, "Verdict").startswith("Found as rank 1,"), text(output, "Verdict"))
place = output.GetFieldData().GetArray("Transform").GetTuple(0)
check(distance(place, transforms[best]) < 1, f"the place {place}")
diagnosis.SetPosition(0, 0, 10)
output = run(diagnosis)
check(text(output, "Verdict").startswith("No part there") and output.GetNumberOfPoints() == 0, text(output, "Verdict"))
check(output.GetFieldData().GetArray("Transform") is None, "no place")

# The same pose by its numbers, as of a widget: turned about y, then x, then z.
diagnosis.SetPlaceToPose()
diagnosis.SetPosePosition(place[3], place[7], place[11])
x = math.asin(max(-1.0, min(1.0, place[9])))
y, z = math.atan2(-place[8], place[10]), math.atan2(-place[1], place[5])
diagnosis.SetPoseRotation(*(math.degrees(angle) for angle in (x, y, z)))
output = run(diagnosis)
check(int(field(output, "Rank")[0][0]) == 1 and " 0.0 mm and 0.0 degrees" in text(output, "Verdict"), text(output, "Verdict"))

# Beside a pose that is shifted along the plate more of the surface goes on than beside the right one. The shift is clear of
# the tenth of the diameter from which on the right one is another pose, which explains what goes on.
on_right = diagnosis.GetOutputDataObject(4).GetNumberOfPoints()
shift = 0.08 * field(output, "Diameter")[0][0]
diagnosis.SetPosePosition(*(place[k] + shift * place[k - 3] for k in (3, 7, 11)))
run(diagnosis)
unexplained = diagnosis.GetOutputDataObject(4)
check(unexplained.GetNumberOfPoints() > on_right + 20, f"{unexplained.GetNumberOfPoints()} and {on_right} unexplained")
check({int(r) for (r,) in tuples(unexplained, "Residual")} == {6}, "as the color map has it")
check("measured surface goes on beside it over" in text(diagnosis.GetOutput(), "Reasons"), text(diagnosis.GetOutput(), "Reasons"))

# That pose as one that came out, by its rank and by a point on it: what is told is of it, and not of the right one beside it.
shifted = list(place)
for k in (3, 7, 11):
    shifted[k] += shift * place[k - 3]
wrong = cloud([(0, 0, 0)] * 2, Transform=[place, shifted], PlaceProbability=[0.99, 0.97], Rank=[1, 7])
asked = connect(vtkMEAMPoseDiagnosis(), mesh, scan, None, None, wrong, Place=vtkMEAMPoseDiagnosis.RankedPose)
asked.SetRankOfPose(2)
output = run(asked)
beyond = max(points(output), key=lambda p: sum((p[k] - place[4 * k + 3]) * place[4 * k] for k in range(3)))  # where the right one has ended
asked.SetPlaceToPoint()
asked.SetPosition(beyond)
for told in (output, run(asked)):
    check(text(told, "Verdict").startswith("Found as rank 7, 97 %.") and text(told, "LostIn") == "", text(told, "Verdict"))
    check("If it is wrong: " in text(told, "Advice") and text(told, "Reasons").startswith("For it, "), text(told, "Advice"))
    check(distance(tuples_of(told), shifted) < 0.1, "it is told of another pose")

# A limit is named.
diagnosis.SetMaximumNumberOfPoses(1)
diagnosis.SetPlaceToRankedPose()
diagnosis.SetRankOfPose(ranks.index(2) + 1)
output = run(diagnosis)
check("only the best 1" in text(output, "Verdict") and "MaximumNumberOfPoses" in text(output, "Advice"),
      text(output, "Verdict") + text(output, "Advice"))

# A point on a part that is found beyond the limit, wherever its pose is picked.
sixth = ranks.index(max(came_out))
diagnosis.SetRankOfPose(sixth + 1)
diagnosis.SetMaximumNumberOfPoses(0)
output = run(diagnosis)
on = [p for p, s in zip(points(output), tuples(output, "State")) if int(s[0]) == 0]
diagnosis.SetPlaceToPoint()
diagnosis.SetMaximumNumberOfPoses(max(came_out) - 1)
for point in on[::max(1, len(on) // 5)]:
    diagnosis.SetPosition(point)
    verdict = text(run(diagnosis), "Verdict")
    check(verdict.startswith("Found as rank"), f"{point}: {verdict}")
diagnosis.SetPlaceToRankedPose()

# What advice names is a property of the filter, or a value of one.
source = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", "core", "pose", "diagnosis", "DiagnosisReport.cpp")
advice = re.search(r"\nstd::string adviceOf\(.*?\n}\n", read(source), re.DOTALL)[0]
advice = " ".join(re.findall(r'"([^"]*)"', advice))
named = set(re.findall(r"\b[A-Z][a-z]+(?:[A-Z][a-z]*)+\b|Creases|Features", advice))
check({"MaximumNumberOfPoses", "MinimumProbability", "ReferenceShare", "Features", "DepthEdges"} <= named, f"{named}")
for name in named:
    check(all(hasattr(f, "Set" + name) for f in (diagnosis, estimation)), f"there is no property {name}")
for name, value in re.findall(r"\b([A-Z]\w+): ([A-Z]\w+)", advice):
    check(hasattr(diagnosis, f"Set{name}To{value}"), f"{name} has no value {value}")

diagnosis.SetRankOfPose(99)
fails(diagnosis, "no pose 99", "RankOfPose")
diagnosis.SetRankOfPose(1)
diagnosis.SetInputDataObject(4, vtkPolyData())
fails(diagnosis, "no pose 1")

# What no lot of candidates that was refined has come to: the last of all that may be, in a full bin.
source = connect(vtkMEAMBinSceneSource(), plate(), Copies=30, Width=640, Height=480)
scan = run(source)
may_be = run(Detection(scripting.train(mesh), run(connect(vtkMEAMSceneEdgeExtraction(), scan)), scan).alternatives)
check(may_be.GetNumberOfPoints() > 160, f"two lots and more: {may_be.GetNumberOfPoints()}")
diagnosis = connect(vtkMEAMPoseDiagnosis(), mesh, scan, None, None, poses(*tuples(may_be, "Transform")), MaximumNumberOfPoses=0)
diagnosis.SetPlaceToRankedPose()
diagnosis.SetFit(False)
diagnosis.SetRankOfPose(may_be.GetNumberOfPoints())
told = text(run(diagnosis), "Verdict")
check(told.startswith("Lost in selection of candidates: rank ") and told.endswith(" too unlikely to be refined."), told)
