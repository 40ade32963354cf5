# SPDX-License-Identifier: BSD-3-Clause
"""The page Help > PPFMEAM: New Part, by clicks: what is wrong with its files is a sentence in it; with a part, a scan, a
gripper and a robot frame it shows poses and picks and writes a model and programs. The program in Python finds what ParaView
shows, with --long the one in C++, too.

Usage: TestNewPart.py [--long] PARAVIEW PVPYTHON REPOSITORY BUILD; with PPFMEAM_PICTURE=FOLDER a picture of the window goes
there, that of docs/gallery.md (needs python3-pil).
"""
import os
import re
import runpy
import shutil
import subprocess
import sys
import tempfile

import numpy

from clicks import APPLY, NEW_PART, PAGE, START, check, event, expect, files, new_part_choice, new_part_file, new_part_length, new_part_number, play, shoot


def answer(text):
    return [START, expect(f"{PAGE}/Answer", "text", text)]


def wrong(folder):
    """Files that are none."""
    return [*answer("Choose a CAD file."), new_part_file("CAD", f"{folder}/missing.stl"), *answer("Choose a scan."),
            new_part_file("Scan", f"{folder}/scan.pcd"), *answer(f"There is no file {folder}/missing.stl."),
            new_part_file("CAD", f"{folder}/scan.pcd"), *answer(f"The mesh file '{folder}/scan.pcd' has an extension that is not known: give a .step, .iges, .stl, .obj, .ply or .off."),
            new_part_file("CAD", f"{folder}/cut.stl"), *answer(f"The mesh file '{folder}/cut.stl' is cut off, or is no STL file."),
            new_part_file("CAD", f"{folder}/part.stl"), new_part_file("Scan", f"{folder}/part.stl"),
            *answer(f"{folder}/part.stl is no scan: choose a PCD, a PLY, a text of points (XYZ, CSV, TXT, ASC, PTS), or a depth image as PNG, TIFF, PGM or PFM.")]


def solid(folder):
    """One of the solids of a STEP file, which has no other."""
    return [new_part_file("CAD", f"{folder}/rod.step"), new_part_file("Scan", f"{folder}/scan.pcd"), new_part_number("Solid", 2),
            *answer(f"The CAD file '{folder}/rod.step' holds 1 solid, no solid 2: choose 1, or 0 for all together."),
            new_part_number("Solid", 1), new_part_choice("Gripper", "Suction cup"), new_part_length("Size", 500),
            *answer("The part has no place for this gripper: give a smaller cup, or None to find the part alone."),
            new_part_choice("Gripper", "Parallel jaws"), START]


def metres(folder):
    """A mesh in another unit."""
    return [new_part_file("CAD", f"{folder}/metres.stl"), new_part_choice("CADUnit", "m"), START, new_part_choice("CADUnit", "mm")]


def search_points_alone(paraview, folder):
    """The button of the toolbar takes points alone for a scan; the page of what it found is saved."""
    with open(os.path.join(folder, "scan.pcd"), "rb") as file:
        head, _, body = file.read().partition(b"DATA binary\n")
    points = numpy.frombuffer(body, "<f4").reshape(-1, 4)
    points = points[numpy.isfinite(points).all(axis=1)]
    with open(os.path.join(folder, "alone.pcd"), "wb") as file:
        sizes = re.sub(rb"(WIDTH|POINTS) \d+", rb"\1 %d" % len(points), re.sub(rb"HEIGHT \d+", b"HEIGHT 1", head))
        file.write(sizes + b"DATA binary\n" + points.tobytes())
    play(paraview, folder, [*files("actionFileOpen", "FileOpenDialog", f"{folder}/part.stl"), *files("actionFileOpen", "FileOpenDialog", f"{folder}/alone.pcd"),
                            event("PoseEstimationToolbar/EstimatePoses", "activate"), APPLY,
                            *files("actionFileSaveData", "FileSaveDialog", f"{folder}/alone.html")])
    with open(os.path.join(folder, "alone.html")) as file:
        text = file.read()
    check("<title>part in alone.pcd</title>" in text and "<tr data-rank" in text, text[:400])


def look_at_programs(folder):
    """They take the solid and the unit that were chosen, and of another CAD all."""
    with open(os.path.join(folder, "find_metres", "find_metres.py")) as file:
        text = file.read()
    size = re.search(r"The part is ([\d.]+) mm long", text)
    check(size and float(size[1]) > 10 and f'"{folder}/metres.stl", scale=1000' in text, text)
    texts = {}
    for name in ("find_rod/find_rod.py", "find_rod/find_rod.cpp", "find_part/find_part.py"):
        with open(os.path.join(folder, name)) as file:
            texts[name] = file.read()
    python, cpp, other = texts.values()
    check(python.count(f'"{folder}/rod.step", solid=1') == 2 and f'meam::loadCAD("{folder}/rod.step", {{ 1 }});' in cpp, f"{python} {cpp}")
    check("solid" not in other and "scale=" not in other, other)


def right(folder):
    return [new_part_file("CAD", f"{folder}/part.stl"), new_part_file("Scan", f"{folder}/scan.pcd"),
            new_part_choice("Gripper", "Parallel jaws"), new_part_length("FingerWidth", 8),
            new_part_length("FingerThickness", 5), new_part_file("RobotFrame", f"{folder}/robot.json"), START]


def look(folder):
    """Poses and picks as ParaView has them."""
    from paraview import simple
    from vtkmodules.util.numpy_support import vtk_to_numpy

    simple.LoadState(os.path.join(folder, "state.pvsm"))
    names = sorted(name for name, _ in simple.GetSources())
    check(len(names) == 5, f"what is open: {names}")  # nothing is left of the files that were wrong
    for kind, array in (("MEAMPoseEstimation", "Transform"), ("PickPlanning", "RobotTransform")):
        source = simple.FindSource(f"{kind}1")
        source.UpdatePipeline()
        data = source.GetClientSideObject().GetOutputDataObject(0).GetPointData()
        numpy.save(os.path.join(folder, f"{kind}.npy"), vtk_to_numpy(data.GetArray(array)).reshape(-1, 4, 4))


def build_and_run(written, build, folder):
    """What the program in C++ prints, built against the installed library."""
    built = os.path.join(folder, "built")
    for command in (["cmake", "--install", build, "--prefix", f"{folder}/installed"],
                    ["cmake", "-S", written, "-B", built, "-DCMAKE_BUILD_TYPE=Release", f"-DCMAKE_PREFIX_PATH={folder}/installed"],
                    ["cmake", "--build", built]):
        subprocess.run(command, check=True, stdout=subprocess.DEVNULL)
    return subprocess.run([os.path.join(built, "find_part")], check=True, stdout=subprocess.PIPE, text=True).stdout


def matrices(text):
    """Those that a program prints, after a line of words each."""
    rows = [line.split() for line in text.splitlines() if re.fullmatch(r"\s*(-?[\d.]+(e[-+]?\d+)?\s*){4}", line)]
    return numpy.array(rows, float).reshape(-1, 4, 4)


def main(paraview, pvpython, repository, build, long):
    from vtkmodules.vtkIOGeometry import vtkSTLWriter

    from ppfmeam import scripting

    here = os.path.dirname(os.path.abspath(__file__))
    with tempfile.TemporaryDirectory() as folder:
        subprocess.run([sys.executable, os.path.join(repository, "testing", "install", "scan.py"), "make", folder], check=True)
        shutil.copy(os.path.join(repository, "testing", "fuzz", "corpus", "step", "rod.step"), folder)
        with open(os.path.join(folder, "part.stl"), "rb") as whole, open(os.path.join(folder, "cut.stl"), "wb") as cut:
            cut.write(whole.read(1000))
        small = scripting.scaled(scripting.read(os.path.join(folder, "part.stl")), 0.001, "part.stl")
        writer = vtkSTLWriter()
        writer.SetInputData(small)
        writer.SetFileName(os.path.join(folder, "metres.stl"))
        writer.Write()
        if os.environ.get("PPFMEAM_PICTURE"):
            shoot(paraview, folder, [NEW_PART] + right(folder), os.path.join(os.environ["PPFMEAM_PICTURE"], "application_new_part.jpg"))
        play(paraview, folder, [NEW_PART] + wrong(folder) + solid(folder) + metres(folder) + right(folder) +
             files("actionFileSaveServerState", "FileSaveServerStateDialog", f"{folder}/state.pvsm"))
        look_at_programs(folder)
        if not long:
            search_points_alone(paraview, folder)
        subprocess.run([pvpython, os.path.join(here, "TestNewPart.py"), "--look", folder], check=True)
        poses, picks = (numpy.load(os.path.join(folder, f"{kind}.npy")) for kind in ("MEAMPoseEstimation", "PickPlanning"))
        written = os.path.join(folder, "find_part")
        sys.argv = [os.path.join(written, "find_part.py")]
        ran = runpy.run_path(sys.argv[0])
        check(numpy.array_equal(ran["found"].poses, poses), "the program in Python finds other poses")
        check(numpy.allclose(ran["picks"].robot_transforms, picks, rtol=0, atol=1e-9), "the program in Python plans other picks")
        if long:
            said = build_and_run(written, build, folder)
            possible = picks[ran["picks"].possible]
            check(len(poses) and len(possible), f"{len(poses)} poses and {len(possible)} possible picks")
            printed = matrices(said)
            check(len(printed) == len(poses) + len(possible), f"the program in C++ says {said}")
            check(numpy.allclose(printed, numpy.concatenate((poses, possible)), rtol=1e-5, atol=5e-3), f"the program in C++ finds others: {said}")


if sys.argv[1] == "--look":
    look(sys.argv[2])
else:
    main(*sys.argv[1 + (sys.argv[1] == "--long"):], sys.argv[1] == "--long")
