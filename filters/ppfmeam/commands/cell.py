# SPDX-License-Identifier: BSD-3-Clause
"""Will my bin be emptied? Simulates a picking cell: copies of the part fall into a bin, a sensor scans it, the best pick of what
is found is played among the true parts, the part is taken away and the others come to rest, until the bin is empty, nothing can
be picked, or three picks in a row fail. Prints each pick, and what was left and why.

DIR gets picks.csv, a row for each pick, from which a run goes on that was stopped; of each bin a film that ParaView plays (.pvd),
and a strip of pictures (.png)."""
import argparse
import os
import zlib

from .. import cell, choices, scripting, simulation
from .pick import add_gripper_options, gripper_of

HEAD = ("bin", "pick", "left", "found", "picks", "outcome", "mm off", "degrees", "detection, ms", "planning, ms",
        "by, or why not")


def options_of_user():
    parser = scripting.Parser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--cad", required=True, help="CAD file: .step or .iges, or .stl, .obj, .ply or .off in mm")
    choices.add_options(parser, "train", "scale")
    choices.add_options(parser, "read", "solid")
    simulation.add_sensor_argument(parser)
    add_gripper_options(parser)
    parser.add_argument("--bin", type=choices.factor, nargs=3, metavar=("LENGTH", "WIDTH", "HEIGHT"),
                        help="of the bin inside, mm (default: a square that the copies fill about twice)")
    parser.add_argument("--copies", type=scripting.count, default=20, help="in the bin, up to 10000 (default: %(default)s)")
    parser.add_argument("--bins", type=scripting.count, default=1,
                        help="to fill and pick, one after the other (default: %(default)s)")
    parser.add_argument("--seed", type=scripting.count, default=1,
                        help="of the first bin, the next has the next one (default: %(default)s)")
    parser.add_argument("--threads", type=scripting.count, default=0, help="threads to work with; 0: all cores (default)")
    parser.add_argument("--json", metavar="FILE", help="write what is printed as JSON")
    parser.add_argument("--out", default="cell", metavar="DIR", help="folder to write (default: %(default)s)")
    options = parser.parse_args()
    if options.bins < 1 or not 1 <= options.copies <= 10000:
        parser.error("--bins has to be 1 or more, --copies 1 to 10000")
    return options


def tell(rows, path):
    """Prints the picks, and writes them as JSON, if that is wanted."""
    print_picks(rows)
    if path:
        counts = zip(("bins_done", "bins_emptied", "picks_tried", "parts_taken", "parts_left"), cell.summary(rows))
        scripting.write_json(path, {**dict(counts), "picks": [{name: number_of(value) for name, value in row.items()} for row in rows]})


def number_of(text):
    """What a column of the table holds."""
    try:
        return float(text) if "." in text else int(text)
    except ValueError:
        return text


def print_picks(rows):
    cells = [HEAD, *([row[name] for name in ("seed", "pick", "left", "found", "possible", "outcome", "mm", "degrees", "detect_ms",
                                             "plan_ms", "reason")]
                     for row in rows)]
    widths = [max(len(line[column]) for line in cells) for column in range(len(HEAD) - 1)]
    for line in cells:
        print("  ".join([*(word.rjust(width) for word, width in zip(line, widths)), line[-1]]))
    done, empty, tried, taken, left = cell.summary(rows)
    print(f"{empty} of {done} bins were emptied; {taken} of {tried} picks took a part; {left} parts were left"
          if done else f"no bin is done; {taken} of {tried} picks took a part")


def main():
    options = options_of_user()
    mesh = scripting.read_mesh(options.cad, scale=options.cad_scale, solid=options.solid)
    gripper, lengths = gripper_of(options)
    scripting.require_folder_of(options.json)
    with open(options.cad, "rb") as file:  # another part under the same name is another cell
        digest = zlib.crc32(file.read() + repr((options.cad_scale, options.solid)).encode())
    known = (f"{os.path.splitext(os.path.basename(options.cad))[0]}-{digest:08x}", options.sensor,
             "-".join((gripper, *(f"{name}={value:g}" for name, value in lengths.items()))))
    size = "x".join(f"{side:g}" for side in options.bin) if options.bin else "0"
    wanted = [(*known, size, str(options.copies), str(seed)) for seed in range(options.seed, options.seed + options.bins)]
    picks = cell.Cell(options.out)
    try:
        picks.run(wanted, lambda *_: cell.Station(options.cad, mesh, options.sensor, gripper, lambda diameter: lengths,
                                                  options.threads), options.bin)
    except KeyboardInterrupt:
        tell(picks.rows(wanted), options.json)  # what is known
        raise
    tell(picks.rows(wanted), options.json)
