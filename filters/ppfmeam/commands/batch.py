# SPDX-License-Identifier: BSD-3-Clause
"""Finds the copies of a part, or of several parts, in many scans: writes one table of the poses, in the order of the
scans, and NAME.scans.csv with the times. A scan that fails is a row with the reason. A run that was stopped or
killed goes on when the same command is given again.

With several processes, each with one thread, scans go to whichever is free, and the table is the same: mpirun -n 8
ppfmeam batch ..., or mpirun -n 8 pvbatch --symmetric .../ppfmeam/batch/__main__.py ...

With --watch scans are taken as they arrive in a folder, and NAME.poses.json stands beside each, or NAME.poses.failed
with the reason."""
import argparse
import traceback

from .. import choices, evaluation, regions, scripting
from ..batch import run, watch
from ..batch.ranks import ranks


def options_of_user(arguments=None):
    """Of the command line, or of these words."""
    parser = scripting.Parser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("scans", metavar="SCANS", nargs="?",
                        help="a dataset in the form of the BOP benchmark; a folder of scans (.pcd, .ply, .xyz, .asc, .pts or, with "
                             "--camera and --no-image, depth images); or a text file with a scan in each line, after a tab its image "
                             "where it carries none")
    parser.add_argument("--watch", metavar="FOLDER",
                        help="instead of SCANS and --out: a folder in which scans arrive, each taken as soon as it "
                             "is whole; Ctrl-C ends it")
    parser.add_argument("--form", choices=watch.FORMS, default="json",
                        help="of the poses beside each scan of --watch: JSON, or CSV as BOP has it "
                             "(default: %(default)s)")
    parts = parser.add_mutually_exclusive_group()
    parts.add_argument("--model", action="append", default=[], metavar="MODEL",
                       help="trained model of `train`, once for each type of part")
    parts.add_argument("--cad", action="append", default=[], metavar="PART",
                       help="CAD file of the part, once for each type of part: it is trained first")
    parts.add_argument("--objects", type=evaluation.numbers,
                       help="of a BOP dataset without --model and --cad, such as 1,5-7 (default: all in models/)")
    choices.add_options(parser, "train", "scale")
    choices.add_options(parser, "read", "solid")
    parser.add_argument("--split", default="test", help="folder of a BOP dataset's scenes (default: %(default)s)")
    parser.add_argument("--camera", metavar="FILE", help="calibration of the sensor, of depth images and of clouds")
    parser.add_argument("--depth-scale", type=choices.factor, metavar="F",
                        help="mm that 1 in a depth image stands for (default: depth_scale of the calibration, or 1)")
    parser.add_argument("--scene-scale", type=choices.factor, default=1, metavar="F",
                        help="factor from the scans' lengths to mm")
    parser.add_argument("--image-camera", metavar="FILE",
                        help="calibration of the camera beside the sensor that took a list's images (default: they are "
                             "registered)")
    regions.add_option(parser)
    choices.add_options(parser, "sensor", "viewpoint")
    choices.add_options(parser, "detect", "poses", "probability", "rotation_counts", "features", "image_edges", "references", "time_limit")
    parser.add_argument("--threads", type=scripting.count, default=0,
                        help="threads of each process; 0: all cores for one process, one thread for each of several "
                             "(default)")
    scripting.add_method_options(parser)
    parser.add_argument("--out", metavar="CSV",
                        help="table to write; OUT.run beside it keeps what is done")
    parser.add_argument("--json", metavar="FILE", help="write the poses of all scans as JSON, too, with times and failures")
    parser.add_argument("--report", metavar="FOLDER",
                        help="write a page for any browser of each scan to a folder, and index.html, which lists them")
    parser.add_argument("--why", action="store_true",
                        help="the pages of --report tell of each pose what speaks for it and against it, which takes another search of "
                             "each scan")
    options = parser.parse_args(arguments)
    if bool(options.watch) == bool(options.scans) or bool(options.watch) == bool(options.out):
        parser.error("give SCANS and --out, or --watch")
    if options.watch and (options.report or options.json):
        parser.error("--report and --json are of SCANS, not of --watch")
    if options.depth_scale and not options.camera:
        parser.error("--depth-scale is of depth images with their --camera")
    if options.viewpoint and options.camera:
        parser.error("--camera tells where the scan is seen from: leave --viewpoint out")
    scripting.require_cad(parser, options, options.cad)
    if options.why and not options.report:
        parser.error("--why is of the pages of --report")
    if options.watch and not options.model and not options.cad:
        parser.error("give the part: --cad, or --model of `train`")
    return options


def main():
    options, processes = options_of_user(), ranks()
    try:
        if options.watch and processes.size > 1:
            raise scripting.Failure("--watch is for one process, which uses all cores for each scan")
        if options.watch:
            watch.Watch(options).run()
        else:
            run.run(options, processes)
    except (scripting.Failure, SystemExit):
        processes.close()  # all have come to this
        raise
    except BaseException:
        if processes.size > 1:
            traceback.print_exc()
        processes.abort()
        raise
    processes.close()
