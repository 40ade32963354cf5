# SPDX-License-Identifier: BSD-3-Clause
"""Trains the model of a part from its CAD file, for `detect --model`; says what symmetries the part has and what they mean."""
import json
import time
import warnings

from .. import choices, scripting

LEAST_DIAMETER = 1.0  # mm: a part that is smaller is one in metres


def main():
    parser = scripting.Parser(description=__doc__)
    parser.add_argument("--cad", required=True, help="CAD file: .step or .iges, or .stl, .obj, .ply or .off in mm")
    choices.add_options(parser, "train", "offset", "scale")
    choices.add_options(parser, "read", "solid")
    scripting.add_method_options(parser)
    choices.add_options(parser, "train", "features")
    parser.add_argument("--out", required=True, help="the trained model to write: NAME.meam, or NAME.vtpc with a folder NAME beside")
    parser.add_argument("--models-info", metavar="FILE",
                        help="write diameter, bounds and symmetries as a BOP models_info.json; the part is object 1")
    parser.add_argument("--json", metavar="FILE", help="write what is printed as JSON")
    options = parser.parse_args()

    scripting.require_model_name(options.out)
    scripting.require_folder_of(options.out, options.models_info, options.json)
    mesh = scripting.read_mesh(options.cad, options.cad_offset, options.cad_scale, options.solid)
    training = scripting.Training(mesh, options.preset, options.features)
    start = time.time()
    model = training.model()
    seconds = time.time() - start
    samples = training.symmetric_samples()
    scripting.write_model(model, options.out)  # last: whoever stops the training finds no file
    told = {"model": options.out, "edge_points": scripting.field(model, "NumberOfEdgePoints"),
            "pairs": scripting.field(model, "NumberOfPairs") + scripting.field(model, "NumberOfSurfacePairs"),
            "table_bytes": scripting.field(model, "TableBytes"), "diameter": scripting.field(model, "Diameter"), "seconds": seconds,
            "symmetries": scripting.symmetry_words(samples), "conclusion": scripting.symmetry_conclusion(samples),
            "border_edges": int(scripting.field(mesh, "BorderEdges"))}
    print("{model}: {edge_points:.0f} edge points, {pairs:.0f} pairs in {megabytes:.1f} MB, part of {diameter:.1f} mm, trained in "
          "{seconds:.1f} s".format(megabytes=told["table_bytes"] / 1e6, **told))
    if told["border_edges"]:
        edges = (3 * scripting.field(mesh, "Triangles") + told["border_edges"]) / 2
        print(f"mesh: open, {told['border_edges']} of its {edges:.0f} edges have a face on one side alone, as a sheet's border; "
              "of a solid body faces are missing there")
    for line in told["symmetries"]:
        print(f"symmetry: {line}")
    print(told["conclusion"])
    if told["diameter"] < LEAST_DIAMETER:
        warnings.warn(f"the part is {told['diameter']:.2g} mm long: a file in metres needs --cad-scale 1000")
    if options.json:
        scripting.write_json(options.json, told)
    if options.models_info:
        entry = json.loads(samples.GetFieldData().GetAbstractArray("ModelsInfo").GetValue(0))
        with scripting.written(options.models_info) as file:
            json.dump({"1": entry}, file, indent=2)
            file.write("\n")
