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


def main():
    options = options_of_user()
    scripting.require_folder_of(options.out, options.json, options.matrices, options.picture, options.report)
    picture.require(options.picture)
    page.require(options.report)
    meshes = [scripting.read_mesh(path, options.cad_offset, options.cad_scale, options.solid) for path in options.cad]
    parts = [scripting.read_model(path) for path in options.model] or meshes
    if options.depth:
        scene = scripting.read_depth(options.depth, options.camera, options.depth_scale)
        scene = scripting.scaled(scene, options.scene_scale, options.depth)
    else:
        scene = scripting.read_scan(options.scan, options.scene_scale, options.camera)

    boundary = scripting.read(options.boundary, options.scene_scale) if options.boundary else None
    image = scripting.read_image(options.image) if options.image else None
    poses = finding.Finder(parts, options).find(scene, boundary, image, options.image_camera)
    scripting.print_poses(poses)
    scripting.print_scan_quality(poses)
    scripting.print_times(poses)
    for path, form in ((options.out, "BOPCSV"), (options.json, "JSON"), (options.matrices, "Matrices")):
        if path:
            scripting.write_poses(poses, path, form, Time=scripting.field(poses, "SecondsTotal"))
    if options.picture:
        picture.save(options.picture, scene, poses, *(meshes or parts))
    if options.report:
        told = Told.of_command(options, poses, parts, (scene, boundary, image))
        shown = [Part(name, scripting.shape_of(part)) for name, part in zip(told.names, meshes or parts)]
        page.write(options.report, page.html(inputs.scan_of(scene, image=image, image_camera=options.image_camera), poses, shown, told))
