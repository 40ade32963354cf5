# SPDX-License-Identifier: BSD-3-Clause
"""An input or a file that is forgotten is told in one sentence, which names it, on the console as well."""
import os
import subprocess
import tempfile

import ppfmeam.filters
from meamtest import Errors, check, concrete_classes, connect, fails, is_empty

INPUTS = {
    "vtkMEAMPoseEstimation": ("Part", "Scan"),
    "vtkMEAMPoseDiagnosis": ("Part", "Scan"),
    "vtkMEAMPoseDetection": ("Scene Edges", "Model"),
    "vtkMEAMPoseScreening": ("Poses", "Model", "Scene Edges"),
    "vtkMEAMPoseVerification": ("Poses", "Model", "Scene Edges"),
    "vtkMEAMPoseSelection": ("Poses", "Model", "Scene Edges"),
    "vtkMEAMPoseRefinement": ("Poses", "Model", "Scene Edges"),
    "vtkMEAMConflictResolution": ("Poses", "Models", "Scene Edges"),
    "vtkMEAMPoseInstances": ("Poses", "Part"),
    "vtkMEAMGraspDefinition": ("Part",),
    "vtkMEAMPoseEvaluation": ("Poses", "True Poses"),
    "vtkMEAMBOPEvaluation": ("Poses", "True Poses", "Mesh", "Scan"),
}
for name, inputs in INPUTS.items():
    filter = getattr(ppfmeam.filters, name)()
    errors = Errors(filter)
    filter.Update()
    check(f"Nothing is connected to the input {', '.join(inputs)}: choose" in errors.messages[0], f"{name}: {errors}")
    check(is_empty(filter.GetOutputDataObject(0)), f"{name} has an output")

# Every reader: no file, one that is not there, one of another kind.
for kind in concrete_classes():
    if kind.__name__.endswith("Reader"):
        fails(kind(), "no file")
        camera = {"FocalLength": (100, 100), "PrincipalPoint": (1, 1)} if kind is ppfmeam.filters.vtkMEAMDepthImageReader else {}
        fails(connect(kind(), FileName="/no/such/file", **camera), "/no/such/file")
        can_read = getattr(kind(), "CanReadFile", lambda path: 0)
        check(not can_read(__file__) and not can_read("/no/such/file"), kind.__name__)

# An image with the name of a scan is told, in letters: no other reader would take it.
with tempfile.TemporaryDirectory() as folder:
    for ending, reader in (("pcd", ppfmeam.filters.vtkMEAMPCDReader), ("ply", ppfmeam.filters.vtkMEAMPLYReader),
                           ("xyz", ppfmeam.filters.vtkMEAMXYZReader)):
        path = os.path.join(folder, f"image.{ending}")
        with open(path, "wb") as file:
            file.write(b"\x89PNG\r\n\x1a\n" + bytes(range(256)) * 9)
        check(reader().CanReadFile(path), f"another reader has to take {path}")
        asked = connect(reader(), FileName=path)
        errors = Errors(asked)
        asked.Update()
        check(errors.messages and path in errors.messages[0] and errors.messages[0].replace("\n", "").isprintable(), f"{ending}: {errors}")

# Without observers it is all that is written.
run = subprocess.run(["/usr/bin/python3", "-c", "import ppfmeam.filters as f; f.vtkMEAMPoseEstimation().Update()"],
                     stderr=subprocess.PIPE, text=True)
lines = [line for line in run.stderr.splitlines() if line.strip()]
check(len(lines) <= 2 and "the input Part, Scan: choose" in lines[-1], f"on the console: {run.stderr}")
