# SPDX-License-Identifier: BSD-3-Clause
"""Trains the model of a part from its CAD file, for `detect --model`; says what symmetries the part has."""
import argparse
import json
import time

from .. import choices, scripting


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--cad", required=True, help="CAD file: .stl, .obj, .ply or .off, in mm")
    choices.add_options(parser, "train", "offset", "scale")
    scripting.add_method_options(parser)
    choices.add_options(parser, "train", "features")
    parser.add_argument("--out", required=True, help="the trained model to write: NAME.meam, or NAME.vtpc with a folder NAME beside")
    parser.add_argument("--models-info", metavar="FILE",
                        help="write diameter, bounds and symmetries as a BOP models_info.json; the part is object 1")
    options = parser.parse_args()

    scripting.require_folder_of(options.out, options.models_info)
    training = scripting.Training(
        scripting.read_mesh(options.cad, options.cad_offset, options.cad_scale), options.preset, options.features)
    start = time.time()
    model = training.model()
    seconds = time.time() - start
    scripting.write_model(model, options.out)
    print(f"{options.out}: {scripting.field(model, 'NumberOfEdgePoints'):.0f} edge points, "
          f"{scripting.field(model, 'NumberOfPairs') + scripting.field(model, 'NumberOfSurfacePairs'):.0f} pairs in {scripting.field(model, 'TableBytes') / 1e6:.1f} MB, "
          f"part of {scripting.field(model, 'Diameter'):.1f} mm, trained in {seconds:.1f} s")
    samples = training.symmetric_samples()
    for line in scripting.symmetry_words(samples):
        print(f"symmetry: {line}")
    if options.models_info:
        entry = json.loads(samples.GetFieldData().GetAbstractArray("ModelsInfo").GetValue(0))
        with scripting.written(options.models_info) as file:
            json.dump({"1": entry}, file, indent=2)
            file.write("\n")
