# SPDX-License-Identifier: BSD-3-Clause
"""A part made here is trained, saved and loaded: the same poses come out. Damaged files are told apart."""
import math
import os
import shutil

from vtkmodules.vtkCommonCore import vtkIntArray
from vtkmodules.vtkCommonDataModel import vtkPartitionedDataSetCollection
from vtkmodules.vtkIOParallelXML import vtkXMLPartitionedDataSetCollectionWriter
from vtkmodules.vtkIOXML import vtkXMLPartitionedDataSetCollectionReader

from ppfmeam.filters import (
    vtkMEAMHashing,
    vtkMEAMPoseDetection,
    vtkMEAMTangentEstimation,
)
from meamtest import (Folder, MovedView, Trained, bracket, check, cloud, collection, connect, fails, field, is_empty,
                      partitions, pose_error, run, set_fields, tuples)
from chains import Detection


def detect(scene, model):
    """The online phase on an edge cloud alone."""
    chain = Detection(model, scene.edges)
    chain.detection.SetReferenceShare(0.5)
    chain.set_sensor(view_direction=scene.looking)
    chain.selection.SetMaximumNumberOfPoses(5)
    return run(chain.selection)


def write(collection, path):
    writer = connect(vtkXMLPartitionedDataSetCollectionWriter(), collection, FileName=path)
    writer.SetDataModeToBinary()
    check(writer.Write() == 1, "the writer failed")


def read(path):
    reader = connect(vtkXMLPartitionedDataSetCollectionReader(), FileName=path)
    reader.Update()  # of damaged files, too
    return reader.GetOutput()


def pieces(path, names):
    """The file of each partition, by name."""
    folder = os.path.splitext(path)[0]
    files = sorted(os.listdir(folder), key=lambda file: int(file.split("_")[1]))  # model_3_0.vtp
    return dict(zip(names, (os.path.join(folder, file) for file in files)))


def same_poses(a, b):
    check(a.GetNumberOfPoints() == b.GetNumberOfPoints() > 0, "another number of poses")
    for name in ("Transform", "Quaternion", "Score", "Votes", "ViewId", "VisibleFraction", "Rank"):
        check(tuples(a, name) == tuples(b, name), f"{name} differs")


trained = Trained(bracket())
model = run(trained.model)
diameter = field(model, "Diameter")[0][0]
check(abs(diameter - math.sqrt(40**2 + 25**2 + 15**2)) < 1e-3, f"the diameter is {diameter}")
names = [name for name, _ in partitions(model)]
expected = [f"View {v}" for v in range(6)] + ["Edges", "Surface", "SurfacePairPoints", "PairTableBuckets", "PairTableEntries",
                                              "SurfacePairTableBuckets", "SurfacePairTableEntries"]
check(names == expected, f"the partitions are {names}")
check(field(model, "NumberOfPairs")[0][0] == dict(partitions(model))["PairTableEntries"].GetNumberOfPoints() > 1000,
      "pairs")
bounds = [0.0] * 6
model.GetBounds(bounds)
check(all(abs(b - e) < 0.1 for b, e in zip(bounds, (0, 40, 0, 25, 0, 15))),
      f"it is shown from {bounds}, not like the part")

# The edges seen from above, moved: the motion is found again.
scene = MovedView(trained)
poses = detect(scene, model)
translation, rotation = pose_error(tuples(poses, "Transform")[0], scene.transform)
print(f"found with an error of {translation:.4f} mm and {rotation:.4f} degrees, D = {diameter:.2f} mm")
check(translation < 0.01 * diameter and rotation < 1.0,
      f"the motion is not found: {translation} mm, {rotation} degrees")
check(tuples(poses, "Rank")[0] == (1,), "the best pose has rank 1")
check(math.dist(poses.GetPoint(0), scene.transform[3:12:4]) < 0.01 * diameter, "the point is the part's origin")

folder = Folder()
path = folder("model.vtpc")
write(model, path)
loaded = read(path)
check([name for name, _ in partitions(loaded)] == names, "other partitions after loading")
same_poses(poses, detect(scene, loaded))

# The paper's parameters are kept, too.
hashing = connect(vtkMEAMHashing(), trained.tangents, trained.symmetries)
hashing.SetParametersToPaper()
hashing.SetVoxelSize(1.25)
paper = run(hashing)
check(field(paper, "Feature") == [(0,)] and field(paper, "AngleStep") == [(3.6,)], "the paper's parameters")
write(paper, folder("paper.vtpc"))
loaded_paper = read(folder("paper.vtpc"))
for name in ("Feature", "DistanceStep", "AngleStep", "ViewMerging", "VoxelSize", "CoVisibilityDirections"):
    check(field(loaded_paper, name) == field(paper, name), f"{name} is not kept")
same_poses(detect(scene, paper), detect(scene, loaded_paper))

# A view without edges and a model without surface are no damage.
views = [(name, data) for name, data in partitions(run(trained.tangents))]
nothing = set_fields(cloud([], Tangent=[]), ViewDirection=(1, 1, 1))
sparse = run(connect(vtkMEAMHashing(), collection(*views, ("nothing", nothing), Diameter=diameter)))
write(sparse, folder("sparse.vtpc"))
same_poses(detect(scene, sparse), detect(scene, read(folder("sparse.vtpc"))))

# A file cut short, or one that holds another piece, is told by the first step that uses it.
tangents = connect(vtkMEAMTangentEstimation(), scene.edges, model)


def detection(collection):
    return connect(vtkMEAMPoseDetection(), tangents, collection)


for name in ("View 2", "Edges", "Surface", "PairTableBuckets", "PairTableEntries"):
    file = pieces(path, names)[name]
    shutil.copy(file, file + ".whole")
    os.truncate(file, os.path.getsize(file) // 2)
    print(f"expected errors of the reader ({name} cut short):", flush=True)
    fails(detection(read(path)), "trained model", name, "train the model again")
    os.rename(file + ".whole", file)
shutil.copy(pieces(path, names)["View 4"], pieces(path, names)["View 5"])
fails(detection(read(path)), "View 5", "train the model again")


def copy():
    result = vtkPartitionedDataSetCollection()
    result.DeepCopy(loaded)
    return result


def changed(name, value):
    array = vtkIntArray()
    array.SetName(name)
    array.InsertNextValue(value)
    result = copy()
    result.GetFieldData().AddArray(array)
    return result

fails(detection(changed("FormatVersion", 99)), "version 99", "version 4", "train the model again")
fails(detection(changed("NumberOfPairs", 17)), "PairTableEntries")
fails(detection(changed("NumberOfViews", 5)), "view")
fails(detection(changed("DistanceStep", 1)), "PairTableBuckets")
for name in ("FormatVersion", "Units", "Diameter", "AngleStep", "ViewDirections"):
    incomplete = copy()
    incomplete.GetFieldData().RemoveArray(name)
    fails(detection(incomplete), "trained model")
for name, array in (("Edges", "Tangent"), ("Edges", "ViewBits"), ("Surface", "Normals"),
                    ("PairTableBuckets", "Offset"), ("PairTableEntries", "Angle")):
    incomplete = copy()
    dict(partitions(incomplete))[name].GetPointData().RemoveArray(array)
    fails(detection(incomplete), "trained model")
for name, array, value in (
    ("PairTableEntries", "Reference", 4000000000),
    ("PairTableBuckets", "Offset", 4000000000),
    ("PairTableEntries", "Angle", math.nan),
    ("Edges", "Tangent", math.inf),
    ("Edges", "ViewBits", 0),
):
    damaged = copy()
    dict(partitions(damaged))[name].GetPointData().GetArray(array).SetComponent(7, 0, value)
    fails(detection(damaged), "damaged", "train the model again")
disordered = copy()
parts = dict(partitions(disordered))
references = parts["PairTableEntries"].GetPointData().GetArray("Reference")
offsets = parts["PairTableBuckets"].GetPointData().GetArray("Offset")
starts = [int(offsets.GetValue(k)) for k in range(offsets.GetNumberOfTuples())]
first = next(a for a, b in zip(starts, starts[1:])
             if b - a > 1 and references.GetValue(a) < references.GetValue(a + 1))
references.SetValue(first, references.GetValue(first + 1) + 1)
fails(detection(disordered), "damaged", "train the model again")
fails(detection(trained.tangents.GetOutputDataObject(0)), "not a trained model", "MEAMHashing")
fails(detection(vtkPartitionedDataSetCollection()), "not a trained model")
check(not is_empty(run(detection(copy()))), "the model itself is fine")
