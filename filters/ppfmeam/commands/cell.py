# SPDX-License-Identifier: BSD-3-Clause
"""Simulates a picking cell: parts fall into a bin, a sensor scans it, the best pick of what is found is played among the true
parts, the part is taken away and the others settle, until the bin is empty or nothing can be picked. Prints Table 9 of the
paper, with every failure and its reason.

DIR gets cell.csv, a row for each trial, from which a run goes on that was stopped; table9.md, with a display a chart of it; and of each bin a film
that ParaView plays (.pvd)."""
import argparse

from .. import cell, charts, scripting, simulation


def options_of_user():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--part", choices=simulation.PARTS, action="append", help="again for more (default: ridged_disc)")
    parser.add_argument("--sensor", choices=simulation.SENSORS, action="append", help="again for more (default: structured-light)")
    parser.add_argument("--gripper", choices=("jaws", "cup"), default="jaws", help="default: %(default)s")
    parser.add_argument("--bins", type=scripting.count, default=cell.BINS, help="of each part and sensor (default: %(default)s)")
    parser.add_argument("--copies", type=scripting.count, default=cell.COPIES, help="in a bin, up to 10000 (default: %(default)s)")
    parser.add_argument("--seed", type=scripting.count, default=1, help="of the first bin, the next has the next one")
    parser.add_argument("--threads", type=int, default=0, help="0: all cores")
    parser.add_argument("--pictures", action="store_true", help="a strip of pictures of each bin, too (needs a display)")
    parser.add_argument("--out", required=True, metavar="DIR", help="folder to write")
    options = parser.parse_args()
    if options.bins < 1 or not 1 <= options.copies <= 10000:
        parser.error("--bins has to be 1 or more, --copies 1 to 10000")
    return options


def main():
    options = options_of_user()
    if options.pictures:
        from .. import picture
        picture.require_display()
    print(cell.run(options.out, options.part or ["ridged_disc"], options.sensor or [simulation.SENSORS[0]], options.gripper,
                   options.bins, options.copies, options.seed, options.threads, options.pictures))
    charts.tell_of_display()
