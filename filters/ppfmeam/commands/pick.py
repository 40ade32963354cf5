# SPDX-License-Identifier: BSD-3-Clause
"""From a scan to picks: where jaws or a cup can take which part out of the bin, best first, and what is against the others."""
import argparse

import numpy

import ppfmeam
from ppfmeam import scripting


def length(words):
    """For argparse: NAME=MM."""
    name, _, value = words.partition("=")
    try:
        return name, float(value)
    except ValueError:
        raise argparse.ArgumentTypeError(f"it has to be NAME=MM, not {words}") from None


def add_gripper_options(parser):
    kind = parser.add_mutually_exclusive_group()
    kind.add_argument("--opening", type=float, default=60.0, metavar="MM", help="of the jaws (default: %(default)s)")
    kind.add_argument("--cup", type=float, metavar="MM", help="diameter of a suction cup, in place of the jaws")
    parser.add_argument("--gripper", type=length, nargs="+", default=[], metavar="NAME=MM",
                        help="other lengths of the gripper, such as finger_length=80, as ppfmeam.grasps() has them")


def gripper_of(options):
    """Jaws or cup, and its lengths by name."""
    main = {"opening": options.opening} if options.cup is None else {"cup_diameter": options.cup}
    return "jaws" if options.cup is None else "cup", {**main, **dict(options.gripper)}


def main():
    parser = scripting.Parser(description=__doc__)
    parser.add_argument("part", help="the CAD, mm")
    parser.add_argument("scan", help="an organized cloud of the bin, from above")
    add_gripper_options(parser)
    parser.add_argument("--no-bin", action="store_true", help="the parts lie in no bin: do not look for one")
    parser.add_argument("--json", metavar="FILE", help="write all picks as JSON, with what is against those that are not possible")
    options = parser.parse_args()
    scripting.require_folder_of(options.json)
    gripper, lengths = gripper_of(options)
    model = ppfmeam.train(options.part)
    grasps = ppfmeam.grasps(options.part, propose="suction" if gripper == "cup" else "parallel", symmetries=model, **lengths)
    if not len(grasps):
        raise scripting.Failure("no place of the part is one for this gripper: give another --opening, or a smaller --cup")
    found = ppfmeam.detect(model, options.scan, poses=0, probability=0.5)
    picks = ppfmeam.pick(found, grasps, options.scan, gripper=gripper, bin="none" if options.no_bin else "detected")
    print(picks.report, picks.advice)
    for k in numpy.flatnonzero(picks.possible):
        print(f"part {picks.instances[k] + 1} by {picks.names[k]}, clearance {picks.clearances[k]:.1f} mm")
        print(picks.transforms[k])
    if options.json:
        columns = {name: getattr(picks, name) for name in picks.COLUMNS}
        rows = [dict(zip(columns, row)) for row in zip(*columns.values())]
        scripting.write_json(options.json, {"report": picks.report, "advice": picks.advice, "picks": rows})
