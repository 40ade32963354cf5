# SPDX-License-Identifier: BSD-3-Clause
"""A scan of two types of part, plates in its left half and brackets in its right one. Not a test."""
import os

import numpy
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkCommonDataModel import vtkStructuredGrid
from vtkmodules.vtkIOGeometry import vtkSTLWriter

from ppfmeam.filters import vtkMEAMBinSceneSource
from meamtest import bracket, connect, plate, run, written

W, H = 640, 480
HALF = numpy.tile(numpy.arange(W) >= W // 2, H)  # the right one, row by row


def two_types(seed=7):
    """The meshes and the scan: of two bins, which are alike, the halves."""
    meshes, bins = [plate(), bracket()], []
    for mesh in meshes:
        source = connect(vtkMEAMBinSceneSource(), mesh, Copies=4, Seed=seed, Width=W, Height=H, BinSize=200)
        bins.append(run(source))
        meshes[len(bins) - 1] = source.GetOutputDataObject(2)
    scan = vtkStructuredGrid()
    scan.DeepCopy(bins[0])
    for of in (lambda data: data.GetPoints().GetData(), lambda data: data.GetPointData().GetArray("Intensity")):
        vtk_to_numpy(of(scan))[HALF] = vtk_to_numpy(of(bins[1]))[HALF]
    return meshes, scan


def write(folder):
    """plate.stl, bracket.stl and scan.pcd."""
    meshes, scan = two_types()
    for name, mesh in zip(("plate", "bracket"), meshes):
        written(os.path.join(folder, f"{name}.stl"), mesh, vtkSTLWriter)
    columns = numpy.column_stack((vtk_to_numpy(scan.GetPoints().GetData()), vtk_to_numpy(scan.GetPointData().GetArray("Intensity"))))
    with open(os.path.join(folder, "scan.pcd"), "wb") as file:
        file.write(f"VERSION .7\nFIELDS x y z intensity\nSIZE 4 4 4 4\nTYPE F F F F\nCOUNT 1 1 1 1\nWIDTH {W}\nHEIGHT {H}\n"
                   f"POINTS {W * H}\nDATA binary\n".encode())
        file.write(columns.astype("<f4").tobytes())
