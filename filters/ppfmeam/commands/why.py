# SPDX-License-Identifier: BSD-3-Clause
"""Tells why a part of a scan was missed, or why a pose came out, right or wrong: which step lost it, what speaks most for it and most
against it, and what to change; with --more all of it, in numbers."""
import math

import numpy
from vtkmodules.util.numpy_support import vtk_to_numpy

from .. import api, asked, choices, filters, scripting
from .. import inputs as scans
from ..report import page
from ..report.content import Part
from ..report.told import Told, names_of


def options_of_user():
    parser = scripting.Parser(description=__doc__)
    asked.add_options(parser)
    place = parser.add_mutually_exclusive_group(required=True)
    place.add_argument("--at", nargs=3, type=choices.finite, metavar=("X", "Y", "Z"), help="a point of the scan on the part, in mm")
    place.add_argument("--pose", metavar="FILE[:ROW]",
                       help="where the part lies: a pose of a file (BOP's CSV, JSON, or 4x4 matrices), the first or that of "
                            "a row, from 1; it is fitted to the scan first")
    place.add_argument("--rank", type=int, metavar="N", help="the pose that comes out as this rank, from 1, with the same options")
    place.add_argument("--truth", metavar="FILE", nargs="?", const="",
                       help="the true poses of all parts, a file of the same kinds, or, without one, those that the dataset has of the object: "
                            "a line for each with the stage that lost it")
    parser.add_argument("--more", action="store_true",
                        help="also what speaks for the place and against it, and the numbers of all steps")
    parser.add_argument("--json", metavar="FILE", help="write all of it as JSON")
    parser.add_argument("--report", metavar="HTML",
                        help="write a page for any browser, in one file: the scan in 3D, the part at the place, and what of it is there")
    options = asked.parsed(parser)
    if options.report and options.truth is not None:
        parser.error("--report is of one place: give --pose, FILE:ROW")
    return options


def true_transforms(of):
    """The true poses, N x 4 x 4."""
    if of.options.truth:
        return transforms_of(of.options.truth)
    part, *others = of.options.parts
    truth = None if others or not of.is_object(part) else of.found[1].truth_of(int(part))
    if truth is None or not truth.GetNumberOfPoints():
        raise scripting.Failure("--truth needs a file of poses, unless the part is an object of a BOP dataset, by its number, and the scan an "
                                "image of it that has true poses")
    return scripting.column(truth, "Transform", 4, 4)


def transforms_of(path):
    """The poses of a file, N x 4 x 4."""
    poses = scripting.read_with(filters.vtkMEAMPoseReader(), path)
    if poses.GetNumberOfPoints() == 0:
        raise scripting.Failure(f"{path}: there is no pose in it")
    return vtk_to_numpy(poses.GetPointData().GetArray("Transform")).reshape(-1, 4, 4)


def chosen(text):
    """The pose that FILE[:ROW] names."""
    path, colon, row = text.rpartition(":")
    if not colon or not row.isdigit():
        path, row = text, "1"
    transforms = transforms_of(path)
    if not 1 <= int(row) <= len(transforms):
        raise scripting.Failure(f"{path}: there is no row {row}: it has {len(transforms)} poses")
    return transforms[int(row) - 1]


def print_numbers(diagnosis):
    """The reasons, the place, and the numbers step by step."""
    def words(number):
        return f"{number:.0f}" if number == int(number) else f"{number:.3f}"

    if diagnosis.reasons:
        print(diagnosis.reasons)
    if diagnosis.pose is not None:
        print(f"{'place':28s}" + "  ".join(" ".join(f"{x:.4f}" for x in row) for row in diagnosis.pose[:3]))
    for step, quantity, value, of in diagnosis.numbers:
        print(f"{step:28s}{quantity}: {words(value)}" + ("" if math.isnan(of) else f" / {words(of)}"))


def answer(diagnosis, parts):
    """In a line; of several types of part with the name of the one that it is about."""
    return str(diagnosis) if len(parts) == 1 or diagnosis.pose is None else f"{names_of(parts)[diagnosis.part]}: {diagnosis}"


def content(diagnosis):
    """All of it, for JSON."""
    told = {name: getattr(diagnosis, name) for name in ("part", "verdict", "main_reason", "advice", "reasons", "lost_in", "rank", "pose", "unexplained")}
    return {**told, "numbers": [dict(zip(("step", "quantity", "value", "of"), row)) for row in diagnosis.numbers]}


def write_page(of, inputs, diagnosis):
    options = of.options
    seen = scans.scan_of(of.scan, inputs["camera"], options.scene_scale, inputs["image"], image_camera=inputs["image_camera"])
    place = numpy.zeros((0, 4, 4)) if diagnosis.pose is None else diagnosis.pose[None]
    poses = scripting.poses_of(place)
    poses.GetPointData().AddArray(scripting.vtk_array(numpy.full(len(place), diagnosis.part), "PartId"))
    told = Told.of_why(options, inputs, diagnosis)
    page.write(options.report, page.html(seen, poses, list(map(Part, told.names, of.shapes())), told))


def main():
    options = options_of_user()
    scripting.require_folder_of(options.json, options.report)
    page.require(options.report)
    of = asked.Asked(options)
    inputs = of.inputs()
    if options.truth is not None:
        found = api.why(of.models, of.scan, pose=true_transforms(of), **inputs)
        for row, diagnosis in enumerate(found, 1):
            print(f"{row:4d}  {diagnosis.lost_in or 'found':26s}{answer(diagnosis, options.parts)}")
        print(f"{sum(not diagnosis.lost_in for diagnosis in found)} of {len(found)} were found")
        told = [content(diagnosis) for diagnosis in found]
    else:
        if options.rank is not None:
            diagnosis = api.detect(of.models, of.scan, **inputs).why(rank=options.rank)
        else:
            place = {"at": options.at} if options.at else {"pose": chosen(options.pose), "fit": True}
            diagnosis = api.why(of.models, of.scan, **place, **inputs)
        print(answer(diagnosis, options.parts))
        if options.more:
            print_numbers(diagnosis)
        told = content(diagnosis)
        if options.report:
            write_page(of, inputs, diagnosis)
    if options.json:
        scripting.write_json(options.json, told)
