# SPDX-License-Identifier: BSD-3-Clause
"""The parts that a run looks for: trained models, CAD files, or the objects of a BOP dataset. Training is done once, by
one process; the others read the model's file."""
import hashlib
import os

from .. import dataset, scripting


class Part:
    """`number`: its obj_id; `files`: what it is made of; train(), or None where the first of these is the trained
    model."""

    def __init__(self, number, files, train=None):
        self.number, self.files, self.train = number, files, train

    def digest(self):
        """Of all that is in its files."""
        sums = hashlib.sha256()
        for path in self.files:
            scripting.require_file(path)
            with open(path, "rb") as file:
                sums.update(file.read())
        return sums.hexdigest()


def files_of_model(path):
    """A trained model's file; of NAME.vtpc also its pieces in the folder NAME."""
    name, extension = os.path.splitext(path)
    pieces = sorted(os.listdir(name)) if extension.lower() == ".vtpc" and os.path.isdir(name) else ()
    return [path, *(os.path.join(name, piece) for piece in pieces)]


def trainer(options, path):
    return lambda: scripting.train(scripting.read_mesh(path, scale=options.cad_scale, solid=options.solid), options.preset, options.features)


def parts_of(options):
    """Those of --model or --cad, numbered from 1; without these the objects of the dataset."""
    if options.model:
        return [Part(number, files_of_model(path)) for number, path in enumerate(options.model, 1)]
    if options.cad:
        return [Part(number, [path], trainer(options, path)) for number, path in enumerate(options.cad, 1)]
    if not os.path.isdir(os.path.join(options.scans, options.split)):
        raise scripting.Failure(f"give the parts, --model or --cad: {options.scans} is no BOP dataset with a folder "
                                f"{options.split}")
    data = dataset.Dataset(options.scans, options.split)
    known = data.objects()
    unknown = [number for number in options.objects or () if number not in known]
    if unknown:
        raise scripting.Failure(f"{options.scans} has no object {unknown[0]} in models/")
    info = os.path.join(data.path, "models", "models_info.json")
    return [Part(number, [data.mesh_file(number), *([info] if os.path.exists(info) else ())],
                 lambda number=number: data.train(number, options.preset, options.features))
            for number in options.objects or known]


def trained(parts, folder):
    """The files of the trained models, those that have to be trained in `folder`, unless they are there already."""
    paths = []
    for part in parts:
        path = part.files[0]
        if part.train:
            path = os.path.join(folder, f"part{part.number}.meam")
            if not os.path.exists(path):
                scripting.write_model(part.train(), path)
        paths.append(path)
    return paths
