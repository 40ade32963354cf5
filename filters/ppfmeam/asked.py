# SPDX-License-Identifier: BSD-3-Clause
"""What `why` and `pick` ask for: the part, or types of part, and a scan with all that goes with it."""
import os

from . import api, choices, dataset, regions, scripting

OF_SEARCH = ("poses", "probability", "rotation_counts", "features", "image_edges", "references", "preset")  # what decides which poses come out
OF_DETECTION = (*(name for name in OF_SEARCH if name not in ("poses", "preset")), "threads")


def add_options(parser):
    parser.add_argument("part", nargs="?", help="CAD file of the part (.step or .iges, or .stl, .obj, .ply or .off in mm), or trained model of `train`; "
                                     "of a BOP dataset also the number of an object")
    parser.add_argument("scan", help="scan: .pcd, .ply, a text of points, or a depth image with --camera, in mm; or an image of a BOP dataset, DIR/test/SSSSSS/IIIIII")
    parser.add_argument("--cad", action="append", default=[], metavar="PART", help="in place of PART, once for each type of part in the scan")
    parser.add_argument("--model", action="append", default=[], help="a trained model in place of PART, once for each type of part; its --cad, in the same order, has the faces that are shown and held")
    choices.add_options(parser, "train", "offset", "scale")
    choices.add_options(parser, "read", "solid")
    parser.add_argument("--scale", "--scene-scale", type=choices.factor, default=1, metavar="F", help="factor that brings the scan and the boundary to mm (default: %(default)s)")
    parser.add_argument("--camera", metavar="FILE", help="calibration of the sensor, of a depth image or a cloud")
    parser.add_argument("--depth-scale", type=choices.factor, metavar="F",
                        help="mm that 1 in a depth image stands for (default: depth_scale of the calibration, or 1)")
    parser.add_argument("--boundary", metavar="CLOUD", help="the scan's edge points, instead of those of its image")
    parser.add_argument("--image", metavar="FILE", help="image of an organized scan that carries none")
    parser.add_argument("--image-camera", metavar="FILE", help="calibration of the camera beside the sensor that took it")
    regions.add_option(parser)
    choices.add_options(parser, "sensor", "viewpoint")
    choices.add_options(parser, "detect", "poses", *OF_DETECTION)
    scripting.add_method_options(parser)


def parsed(parser):
    """The options, with `parts`: those that are looked for."""
    options = parser.parse_intermixed_args()  # else PART and SCAN would have to stand side by side
    options.parts = options.model or options.cad or [options.part]
    if (options.part is None) == (not options.cad and not options.model):
        parser.error("give PART and SCAN, or SCAN and --cad, or --model, once for each type of part")
    scripting.require_shown(parser, options, getattr(options, "report", "pick holds it"))
    scripting.require_cad(parser, options, not all(api.is_model(part) or is_number(part) for part in options.cad or options.parts))
    if options.image and not options.image_edges and not getattr(options, "report", None):
        parser.error("--no-image leaves the image out: give one of --image and --no-image")
    if options.depth_scale and not (options.camera and options.scan.lower().endswith(scripting.DEPTH_IMAGES)):
        parser.error("--depth-scale is of a depth image with its --camera")
    return options


def is_number(part):
    """Whether it is no file's name, but the number of an object."""
    return part.isdecimal() and not os.path.exists(part)


class Asked:
    """The parts' models and the scan of the options, as api.why() and api.detect() take them; of a BOP dataset as `evaluate bop` has them."""

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
        if not found:
            scripting.require_file(options.scan)  # before parts are trained
        how, reading = (choices.of_options(group, options) for group in ("detect", "read"))
        self.models = [api.part_of(found[0].train(int(part), options.preset, options.features) if self.is_object(part) else part,
                                   options.cad_scale, how, reading, options.cad_offset) for part in options.parts]

    def is_object(self, part):
        """Whether the number of an object of the dataset names the part."""
        return bool(self.found) and is_number(part)

    def inputs(self):
        """What goes with the scan, and how parts are looked for."""
        names = ("scale", "viewpoint", "poses", "preset", *OF_DETECTION)
        return {**{name: getattr(self.options, name) for name in names}, **self.beside, "region": self.options.roi}

    def shapes(self):
        """The parts' meshes, or the samples of trained models."""
        return [self.shape(part) for part in self.options.cad or self.options.parts]

    def shape(self, part):
        if self.is_object(part):
            return self.found[0].mesh(int(part))
        if api.is_model(part):
            return scripting.shape_of(scripting.read_model(part))
        return scripting.read_mesh(part, self.options.cad_offset, self.options.cad_scale, self.options.solid)
