# SPDX-License-Identifier: BSD-3-Clause
"""A page for each scan of a run, and index.html, which lists them."""
import html
import os
import urllib.parse

from .. import inputs, scripting
from ..report import listing, page
from ..report.content import Part
from ..report.markup import LIKELY
from ..report.told import Told

COLUMNS = ("scan", "likely poses", "poses", "the likeliest", "time", "what was said", "what to change first")
UNKNOWN = "nothing stands out: its page has what was measured of the scan"


def require(folder):
    """Raises a Failure when no pages can be written to a folder, which is made; nothing without one."""
    if folder:
        page.require_three()
        if os.path.isfile(folder) or folder.lower().endswith(page.EXTENSIONS):
            raise scripting.Failure(f"cannot write {folder}: give a folder for the pages of all scans")
        scripting.make_folder(folder)


def path_of(folder, name):
    """000000/000012 of a dataset is 000000_000012.html."""
    return os.path.join(folder, name.replace("/", "_") + ".html")


class Pages:
    """Of the parts, (path, whether it is a mesh and not a model), and their trained models."""

    def __init__(self, options, parts, models):
        self.options, self.parts, self.models = options, [], models
        for (path, is_mesh), name in zip(parts, scripting.part_names(path for path, _ in parts)) if options.report else ():
            shape = scripting.read_mesh(path, scale=options.cad_scale, solid=options.solid) if is_mesh else scripting.shape_of(scripting.read_model(path))
            self.parts.append(Part(name, shape))

    def write(self, name, scan, poses):
        """That of a scan (scans.Scan)."""
        if not self.options.report:
            return
        seen = inputs.scan_of(scan.scene, image=scan.image, image_camera=scan.image_camera if scan.image else None)
        told = Told.of_batch(self.options, [part.name for part in self.parts], name, scan.files, poses, self.models, scan)
        page.write(path_of(self.options.report, name), page.html(seen, poses, self.parts, told))


def write_index(folder, lines):
    """Of the journal's lines, in the order of the scans."""
    def cells(line):
        name, path = line["scan"], path_of(folder, line["scan"])
        link = f'<a href="{urllib.parse.quote(os.fsencode(os.path.basename(path)))}">{html.escape(name)}</a>' if os.path.exists(path) else html.escape(name)
        places = [float(row[3]) for row in line["rows"]]
        likely = sum(place >= LIKELY for place in places)
        said = (line["failure"] or line["warning"], line["advice"] or ("" if likely or line["failure"] else UNKNOWN))
        return [link, str(likely), str(len(places)), f"{100 * max(places):.0f} %" if places else "",
                f"{float(line['find_s']):.2f} s", *map(html.escape, said)], bool(line["failure"])

    with scripting.written(os.path.join(folder, "index.html")) as file:
        file.write(listing.html(f"{len(lines)} scan{'s' * (len(lines) != 1)}", COLUMNS, map(cells, lines)))
