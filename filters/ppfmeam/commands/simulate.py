# SPDX-License-Identifier: BSD-3-Clause
"""Simulates scans of bins with copies of a part that lie as they fell, and writes them with their truth as a dataset in
the form of the BOP benchmark: camera.json, models/, and a scene with one image in test/ for each bin.

With --camera beside the image is not registered with the depth: it is in gray_beside/ (rgb_beside/) and its camera's
calibration in image_camera.json."""
import argparse
import math
import os

from .. import bop, filters, scripting, simulation


def options_of_user():
    parser = scripting.Parser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    scripting.add_bin_arguments(parser, scenes=1)
    simulation.add_sensor_argument(parser)
    parser.add_argument("--noise", type=float, metavar="MM",
                        help="standard deviation of the depth at a distance of 1 m, in mm; it grows with the square "
                             "of the distance (default: the sensor's, 0.3 of structured light; the others have noise of "
                             "their own, to which this is added)")
    parser.add_argument("--camera", choices=("registered", "beside"), default="registered",
                        help="the image is the sensor's, or that of a camera beside it (default: %(default)s)")
    parser.add_argument("--baseline", type=float, default=150, metavar="MM",
                        help="from the sensor to the camera beside it (default: %(default)s)")
    parser.add_argument("--colored", action="store_true", help="images of red, green and blue instead of grey ones")
    parser.add_argument("--json", metavar="FILE", help="write what is printed as JSON")
    parser.add_argument("--out", required=True, metavar="DIR", help="folder to write, new or empty")
    options = parser.parse_args()
    if options.copies < 1 or options.scenes < 1:
        parser.error("--copies and --scenes have to be 1 or more")
    if (options.noise is not None and not 0 <= options.noise < math.inf) or not 0 < options.baseline < math.inf:
        parser.error("--noise has to be 0 or more, --baseline positive, in mm")
    return options


def main():
    options = options_of_user()
    scripting.require_folder_of(options.json)
    if os.path.exists(options.out) and (not os.path.isdir(options.out) or os.listdir(options.out)):
        raise scripting.Failure(f"cannot write {options.out}: it is there and not an empty folder")
    mesh = scripting.read_mesh(options.cad, scale=options.cad_scale, solid=options.solid)
    samples = scripting.Training(mesh).symmetric_samples()
    source = filters.vtkMEAMBinSceneSource()
    source.SetInputDataObject(mesh)
    source.SetCopies(options.copies)
    source.SetColored(options.colored)
    if options.camera == "beside":
        source.SetBaseline(options.baseline)
    simulation.set_sensor(source, options.sensor)
    if options.noise is not None:
        source.SetDepthNoise(options.noise)
    rows = []
    for scene in range(options.scenes):
        source.SetSeed(options.seed + scene)
        scripting.update(source)
        scan, truth, part, image = (source.GetOutputDataObject(port) for port in range(4))
        if scene == 0:
            scripting.make_folder(options.out)
            bop.write_part(options.out, part, samples.GetFieldData().GetAbstractArray("ModelsInfo").GetValue(0))
            bop.write_camera(options.out, scan, image)
        bop.write_scene(options.out, scene, scan, truth, image)
        seen = truth.GetPointData().GetArray("VisibleFraction")
        half = sum(seen.GetValue(i) >= 0.5 for i in range(truth.GetNumberOfPoints()))
        rows.append({"scene": scene, "copies": truth.GetNumberOfPoints(), "half_visible": half})
        print("scene {scene}: {half_visible} of {copies} copies are at least half visible".format(**rows[-1]))
    if options.json:
        scripting.write_json(options.json, {"scenes": rows})
