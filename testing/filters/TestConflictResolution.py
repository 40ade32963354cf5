# SPDX-License-Identifier: BSD-3-Clause
"""Two types of part in one scene: each place goes to the part that is there; arrays, numbers and bad input."""
import math

from vtkmodules.vtkCommonDataModel import vtkPolyData
from vtkmodules.vtkFiltersCore import vtkThreshold
from vtkmodules.vtkFiltersGeometry import vtkGeometryFilter

from ppfmeam.filters import (vtkMEAMConflictResolution, vtkMEAMPoseInstances, vtkMEAMPoseVerification,
                             vtkMEAMPoseWriter, vtkMEAMTangentEstimation)
from meamtest import (Folder, MovedView, Trained, box, bracket, check, close, cloud, connect, fails, field, image, is_empty,
                      points, poses, run, tuples)

meshes = (bracket(), box(40, 25, 15))  # an L, and the block that it was cut from
trained = [Trained(mesh) for mesh in meshes]
models = [run(part.model) for part in trained]
views = [MovedView(part) for part in trained]
looking = views[0].looking
check(close(looking, views[1].looking, 1e-6), "the first view of both parts is from the same side")
aside = [100 * c for c in (looking[1], -looking[0], 0)]
aside = [c * 100 / math.hypot(*aside) for c in aside]


def shifted(transform, by):
    return tuple(c + (by[i // 4] if i in (3, 7, 11) else 0) for i, c in enumerate(transform))


def middle(transform):
    """Where the middle of the block is: its half turns leave it there."""
    return [sum(a * b for a, b in zip(transform[4 * row:4 * row + 4], (20, 12.5, 7.5, 1))) for row in range(3)]


def part_ids(data):
    return [int(part) for part, in tuples(data, "PartId")]


def scan(name):
    """The bracket, and the block beside it."""
    return cloud(points(getattr(views[0], name))
                 + [tuple(a + b for a, b in zip(p, aside)) for p in points(getattr(views[1], name))])


edges = run(connect(vtkMEAMTangentEstimation(), scan("edges"), models[0]))
surface = scan("surface")
places = [views[0].transform, shifted(views[1].transform, aside)]  # of the bracket, of the block


def verified(model, *transforms):
    return run(connect(vtkMEAMPoseVerification(), poses(*transforms), model, edges, surface, ViewDirection=looking))


def resolution(found, models, surface=surface, edges=edges, **properties):
    filter = vtkMEAMConflictResolution()
    for port, inputs in enumerate((found, models)):
        for data in inputs:
            filter.AddInputDataObject(port, data)
    return connect(filter, None, None, edges, surface, **{"ViewDirection": looking, **properties})


# Both parts were looked for in both places.
found = [verified(model, *places) for model in models]
check([data.GetNumberOfPoints() for data in found] == [2, 2], "each part has a pose at each place")
for only in (surface, None):
    stay = run(resolution(found, models, only))
    parts = part_ids(stay)
    check(sorted(parts) == [0, 1], f"each part once: {parts}")
    for part, transform in zip(parts, tuples(stay, "Transform")):
        check(close(middle(transform), middle(places[part]), 1e-6), f"part {part} is at {transform}")
stay = run(resolution(found, models))
check(tuples(stay, "Rank") == [(1,), (2,)], "ranks over all parts")
names = {data.GetArrayName(i) for data in (found[0].GetPointData(),) for i in range(data.GetNumberOfArrays())}
kept = {stay.GetPointData().GetArrayName(i) for i in range(stay.GetPointData().GetNumberOfArrays())}
check(kept == names | {"PartId"}, f"arrays {kept ^ names}")
check(stay.GetPointData().GetScalars().GetName() == "Score", "coloured by the score")
check(close([d for d, in field(stay, "Diameter")], [field(model, "Diameter")[0][0] for model in models]),
      "a diameter for each part")
swapped = run(resolution(found[::-1], models[::-1]))
check(tuples(swapped, "Transform") == tuples(stay, "Transform"), "the order of the parts does not matter")
check([1 - part for part in part_ids(swapped)] == part_ids(stay), "but for numbers")
check(run(resolution(found, models, MaximumShared=1.0)).GetNumberOfPoints() == 4, "all stay")
best = run(resolution(found, models, MaximumNumberOfPoses=1))
check(tuples(best, "Transform") == tuples(stay, "Transform")[:1], "the best alone")
check(tuples(run(resolution(found, models, NumberOfThreads=1)), "Transform") == tuples(stay, "Transform"), "threads")

# One part alone, none found, nothing of one of them.
alone = run(resolution(found[:1], models[:1]))
check(tuples(alone, "Transform") == tuples(found[0], "Transform"), "one part: all as it was")
check(is_empty(run(resolution([vtkPolyData()] * 2, models))), "no poses, no error")
check(set(part_ids(run(resolution([vtkPolyData(), found[1]], models)))) == {1}, "poses of the second only")

# Each part's mesh at its poses, and its number in a file.
for part, mesh in enumerate(meshes):
    of_part = connect(vtkThreshold(), stay)
    of_part.SetInputArrayToProcess(0, 0, 0, 0, "PartId")
    of_part.SetLowerThreshold(part)
    of_part.SetUpperThreshold(part)
    as_poses = connect(vtkGeometryFilter(), of_part)
    copies = run(connect(vtkMEAMPoseInstances(), as_poses, mesh))
    check(copies.GetNumberOfPoints() == mesh.GetNumberOfPoints(), f"one copy of part {part}")
    rank = part_ids(stay).index(part) + 1
    check({r for r, in tuples(copies, "Rank")} == {rank}, f"part {part} has rank {rank} of all")
folder = Folder()
check(connect(vtkMEAMPoseWriter(), stay, FileName=folder("poses.csv")).Write() == 1, "Write() succeeds")
numbers = [int(row.split(",")[2]) for row in folder.text("poses.csv").splitlines()[1:]]
check(numbers == [part + 1 for part in part_ids(stay)], f"the parts are numbered from 1: {numbers}")

fails(resolution(found, models[:1]), "poses of 2 parts", "models of 1")
fails(resolution(found[:1], models), "poses of 1 parts", "models of 2")
fails(resolution(found, models, edges=scan("edges")), "Tangent", "TangentEstimation")
fails(resolution(found, [models[0], run(trained[0].tangents)]), "not a trained model")
fails(resolution([found[0], surface], models), "Transform")
fails(resolution([found[0], image()], models), "vtkPolyData")
fails(resolution(found, []), "the input Models")
metres = cloud([tuple(1e-3 * c for c in p) for p in points(edges)], Tangent=tuples(edges, "Tangent"))
fails(resolution(found, models, None, metres), "units differ")

filter = vtkMEAMConflictResolution()
filter.AddInputDataObject(1, models[0])
filter.RemoveAllModelConnections()
check(filter.GetNumberOfInputConnections(1) == 0, "no model is left")
