# SPDX-License-Identifier: BSD-3-Clause
"""Poses saved and opened, clouds, OFF and STEP files opened, as the application does it: by the file's extension, with our writer
and our readers."""
import os
import shutil
import tempfile

from paraview import make_name_valid, servermanager, simple
from vtkmodules.vtkCommonCore import VTK_UNSIGNED_SHORT
from vtkmodules.vtkCommonDataModel import vtkImageData
from vtkmodules.vtkIOImage import vtkPNGWriter

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
rod = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "fuzz", "corpus", "step", "rod.step")
for name in ("part.step", "PART.STEP", "part.stp"):
    part = simple.OpenDataFile(shutil.copy(rod, path(name)))
    part.UpdatePipeline()
    check(part.GetXMLName() == "MEAMMeshReader" and part.GetDataInformation().GetNumberOfCells() > 100, name)

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

# A reader with several file properties opens the file as its data, not as its calibration or its image.
with open(path("camera.json"), "w") as file:
    file.write('{"fx": 10, "fy": 10, "cx": 2, "cy": 1, "width": 4, "height": 3}')
with open(path("cloud.ply"), "w") as file:
    file.write("ply\nformat ascii 1.0\nelement vertex 2\nproperty float x\nproperty float y\nproperty float z\nend_header\n"
               "0 0 100\n10 0 100\n")
with open(path("cloud.pcd"), "w") as file:
    file.write("VERSION .7\nFIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nCOUNT 1 1 1\nWIDTH 2\nHEIGHT 1\nPOINTS 2\nDATA ascii\n"
               "0 0 100\n10 0 100\n")
depth = vtkImageData()
depth.SetDimensions(4, 3, 1)
depth.AllocateScalars(VTK_UNSIGNED_SHORT, 1)
depth.GetPointData().GetScalars().Fill(100)
writer = vtkPNGWriter()
writer.SetFileName(path("depth.png"))
writer.SetInputData(depth)
writer.Write()
with open(path("cloud.asc"), "w") as file:
    file.write("X;Y;Z\n0;0;100\n10,0;0;100\n")
FILES = {"XYZCloudReader": "cloud.asc", "PLYCloudReader": "cloud.ply", "PCDReader": "cloud.pcd", "DepthImageReader": "depth.png"}


def readers_of_several_files():
    manager = servermanager.ProxyManager().SMProxyManager
    definitions = manager.GetProxyDefinitionManager().NewSingleGroupIterator("sources")
    while not definitions.IsDoneWithTraversal():
        reader = manager.GetPrototypeProxy("sources", definitions.GetProxyName())
        files = servermanager.vtkSMCoreUtilities.GetFileNameProperties(reader)
        if len(files) > 1 and reader.GetVTKClassName().startswith("vtkMEAM"):
            yield reader
        definitions.GoToNextItem()


several = {reader.GetXMLName(): reader for reader in readers_of_several_files()}
check(set(several) == set(FILES), f"readers with several files: {sorted(several)}; of each a file has to be opened")
for name, reader in several.items():
    file = path(FILES[name])
    if reader.GetHints().FindNestedElementByName("ReaderFactory"):
        opened = simple.OpenDataFile(file, CameraFile=path("camera.json"))
    else:  # of the menu Sources
        file_property = servermanager.vtkSMCoreUtilities.GetFileNameProperty(reader)
        opened = getattr(simple, make_name_valid(reader.GetXMLLabel()))(**{file_property: file, "CameraFile": path("camera.json")})
    check((opened.GetXMLName(), opened.FileName) == (name, file), f"{name} takes {opened.FileName} for its data")
    opened.UpdatePipeline()
    check(opened.GetDataInformation().GetNumberOfPoints() == 12, f"{name} does not read the camera's 4 x 3 pixels")
cloud = simple.OpenDataFile(path("cloud.ply"))
cloud.UpdatePipeline()
check(cloud.GetDataInformation().GetNumberOfPoints() == 2, "the points of a cloud without a camera")

# A page is of what MEAM Pose Estimation found: of other data it is an error, and no file.
simple.SaveData(path("page.html"), part)
check(not os.path.exists(path("page.html")), "a page of a part")
