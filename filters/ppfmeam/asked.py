# SPDX-License-Identifier: BSD-3-Clause
"""What `detect`, `why` and `pick` ask for: the part, or types of part, and a scan with all that goes with it."""
import os

from . import api, choices, dataset, regions, scripting

OF_SEARCH = ("poses", "probability", "rotation_counts", "features", "image_edges", "references", "preset")  # what decides which poses come out
OF_DETECTION = (*(name for name in OF_SEARCH if name not in ("poses", "preset")), "threads")


def add_options(parser, *ours):
    """`ours`: choices of the table "detect" that follow those which decide what is looked for."""
    parser.add_argument("part", nargs="?", metavar="PART",
                        help="CAD file of the part (.step or .iges, or .stl, .obj, .ply or .off in mm), or trained model of `train`; of a BOP "
                             "dataset also the number of an object")
    parser.add_argument("scan", nargs="?", metavar="SCAN",
                        help="scan: .pcd, .ply or a text of points (.xyz, .csv, .txt, .asc, .pts), organized or points alone, in mm; the points of a "
                             ".stl or .obj; a depth image with --camera; or an image of a BOP dataset, DIR/test/SSSSSS/IIIIII")
    parser.add_argument("--cad", action="append", default=[], metavar="FILE", help="in place of PART, once for each type of part in the scan")
    parser.add_argument("--model", action="append", default=[], metavar="FILE",
                        help="trained model in place of PART, once for each type of part; its --cad, in the same order, has the faces "
                             "that are shown and held")
    choices.add_options(parser, "train", "offset", "scale")
    choices.add_options(parser, "read", "solid")
    parser.add_argument("--scene", metavar="CLOUD", help="in place of SCAN")
    parser.add_argument("--depth", metavar="FILE",
                        help="in place of SCAN: a depth image of 16 bits (.png, .tif or .pgm), or of real numbers (.tif or .pfm), with --camera")
    parser.add_argument("--camera", metavar="FILE",
                        help="calibration of the sensor (docs/inputs.md): of the depth image, or of a scan whose points are not "
                             "organized, which it brings back onto its pixels")
    parser.add_argument("--depth-scale", type=choices.factor, metavar="F",
                        help="mm that 1 in the depth image stands for (default: depth_scale of the calibration, or 1)")
    parser.add_argument("--scene-scale", "--scale", type=choices.factor, default=1, metavar="F",
                        help="factor to mm, also of the boundary, and of the depth image beside its own scale (default: %(default)s)")
    parser.add_argument("--boundary", metavar="CLOUD", help="the scan's edge points, instead of those of its image")
    parser.add_argument("--image", metavar="FILE", help="image of an organized scan that carries none: .png, .jpg, .bmp or .tif")
    parser.add_argument("--image-camera", metavar="FILE",
                        help="calibration of the camera beside the sensor that took the image (default: it is registered)")
    regions.add_option(parser)
    choices.add_options(parser, "sensor", "viewpoint")
    choices.add_options(parser, "detect", "poses", *OF_DETECTION, *ours)
    scripting.add_method_options(parser)


def parsed(parser, holds=False):
    """The options, with `parts`, those that are looked for; PART is one of `cad` or `model`, and a depth image is `depth`. `holds`: the
    command needs the faces of a trained model's part."""
    options = parser.parse_intermixed_args()  # else PART and SCAN would have to stand side by side
    named = options.scene or options.depth
    if named is None and options.scan is None:
        options.part, options.scan = None, options.part
    if options.scene and options.depth or named and options.scan:
        parser.error("give one scan: SCAN, --scene or --depth")
    options.scan = named or options.scan
    if options.part is not None and api.is_model(options.part) and not options.model:
        options.part, options.model = None, [options.part]
    if not options.scan or (options.part is None) == (not options.cad and not options.model):
        parser.error("give PART and SCAN, or SCAN and --cad, or --model, once for each type of part")
    if options.part is not None:
        options.cad = [options.part]
    options.parts = options.model or options.cad
    is_image = options.scan.lower().endswith(scripting.DEPTH_IMAGES)
    if options.depth is None and options.camera and is_image:
        options.depth = options.scan
    scripting.require_shown(parser, options, holds, *(getattr(options, name, None) for name in ("picture", "report")))
    scripting.require_cad(parser, options, not all(map(is_number, options.cad)))
    if options.depth and not options.camera:
        parser.error("a depth image needs its --camera")
    if options.depth_scale and not options.depth:
        parser.error("--depth-scale is of a depth image with its --camera: use --scene-scale")
    if options.viewpoint and options.camera:
        parser.error("--camera tells where the scan is seen from: leave --viewpoint out")
    if options.image and not options.image_edges and not getattr(options, "report", None):
        parser.error("--no-image leaves the image out: give one of --image and --no-image")
    if options.image_camera and not options.image:
        parser.error("--image-camera is of an --image")
    inputs = list(filter(os.path.exists, [options.scan, *options.cad, *options.model, *filter(None, (
        options.camera, options.boundary, options.image, options.image_camera))]))
    for name in ("out", "json", "matrices", "picture", "report"):
        path = getattr(options, name, None)
        if path and os.path.exists(path) and any(os.path.samefile(path, given) for given in inputs):
            parser.error(f"--{name} {path} is what is read: give another name")
    return options


def is_number(part):
    """Whether it is no file's name, but the number of an object."""
    return part.isdecimal() and not os.path.exists(part)


class Named:
    """The parts and the scan that the options name. The scan may also be an image of a BOP dataset, DIR/test/SSSSSS/IIIIII, as `evaluate bop`
    has it, and a part then the number of an object. `found`: the dataset and the image, or None."""

    def __init__(self, options):
        self.options, self.found = options, dataset.image_at(options.scan)
        if self.found and (options.image or options.camera or options.image_camera):
            raise scripting.Failure(f"{options.scan} is of a BOP dataset, which has its cameras and images: leave --camera and --image out")
        self.beside = {name: getattr(options, name) for name in ("image", "boundary", "camera", "image_camera")}
        if self.found and self.found[1].beside:
            self.beside.update(image=self.found[1].beside, image_camera=self.found[0].beside())

    def is_object(self, part):
        """Whether the number of an object of the dataset names the part."""
        return bool(self.found) and is_number(part)

    def trained(self, part):
        """The trained model of an object."""
        return self.found[0].train(int(part), self.options.preset, self.options.features)

    def shapes(self):
        """The parts' meshes, or the samples of trained models."""
        return [self.shape(part) for part in self.options.cad or self.options.model]

    def shape(self, part):
        return scripting.shape_of(scripting.read_model(part)) if api.is_model(part) else self.mesh(part)

    def mesh(self, part):
        """That of a CAD file or an object."""
        if self.is_object(part):
            return self.found[0].mesh(int(part))
        return scripting.read_mesh(part, self.options.cad_offset, self.options.cad_scale, self.options.solid)


class Asked(Named):
    """The parts' models and the scan, as api.why() and api.detect() take them."""

    def __init__(self, options):
        super().__init__(options)
        self.scan = self.found[1].scan if self.found else options.scan
        if not self.found:
            scripting.require_file(options.scan)  # before parts are trained
        if options.depth:
            self.scan, self.beside["camera"] = scripting.read_depth(options.depth, options.camera, options.depth_scale), None
        how, reading = (choices.of_options(group, options) for group in ("detect", "read"))
        self.models = [api.part_of(self.trained(part) if self.is_object(part) else part, options.cad_scale, how, reading, options.cad_offset)
                       for part in options.parts]

    def inputs(self):
        """What goes with the scan, and how parts are looked for."""
        names = ("viewpoint", "poses", "preset", *OF_DETECTION)
        return {**{name: getattr(self.options, name) for name in names}, **self.beside, "scale": self.options.scene_scale,
                "region": self.options.roi}
