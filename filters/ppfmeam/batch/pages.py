# SPDX-License-Identifier: BSD-3-Clause
"""A page for each scan of a run, and index.html, which lists them."""
import html
import os
import urllib.parse

from .. import inputs, scripting
from ..report import page
from ..report.content import Part
from ..report.told import Told

STYLE = """<style>body { font: 14px/1.5 system-ui, "DejaVu Sans", Arial, sans-serif; color: #1d2127; padding: 18px 22px; }
table { border-collapse: collapse; } td, th { text-align: left; padding: 3px 14px 3px 0; border-bottom: 1px solid #dadee3; }
.failed td { color: #b3261e; }</style>"""


def require(folder):
    """Raises a Failure when no pages can be written to a folder, which is made; nothing without one."""
    if folder:
        page.require_three()
        scripting.make_folder(folder)


def path_of(folder, name):
    """000000/000012 of a dataset is 000000_000012.html."""
    return os.path.join(folder, name.replace("/", "_") + ".html")


class Pages:
    """Of the parts, (path, whether it is a mesh and not a model)."""

    def __init__(self, options, parts):
        self.options, self.parts = options, []
        for path, is_mesh in parts if options.report else ():
            shape = scripting.read_mesh(path, scale=options.cad_scale, solid=options.solid) if is_mesh else scripting.shape_of(scripting.read_model(path))
            self.parts.append(Part(os.path.basename(path), shape))

    def write(self, name, scan, poses):
        """That of a scan (scans.Scan)."""
        if not self.options.report:
            return
        seen = inputs.scan_of(scan.scene, image=scan.image, image_camera=scan.image_camera if scan.image else None)
        told = Told.of_batch(self.options, [part.name for part in self.parts], name, poses)
        page.write(path_of(self.options.report, name), page.html(seen, poses, self.parts, told))


def write_index(folder, lines):
    """Of the journal's lines, in the order of the scans."""
    rows = []
    for line in lines:
        name, path = line["scan"], path_of(folder, line["scan"])
        link = f'<a href="{urllib.parse.quote(os.path.basename(path))}">{html.escape(name)}</a>' if os.path.exists(path) else html.escape(name)
        likely = f"{100 * float(line['rows'][0][3]):.0f} %" if line["rows"] else ""
        cells = (link, str(len(line["rows"])), likely, f"{float(line['find_s']):.2f} s", html.escape(line["failure"] or line["warning"]))
        rows.append(f"<tr{' class=failed' * bool(line['failure'])}>" + "".join(f"<td>{cell}</td>" for cell in cells) + "</tr>")
    head = "".join(f"<th>{name}</th>" for name in ("scan", "poses", "the best is likely", "time", "what was said"))
    with scripting.written(os.path.join(folder, "index.html")) as file:
        file.write(f'<!DOCTYPE html><html lang="en"><meta charset="utf-8"><title>{len(lines)} scans</title>{STYLE}<h1>{len(lines)} scans</h1>'
                   f"<table><tr>{head}</tr>{''.join(rows)}</table></html>\n")
