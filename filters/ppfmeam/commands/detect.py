# SPDX-License-Identifier: BSD-3-Clause
"""Finds the copies of a part, or of several parts, in a scan: prints the poses, best first, and the time of every stage."""
import os

from .. import asked, finding, inputs, picture, scripting
from ..report import page
from ..report.content import Part
from ..report.told import Told

FILES = {".csv": "out", ".json": "json", ".html": "report", ".htm": "report", ".png": "picture", ".jpg": "picture", ".jpeg": "picture"}


def options_of_user():
    parser = scripting.Parser(description=__doc__)
    asked.add_options(parser, "time_limit")
    parser.add_argument("--out", metavar="CSV", help="write the poses as BOP results")
    parser.add_argument("--json", help="write the poses as JSON")
    parser.add_argument("--matrices", metavar="TXT", help="write the poses as 4x4 matrices")
    parser.add_argument("--picture", metavar="FILE", help="write a picture, PNG or JPEG, of the scan with the part at each pose")
    parser.add_argument("--report", metavar="HTML",
                        help="write a page for any browser, in one file: scan and parts in 3D, the image with their outlines, the poses and why")
    options = asked.parsed(parser)
    for name in ("out", "json", "matrices"):
        path = getattr(options, name)
        other = path and FILES.get(os.path.splitext(path)[1].lower(), name)
        if other and other != name:
            parser.error(f"--{name} does not write such a file as {path}: give --{other} {path}, or another name")
    return options


def scan_of(named, options):
    """The scan in mm, and the image that stands beside it with its camera, or None."""
    image_camera = named.beside["image_camera"]
    if named.found:
        return scripting.scaled(named.found[1].scan, options.scene_scale, options.scan), named.beside["image"], image_camera
    image = scripting.read_image(options.image) if options.image else None
    if not options.depth:
        return scripting.read_scan(options.scan, options.scene_scale, options.camera), image, image_camera
    scan = scripting.read_depth(options.depth, options.camera, options.depth_scale)
    return scripting.scaled(scan, options.scene_scale, options.depth), image, image_camera


def main():
    options = options_of_user()
    scripting.require_folder_of(options.out, options.json, options.matrices, options.picture, options.report)
    picture.require(options.picture)
    page.require(options.report)
    named = asked.Named(options)
    meshes = [named.mesh(part) for part in options.cad]
    parts = [scripting.read_model(path) for path in options.model] or [
        named.trained(part) if named.is_object(part) else mesh for part, mesh in zip(options.cad, meshes)]
    scene, image, image_camera = scan_of(named, options)
    boundary = scripting.read(options.boundary, options.scene_scale) if options.boundary else None
    poses = finding.Finder(parts, options).find(scene, boundary, image, image_camera)
    scripting.print_poses(poses)
    scripting.print_scan_quality(poses)
    scripting.print_times(poses)
    for path, form in ((options.out, "BOPCSV"), (options.json, "JSON"), (options.matrices, "Matrices")):
        if path:
            scripting.write_poses(poses, path, form, Time=scripting.field(poses, "SecondsTotal"))
    if options.picture:
        picture.save(options.picture, scene, poses, *(meshes or parts))
    if options.report:
        told = Told.of_command(options, poses, parts, (scene, boundary, image), image_camera)
        shown = [Part(name, scripting.shape_of(part)) for name, part in zip(told.names, meshes or parts)]
        page.write(options.report, page.html(inputs.scan_of(scene, image=image, image_camera=image_camera), poses, shown, told))
