# SPDX-License-Identifier: BSD-3-Clause
"""What follows MEAM Pose Estimation of two types of part: Pose Diagnosis of poses of each, and of places where none came out."""
import numpy
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkCommonDataModel import vtkStructuredGrid

from ppfmeam.filters import vtkMEAMBinSceneSource, vtkMEAMPoseDiagnosis, vtkMEAMPoseEstimation, vtkMEAMSamplePartSource
from meamtest import bracket, check, cloud, connect, distance, fails, field, poses, prints, run, tuples

W, H = 640, 480
plate = vtkMEAMSamplePartSource()
plate.SetPartToHolePlate()
meshes = [run(plate), bracket()]


def bin_of(mesh):
    source = connect(vtkMEAMBinSceneSource(), mesh)
    for name, value in (("Copies", 4), ("Seed", 7), ("Width", W), ("Height", H), ("BinSize", 200)):
        getattr(source, "Set" + name)(value)
    run(source)
    return source


def halves(bins):
    """The left half of one scan, the right half of the other: the bins are alike."""
    left = numpy.tile(numpy.arange(W) < W // 2, H)
    scan = vtkStructuredGrid()
    scan.DeepCopy(bins[0].GetOutput())
    for of in (lambda data: data.GetPoints().GetData(), lambda data: data.GetPointData().GetArray("Intensity")):
        mine, other = (vtk_to_numpy(of(data)) for data in (scan, bins[1].GetOutput()))
        mine[~left] = other[~left]
    return scan


bins = [bin_of(mesh) for mesh in meshes]
scan = halves(bins)


def asked(filter, parts=meshes, found=None, **properties):
    for part in parts:
        filter.AddInputDataObject(0, part)
    filter.SetInputDataObject(1, scan)
    if found:
        filter.SetInputDataObject(4, found)
    for name, value in dict(MaximumNumberOfPoses=0, MinimumProbability=0.5, **properties).items():
        getattr(filter, "Set" + name)(value)
    return filter


def answer(filter):
    run(filter)
    return filter.GetOutputDataObject(3).GetValueByName(0, "Text").ToString().replace("\n", " ")


def matched(filter):
    """A point of the part at the place that the scan shows."""
    data = filter.GetOutput()
    rows = [k for k, state in enumerate(tuples(data, "State")) if state == (0,)]
    return data.GetPoint(rows[len(rows) // 2])


def place(filter):
    return filter.GetOutput().GetFieldData().GetArray("Transform").GetTuple(0)


def rows_of(data, keep):
    """The poses that are kept."""
    kept = [k for k in range(data.GetNumberOfPoints()) if keep(k)]
    return cloud([data.GetPoint(k) for k in kept], **{name: [tuples(data, name)[k] for k in kept]
                                                     for name in ("Transform", "PlaceProbability", "Probability", "Rank", "PartId")})


estimation = asked(vtkMEAMPoseEstimation())
found = run(estimation)
parts, transforms = [int(part) for part, in tuples(found, "PartId")], tuples(found, "Transform")
check(sorted(set(parts)) == [0, 1] and len(parts) >= 5, f"both types are found: {parts}")

# Of each pose its own type tells, by its rank and by a point on it.
why = asked(vtkMEAMPoseDiagnosis(), found=found)
on = []
for k, part in enumerate(parts):
    why.SetPlaceToRankedPose()
    why.SetRankOfPose(k + 1)
    for ask in (lambda: None, lambda: (why.SetPlaceToPoint(), why.SetPosition(matched(why)))):
        ask()
        text = answer(why)
        check(text.startswith(f"About part {part + 1} (PartId {part}). Found as rank {k + 1}, "), text)
        check(field(why.GetOutput(), "PartId") == [(part,)] and distance(place(why)[3::4], transforms[k][3::4]) < 0.1, f"of pose {k}")
    check(field(why.GetOutput(), "Diameter") == [field(found, "Diameter")[part]], "its diameter")
    on.append(matched(why))

# Where none came out: of the type that is there, by a search for both; or of the one that is chosen.
for part in (0, 1):
    missing = parts.index(part)
    why = asked(vtkMEAMPoseDiagnosis(), found=rows_of(found, lambda k: k != missing))
    why.SetPosition(on[missing])
    text = answer(why)
    check(text.startswith(f"About part {part + 1} (PartId {part}), which of 2 types has most evidence there. Found as rank "), text)
    shares = []
    why.AddObserver("ProgressEvent", lambda caller, event: shares.append(caller.GetProgress()))
    why.SetPartId(1 - part)
    text = answer(why)
    check(text.startswith(f"About part {2 - part} (PartId {1 - part}). "), text)
    check(min(share for share in shares if share > 0) >= 0.8, f"nothing is searched again: {shares[:3]}")
    why.SetPosition(on[parts.index(part, missing + 1)])
    check(f"(PartId {1 - part}); rank " in answer(why) and f"part {part + 1} (PartId {part}), came out there." in answer(why), answer(why))
why.SetPartId(-1)
why.SetPosition(0, 0, 10)
check(answer(why).startswith("Of none of 2 types a pose has its surface there. No part there"), answer(why))

# A pose laid by hand is of the type that is there; poses of a file are of the one that is chosen.
laid = asked(vtkMEAMPoseDiagnosis(), found=poses(transforms[parts.index(1)]))
laid.SetPlaceToRankedPose()
check(answer(laid).startswith("About part 2 (PartId 1), which of 2 types "), answer(laid))
laid.SetPartId(1)
check(answer(laid).startswith("About part 2 (PartId 1). Found as rank "), answer(laid))
laid.SetPartId(2)
fails(laid, "no type of part 2", "of 2 the first is 0")

# With one of the CADs what came out of the search for both is as poses that were laid; of three types one is missing.
alone = asked(vtkMEAMPoseDiagnosis(), [meshes[0]], found)
alone.SetPosition(on[parts.index(0)])
check(answer(alone).startswith("Found as rank "), answer(alone))
third = rows_of(found, lambda k: True)
third.GetPointData().GetArray("PartId").SetComponent(0, 0, 2)
fails(asked(vtkMEAMPoseDiagnosis(), found=third), "more types of part than the 2", "connect all")
prints(alone, "PartId")
