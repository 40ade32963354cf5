#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Writes the parts of this folder, binary STL files in mm, as vtkMEAMSamplePartSource makes them."""
import os

from vtkmodules.vtkIOGeometry import vtkSTLWriter

from ppfmeam import filters, scripting

PARTS = {"RidgedDisc": "ridged_disc", "ArcLever": "arc_lever", "Flap": "flap", "HolePlate": "hole_plate",
         "PipeElbow": "pipe_elbow", "Cap": "cap", "Knob": "knob", "Handle": "handle"}


def main():
    for part, name in PARTS.items():
        source, writer = filters.vtkMEAMSamplePartSource(), vtkSTLWriter()
        scripting.set_choice(source, "Part", part)
        writer.SetInputDataObject(scripting.update(source).GetOutput())
        writer.SetFileName(os.path.join(os.path.dirname(os.path.abspath(__file__)), name + ".stl"))
        writer.SetHeader(f"PPFMEAM {name}, millimetres")
        writer.SetFileTypeToBinary()
        scripting.update(writer, "Write")
        print(f"{name}.stl: {source.GetOutput().GetNumberOfPolys()} triangles")


scripting.run(main)
