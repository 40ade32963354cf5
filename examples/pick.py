#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""From a scan to picks: where jaws or a cup can take which part out of the bin, best first, and what is against the others."""
import argparse

import numpy

import ppfmeam
from ppfmeam import scripting


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("part", help="the CAD, mm")
    parser.add_argument("scan", help="an organized cloud of the bin, from above")
    parser.add_argument("--opening", type=float, default=60.0, metavar="MM", help="of the jaws (default: %(default)s)")
    parser.add_argument("--cup", type=float, metavar="MM", help="diameter of a suction cup, in place of the jaws")
    parser.add_argument("--no-bin", action="store_true", help="the parts lie in no bin: do not look for one")
    options = parser.parse_args()
    if options.cup is None:
        gripper, kind, lengths = "jaws", "parallel", {"opening": options.opening}
    else:
        gripper, kind, lengths = "cup", "suction", {"cup_diameter": options.cup}
    model = ppfmeam.train(options.part)
    grasps = ppfmeam.grasps(options.part, propose=kind, symmetries=model, **lengths)
    found = ppfmeam.detect(model, options.scan, poses=0, probability=0.5)
    picks = ppfmeam.pick(found, grasps, options.scan, gripper=gripper,
                         bin="none" if options.no_bin else "detected")
    print(picks.report, picks.advice)
    for k in numpy.flatnonzero(picks.possible):
        print(f"part {picks.instances[k] + 1} by {picks.names[k]}, clearance {picks.clearances[k]:.1f} mm")
        print(picks.transforms[k])


scripting.run(main)
