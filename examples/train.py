#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Trains the model of a part from its CAD file, for detect.py --model."""
import argparse
import time

from ppfmeam import scripting


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--cad", required=True, help="CAD file: .stl, .obj or .ply, in mm")
    parser.add_argument("--cad-offset", nargs=3, type=float, default=(0, 0, 0), metavar=("X", "Y", "Z"),
                        help="added to the CAD's coordinates, in mm")
    parser.add_argument("--cad-scale", type=float, default=1, metavar="F", help="factor to mm: 1000 for a CAD in metres")
    parser.add_argument("--preset", choices=("paper", "recommended"), default="recommended",
                        help="parameters of all steps (default: %(default)s)")
    parser.add_argument("--out", required=True, help="the trained model to write: NAME.vtpc, with a folder NAME beside")
    options = parser.parse_args()

    scripting.require_folder_of(options.out)
    start = time.time()
    model = scripting.train(scripting.read_mesh(options.cad, options.cad_offset, options.cad_scale), options.preset)
    scripting.write_model(model, options.out)
    print(f"{options.out}: {scripting.field(model, 'NumberOfEdgePoints'):.0f} edge points, "
          f"{scripting.field(model, 'NumberOfPairs'):.0f} pairs, part of {scripting.field(model, 'Diameter'):.1f} mm, "
          f"{time.time() - start:.1f} s")


scripting.run(main)
