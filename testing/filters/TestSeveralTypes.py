# SPDX-License-Identifier: BSD-3-Clause
"""What follows MEAM Pose Estimation of two types of part: Pose Diagnosis of poses of each, and of places where none came out; Pick
Planning with the grasps of each."""
from ppfmeam.filters import vtkMEAMGraspDefinition, vtkMEAMPickPlanning, vtkMEAMPoseDiagnosis, vtkMEAMPoseEstimation, vtkMEAMPoseInstances
from ppfmeam.report.content import rank_colors
from ppfmeam.report.told import reasons
from meamtest import check, cloud, connect, distance, fails, field, poses, run, text, texts, tuples
from twotypes import two_types

CUP = 8  # mm
meshes, scan = two_types(22)  # of which two of each type are likely


def asked(filter, parts=meshes, found=None, **properties):
    for part in parts:
        filter.AddInputDataObject(0, part)
    return connect(filter, None, scan, None, None, found, MaximumNumberOfPoses=0, MinimumProbability=0.5, **properties)


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
check(sorted(parts) == [0, 0, 1, 1], f"both types are found: {parts}")

# Of each pose its own type tells, by its rank and by a point on it.
why = asked(vtkMEAMPoseDiagnosis(), found=found)
on = []
for k, part in enumerate(parts):
    why.SetPlaceToRankedPose()
    why.SetRankOfPose(k + 1)
    for ask in (lambda: None, lambda: (why.SetPlaceToPoint(), why.SetPosition(matched(why)))):
        ask()
        told = answer(why)
        check(told.startswith(f"About part {part + 1} (PartId {part}). Found as rank {k + 1}, "), told)
        check(field(why.GetOutput(), "PartId") == [(part,)] and distance(place(why)[3::4], transforms[k][3::4]) < 0.1, f"of pose {k}")
    check(field(why.GetOutput(), "Diameter") == [field(found, "Diameter")[part]], "its diameter")
    on.append(matched(why))

# So a page says it of each.
said = reasons(found, meshes, (scan, None, None), lambda filter: filter.SetMaximumNumberOfPoses(0))
check(len(set(rank_colors(found))) == len(parts[:10]) + (len(parts) > 10), f"a color for each rank: {rank_colors(found)}")
check(len(said) == len(parts) and all(text.startswith("Most for it: ") for text in said), said)

# Where none came out: of the type that is there, by a search for both; or of the one that is chosen.
for part in (0, 1):
    missing = parts.index(part)
    why = asked(vtkMEAMPoseDiagnosis(), found=rows_of(found, lambda k: k != missing))
    why.SetPosition(on[missing])
    told = answer(why)
    check(told.startswith(f"About part {part + 1} (PartId {part}), which of 2 types has most evidence there. Found as rank "), told)
    shares = []
    why.AddObserver("ProgressEvent", lambda caller, event: shares.append(caller.GetProgress()))
    why.SetPartId(1 - part)
    told = answer(why)
    check(told.startswith(f"About part {2 - part} (PartId {1 - part}). "), told)
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

known = poses(transforms[parts.index(1)])
known.GetPointData().AddArray(cloud([(0, 0, 0)], PartId=[1]).GetPointData().GetArray("PartId"))
laid.SetInputDataObject(4, known)
check(answer(laid).startswith("About part 2 (PartId 1). Found as rank "), answer(laid))

# With one of the CADs what came out of the search for both is as poses that were laid; of three types one is missing.
alone = asked(vtkMEAMPoseDiagnosis(), [meshes[0]], found)
alone.SetPosition(on[parts.index(0)])
check(answer(alone).startswith("Found as rank "), answer(alone))
third = rows_of(found, lambda k: True)
third.GetPointData().GetArray("PartId").SetComponent(0, 0, 2)
fails(asked(vtkMEAMPoseDiagnosis(), found=third), "The poses are of 3 types", "connect all to Part", "not 2")
fails(asked(vtkMEAMPoseDiagnosis(), meshes[::-1], found), "another order")

# Each at its poses, the best of all.
instances = connect(vtkMEAMPoseInstances(), found)
for mesh in meshes:
    instances.AddInputDataObject(1, mesh)
for most in (0, 3):
    instances.SetMaximumNumberOfInstances(most)
    copies = run(instances)
    check({(int(part), int(rank)) for (part,), (rank,) in zip(tuples(copies, "PartId"), tuples(copies, "Rank"))}
          == {(part, k) for k, part in enumerate(parts[:most or None], 1)}, f"copies of the best {most}")
check(copies.GetPointData().GetScalars().GetName() == "PartId", "colored by type")

# Picks of each type with its own grasps, best first; what is of the other type stands in the way, too.
def grasps_of(mesh):
    filter = connect(vtkMEAMGraspDefinition(), mesh, Propose=vtkMEAMGraspDefinition.Suction, CupDiameter=CUP)
    return run(filter)


def planning(meshes, grasps, found=found):
    filter = connect(vtkMEAMPickPlanning(), found, Gripper=vtkMEAMPickPlanning.SuctionCup, CupDiameter=CUP)
    for port, inputs in ((1, meshes), (2, grasps)):
        for data in inputs:
            filter.AddInputDataObject(port, data)
    filter.SetInputDataObject(3, scan)
    filter.SetBinToNone()
    return filter


held = [grasps_of(mesh) for mesh in meshes]
plan = planning(meshes, held)
picks = run(plan)
of = [int(part) for part, in tuples(picks, "PartId")]
instances, number = ([int(value) for value, in tuples(picks, name)] for name in ("Instance", "Grasp"))
check([parts[instance - 1] for instance in instances] == of, "the type of each pick is that of its pose")
for part in (0, 1):
    count = held[part].GetNumberOfPoints()
    check(sorted(g for g, p in zip(number, of) if p == part) == sorted(list(range(1, count + 1)) * parts.count(part)), f"grasps of {part}")
names = [texts(data, "GraspName") for data in (picks, *held)]
check(all(names[0][k] == names[1 + part][g - 1] for k, (part, g) in enumerate(zip(of, number))), "their names")
possible = [p for p, in tuples(picks, "Possible")]
check(possible == sorted(possible, reverse=True) and {part for part, p in zip(of, possible) if p} == {0, 1}, f"possible of both: {possible}")
check(f" of {len(parts)} copies can be picked" in text(picks, "PickReport"), "the report")
for wrong in (planning(meshes[:1], held[:1]), connect(vtkMEAMPoseInstances(), found, meshes[0])):
    fails(wrong, "The poses are of 2 types", "connect all to Part", "not 1")
fails(planning(meshes, held[:1]), "connect to Grasps the grasps of each type", "2 meshes and 1 sets of grasps")
fails(planning(meshes, held, third), "The poses are of 3 types", "not 2")
fails(planning(meshes[::-1], held[::-1]), "Mesh 1 of the input Part is not as large")
first = run(planning(meshes[:1], held[:1], rows_of(found, lambda k: parts[k] == 0)))
check(not first.GetPointData().HasArray("PartId") and first.GetNumberOfPoints() == of.count(0), "one type alone")
