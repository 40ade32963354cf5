# SPDX-License-Identifier: BSD-3-Clause
"""Tells why a part of a scan was missed: which step lost it, and what to change; with --more in numbers, too, and what speaks for a
pose that came out, right or wrong, and what against."""
import math
import os

import numpy
from vtkmodules.util.numpy_support import vtk_to_numpy

from .. import api, choices, dataset, filters, regions, scripting
from .. import inputs as scans
from ..report import page
from ..report.content import Part
from ..report.told import Told, names_of


def options_of_user():
    parser = scripting.Parser(description=__doc__)
    parser.add_argument("part", nargs="?", help="CAD file of the part (.step or .iges, or .stl, .obj, .ply or .off in mm), or trained model of `train`; "
                                     "of a BOP dataset also the number of an object")
    parser.add_argument("scan", help="scan: .pcd, .ply, or a depth image with --camera, in mm; or an image of a BOP dataset, DIR/test/SSSSSS/IIIIII")
    parser.add_argument("--cad", action="append", default=[], metavar="PART",
                        help="in place of PART, once for each type of part that was searched: the answer is about that which has most evidence there")
    parser.add_argument("--model", action="append", default=[], help="the same of trained models; --cad is then for the page")
    place = parser.add_mutually_exclusive_group(required=True)
    place.add_argument("--at", nargs=3, type=float, metavar=("X", "Y", "Z"), help="a point of the scan on the part, in mm")
    place.add_argument("--pose", metavar="FILE[:ROW]",
                       help="where the part lies: a pose of a file (BOP's CSV, JSON, or 4x4 matrices), the first or that of "
                            "a row, from 1; it is fitted to the scan first")
    place.add_argument("--truth", metavar="FILE", nargs="?", const="",
                       help="the true poses of all parts, a file of the same kinds, or, without one, those that the dataset has of the object: "
                            "a line for each with the stage that lost it")
    choices.add_options(parser, "train", "scale")
    choices.add_options(parser, "read", "solid")
    parser.add_argument("--scale", type=float, default=1, metavar="F", help="the same of the scan and the boundary")
    parser.add_argument("--camera", metavar="FILE", help="calibration of the sensor, of a depth image or a .ply scan")
    parser.add_argument("--depth-scale", type=float, default=0, metavar="F",
                        help="mm that 1 in a depth image stands for (default: depth_scale of the calibration, or 1)")
    parser.add_argument("--boundary", metavar="CLOUD", help="the scan's edge points, instead of those of its image")
    parser.add_argument("--image", metavar="FILE", help="image of an organized scan that carries none")
    parser.add_argument("--image-camera", metavar="FILE", help="calibration of the camera beside the sensor that took it")
    regions.add_option(parser)
    choices.add_options(parser, "sensor", "viewpoint")
    choices.add_options(parser, "detect", "poses", "probability", "rotation_counts", "features", "image_edges", "references", "threads")
    parser.add_argument("--preset", choices=("paper", "recommended"), default="recommended",
                        help="parameters of all steps (default: %(default)s)")
    parser.add_argument("--more", action="store_true",
                        help="also what speaks for the place and against it, and the numbers of all steps")
    parser.add_argument("--json", metavar="FILE", help="write all of it as JSON")
    parser.add_argument("--report", metavar="HTML",
                        help="write a page for any browser, in one file: the scan in 3D, the part at the place, and what of it is there")
    options = parser.parse_intermixed_args()  # else PART and SCAN would have to stand side by side
    options.parts = options.model or options.cad or [options.part]
    if (options.part is None) == (not options.cad and not options.model):
        parser.error("give PART and SCAN, or SCAN and --cad, or --model, once for each type of part")
    if options.cad and options.model and len(options.cad) != len(options.model):
        parser.error("give a --cad for each --model, in the same order, or none")
    if options.depth_scale and not (options.camera and options.scan.lower().endswith(scripting.DEPTH_IMAGES)):
        parser.error("--depth-scale is of a depth image with its --camera")
    if options.report and options.truth is not None:
        parser.error("--report is of one place: give --pose, FILE:ROW")
    return options


class Asked:
    """The parts and the scan of the options, as api.why() takes them, and what goes with the scan; of a BOP dataset as `evaluate bop` has
    them."""

    def __init__(self, options):
        self.scan, self.options = options.scan, options
        self.beside = {name: getattr(options, name) for name in ("image", "boundary", "camera", "image_camera")}
        self.found = found = dataset.image_at(options.scan)
        if found:
            if any(self.beside[name] for name in ("image", "camera", "image_camera")):
                raise scripting.Failure(f"{options.scan} is of a BOP dataset, which has its cameras and images: leave --camera and --image out")
            self.scan = found[1].scan
            if found[1].beside:
                self.beside.update(image=found[1].beside, image_camera=found[0].beside())
        if options.depth_scale:
            self.scan, self.beside["camera"] = scripting.read_depth(options.scan, options.camera, options.depth_scale), None
        self.parts = [found[0].train(int(part), options.preset, options.features) if self.is_object(part) else part for part in options.parts]

    def is_object(self, part):
        """Whether the number of an object of the dataset names the part."""
        return bool(self.found) and part.isdecimal() and not os.path.exists(part)

    def shapes(self):
        """What stands for the parts on a page."""
        return [self.shape(part) for part in self.options.cad or self.options.parts]

    def shape(self, part):
        if self.is_object(part):
            return self.found[0].mesh(int(part))
        if part.lower().endswith(api.MODELS):
            return scripting.shape_of(scripting.read_model(part))
        return scripting.read_mesh(part, scale=self.options.cad_scale, solid=self.options.solid)

    def transforms(self):
        """The true poses."""
        if self.options.truth:
            return transforms_of(self.options.truth)
        part, *others = self.options.parts
        truth = None if others or not self.is_object(part) else self.found[1].truth_of(int(part))
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
        print(f"{'place':26s}" + "  ".join(" ".join(f"{x:.4f}" for x in row) for row in diagnosis.pose[:3]))
    for step, quantity, value, of in diagnosis.numbers:
        print(f"{step:26s}{quantity}: {words(value)}" + ("" if math.isnan(of) else f" / {words(of)}"))


def answer(diagnosis, parts):
    """In a line; of several types of part with the name of the one that it is about."""
    return str(diagnosis) if len(parts) == 1 or diagnosis.pose is None else f"{names_of(parts)[diagnosis.part]}: {diagnosis}"


def content(diagnosis):
    """All of it, for JSON."""
    told = {name: getattr(diagnosis, name) for name in ("part", "verdict", "advice", "reasons", "lost_in", "rank", "pose", "unexplained")}
    return {**told, "numbers": [dict(zip(("step", "quantity", "value", "of"), row)) for row in diagnosis.numbers]}


def write_page(asked, inputs, diagnosis):
    options = asked.options
    seen = scans.scan_of(asked.scan, inputs["camera"], options.scale, inputs["image"], image_camera=inputs["image_camera"])
    place = numpy.zeros((0, 4, 4)) if diagnosis.pose is None else diagnosis.pose[None]
    poses = scripting.poses_of(place)
    api.add_array(poses.GetPointData(), "PartId", numpy.full(len(place), diagnosis.part))
    told = Told.of_why(options, inputs, diagnosis)
    page.write(options.report, page.html(seen, poses, list(map(Part, told.names, asked.shapes())), told))


def main():
    options = options_of_user()
    scripting.require_folder_of(options.json, options.report)
    page.require(options.report)
    asked = Asked(options)
    inputs = {name: getattr(options, name) for name in (
        "scale", "cad_scale", "solid", "viewpoint", "poses", "probability", "rotation_counts", "references", "preset", "features", "image_edges",
        "threads")}
    inputs.update(asked.beside, region=options.roi)
    if options.truth is not None:
        found = api.why(asked.parts, asked.scan, pose=asked.transforms(), **inputs)
        for row, diagnosis in enumerate(found, 1):
            print(f"{row:4d}  {diagnosis.lost_in or 'found':26s}{answer(diagnosis, options.parts)}")
        print(f"{sum(not diagnosis.lost_in for diagnosis in found)} of {len(found)} were found")
        told = [content(diagnosis) for diagnosis in found]
    else:
        place = {"at": options.at} if options.at else {"pose": chosen(options.pose), "fit": True}
        diagnosis = api.why(asked.parts, asked.scan, **place, **inputs)
        print(answer(diagnosis, options.parts))
        if options.more:
            print_numbers(diagnosis)
        told = content(diagnosis)
        if options.report:
            write_page(asked, inputs, diagnosis)
    if options.json:
        scripting.write_json(options.json, told)
