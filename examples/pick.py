#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""From a scan to picks: where jaws can take which part out of the bin, best first, and what is against the others."""
import argparse

import numpy

import ppfmeam
from ppfmeam import scripting


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("part", help="the CAD, mm")
    parser.add_argument("scan", help="an organized cloud of the bin, from above")
    parser.add_argument("--opening", type=float, default=60.0, metavar="MM", help="of the jaws (default: %(default)s)")
    options = parser.parse_args()
    model = ppfmeam.train(options.part)
    grasps = ppfmeam.grasps(options.part, symmetries=model, opening=options.opening)
    found = ppfmeam.detect(model, options.scan, poses=0, probability=0.5)
    picks = ppfmeam.pick(found, grasps, options.scan)
    print(picks.report, picks.advice)
    for k in numpy.flatnonzero(picks.possible):
        print(f"part {picks.instances[k] + 1} by {picks.names[k]}, clearance {picks.clearances[k]:.1f} mm")
        print(picks.transforms[k])


scripting.run(main)
