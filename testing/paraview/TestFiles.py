# SPDX-License-Identifier: BSD-3-Clause
"""Poses saved and opened, and OFF meshes opened, as the application does it: by the file's extension, with our writer and
our readers."""
import os
import tempfile

from paraview import simple

folder = tempfile.TemporaryDirectory()


def check(condition, message):
    if not condition:
        raise AssertionError(message)


def transforms(source):
    source.UpdatePipeline()
    array = source.GetClientSideObject().GetOutputDataObject(0).GetPointData().GetArray("Transform")
    return [array.GetTuple(i) for i in range(array.GetNumberOfTuples())]


def path(name):
    return os.path.join(folder.name, name)


with open(path("truth.txt"), "w") as file:
    file.write("0 -1 0 1.5  1 0 0 -2  0 0 1 0.1  0 0 0 1\n1 0 0 7  0 1 0 8  0 0 1 9  0 0 0 1\n")
poses = simple.PoseReader(FileName=path("truth.txt"))
expected = transforms(poses)
check(len(expected) == 2, "two poses")
for extension, first in (("bop", "scene_id,im_id"), ("json", "{"), ("poses", "0 -1 0 1.5")):
    name = path("saved." + extension)
    simple.SaveData(name, poses)
    with open(name) as file:
        check(file.readline().startswith(first), f"{extension} is not written by Pose Writer")
    again = simple.OpenDataFile(name)
    check(again.GetXMLName() == "PoseReader" and transforms(again) == expected, f"{extension} does not come back")

with open(path("part.off"), "w") as file:
    file.write("OFF\n4 1 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n4 0 1 2 3\n")
part = simple.OpenDataFile(path("part.off"))
part.UpdatePipeline()
check(part.GetXMLName() == "MEAMMeshReader" and part.GetDataInformation().GetNumberOfCells() == 2, "an OFF file")

# Results of others are opened, too; tables of others are left to ParaView.
os.rename(path("saved.bop"), path("results.csv"))
reader = simple.PoseReader(FileName=path("results.csv"))
check(transforms(reader) == expected, "results of the benchmark")
with open(path("table.csv"), "w") as file:
    file.write("a,b\n1,2\n")
check(simple.OpenDataFile(path("table.csv")).GetXMLName() == "CSVReader", "a table is opened by our reader")
simple.SaveData(path("saved.csv"), poses)
with open(path("saved.csv")) as file:
    check("Transform" in file.readline(), "ParaView's own CSV has all arrays")
