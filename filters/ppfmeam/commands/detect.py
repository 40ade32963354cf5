# SPDX-License-Identifier: BSD-3-Clause
"""Finds the copies of a part, or of several parts, in a scan: prints the poses, best first, and the time of every stage."""
import os

from .. import choices, finding, inputs, picture, regions, scripting
from ..report import page
from ..report.content import Part
from ..report.told import Told

FILES = {".csv": "out", ".json": "json", ".html": "report", ".htm": "report", ".png": "picture", ".jpg": "picture", ".jpeg": "picture"}


def options_of_user():
    parser = scripting.Parser(description=__doc__)
    parser.add_argument("--cad", action="append", default=[], metavar="PART",
                        help="CAD file of the part: .step or .iges, or .stl, .obj, .ply or .off in mm; once for each type of part")
    choices.add_options(parser, "train", "offset", "scale")
    choices.add_options(parser, "read", "solid")
    parser.add_argument("--model", action="append", default=[],
                        help="trained model of `train`, instead of training, once for each type of part; --cad is then for "
                             "--picture and --report")
    scan = parser.add_mutually_exclusive_group(required=True)
    scan.add_argument("--scene", metavar="CLOUD",
                      help="scan: .pcd, .ply or a text of points (.xyz, .csv, .txt, .asc, .pts), organized or points alone, in mm; "
                           "or the points of a .stl or .obj")
    scan.add_argument("--depth", metavar="FILE",
                      help="scan: a depth image of 16 bits (.png, .tif or .pgm), or of real numbers (.tif or .pfm), with --camera")
    parser.add_argument("--camera", metavar="FILE",
                        help="calibration of the sensor (docs/inputs.md): of the depth image, or of a scan whose points are not "
                             "organized, which it brings back onto its pixels")
    parser.add_argument("--depth-scale", type=choices.factor, metavar="F",
                        help="mm that 1 in the depth image stands for (default: depth_scale of the calibration, or 1)")
    parser.add_argument("--scene-scale", type=choices.factor, default=1, metavar="F",
                        help="factor to mm, also of the boundary, and of the depth image beside its own scale")
    parser.add_argument("--boundary", metavar="CLOUD", help="the scan's edge points, instead of those of its image")
    parser.add_argument("--image", metavar="FILE",
                        help="image of an organized scan that carries none: .png, .jpg, .bmp or .tif")
    parser.add_argument("--image-camera", metavar="FILE",
                        help="calibration of the camera beside the sensor that took the image (default: it is registered)")
    regions.add_option(parser)
    choices.add_options(parser, "sensor", "viewpoint")
    choices.add_options(parser, "detect", "poses", "probability", "rotation_counts", "features", "image_edges", "references", "time_limit", "threads")
    scripting.add_method_options(parser)
    parser.add_argument("--out", metavar="CSV", help="write the poses as BOP results")
    parser.add_argument("--json", help="write the poses as JSON")
    parser.add_argument("--matrices", metavar="TXT", help="write the poses as 4x4 matrices")
    parser.add_argument("--picture", metavar="FILE", help="write a picture, PNG or JPEG, of the scan with the part at each pose")
    parser.add_argument("--report", metavar="HTML",
                        help="write a page for any browser, in one file: scan and parts in 3D, the image with their outlines, the poses and why")
    options = parser.parse_args()
    if not options.cad and not options.model:
        parser.error("give the part: --cad, or --model of `train`")
    scripting.require_shown(parser, options, options.picture, options.report)
    if options.depth and not options.camera:
        parser.error("a depth image needs its --camera")
    if options.depth_scale and not options.depth:
        parser.error("--depth-scale is of a depth image: use --scene-scale")
    if options.viewpoint and options.camera:
        parser.error("--camera tells where the scan is seen from: leave --viewpoint out")
    scripting.require_cad(parser, options, options.cad)
    if options.image and not options.image_edges and not options.report:
        parser.error("--no-image leaves the image out: give one of --image and --no-image")
    if options.image_camera and not options.image:
        parser.error("--image-camera is of an --image")
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
        scene = scripting.read_scan(options.scene, options.scene_scale, options.camera)

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
