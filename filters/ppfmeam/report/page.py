# SPDX-License-Identifier: BSD-3-Clause
"""One file that shows in any browser, without a network, what was found: the scan and the parts in 3D, the image with their
outlines, and the table of poses."""
import datetime
import json
import math
import os
import re
from html import escape

from vtkmodules.vtkCommonCore import vtkVersion

from .. import scripting
from ..version import VERSION
from . import content, markup

HERE = os.path.dirname(os.path.abspath(__file__))
THREE = "/usr/share/javascript/three"  # of Debian's package libjs-three; its licence stands in page.html
PLACE = "#969696"  # of the part at a place that is asked about: colours are those of its points
FEW = 5  # ranks that a sentence names
BAR = 140  # pixels that stand for the longest time
EXTENSIONS = (".html", ".htm")
LIBRARIES = ("three.min.js", "examples/js/controls/OrbitControls.js")


def require_three():
    """Raises a Failure when pages cannot be made here."""
    if not all(os.path.exists(os.path.join(THREE, name)) for name in LIBRARIES):
        raise scripting.Failure("a page in 3D needs three.js: install the Debian package libjs-three")


def require(path):
    """Raises a Failure when a page of this name cannot be made here; nothing without one."""
    if path:
        require_three()
        if not path.lower().endswith(EXTENSIONS):
            raise scripting.Failure(f"{path}: the name of a page ends in .html")


def text_of(path):
    with open(path, encoding="utf-8") as file:
        return file.read()


def html(scan, poses, parts, told):
    """The page of a scan, as the C++ library has it, poses, VTK's data object, and the parts (content.Part) that they are of."""
    seen = content.Seen(scan)
    rows = content.pose_rows(seen, parts, poses, told.reasons)
    for row in rows if told.diagnosis else ():
        row.update(color=PLACE, tag="place")
    slots = slots_of(seen, rows, [part.name for part in parts], told, str(told.diagnosis) if told.diagnosis else f"{summary(rows)} {told.advice}".rstrip())
    slots["DATA"] = json_of({**slots["DATA"], "parts": [part.content() for part in parts]})
    return filled(slots)


def slots_of(seen, rows, names, told, words, legend=(), pixels=content.MOST_PIXELS):
    """What of page.html depends on a scan (content.Seen): its rows of content.pose_rows(), the names of the parts, the summary in
    words, names and colors of a legend. DATA lacks the parts."""
    marks = content.marks(told.diagnosis) if told.diagnosis else None
    data = {"scan": seen.content(), "poses": rows, "why": told.why, "likely": markup.LIKELY, "chosen": told.chosen, "marks": marks,
            "grippers": [content.gripper(*each) for each in told.grippers],
            "legend": marks["legend"] if marks else legend}
    return {"TITLE": escape(told.title), "SUMMARY": escape(words), "PICTURE": markup.picture(seen.picture_content(pixels), rows),
            "CAPTION": CAPTIONS[seen.what], "TABLE": markup.table(rows, names), "RUN": run(told, seen), "DATA": data}


def filled(slots):
    """page.html with libraries and script, and with these texts in their places."""
    require_three()
    fixed = {"THREE": "\n".join(text_of(os.path.join(THREE, name)) for name in LIBRARIES), "SCRIPT": text_of(os.path.join(HERE, "page.js"))}
    return re.sub("@([A-Z]+)@", lambda found: {**fixed, **slots}.get(found[1], found[0]), text_of(os.path.join(HERE, "page.html")))


def json_of(data):
    """For a script element."""
    return json.dumps(data, separators=(",", ":")).replace("<", "\\u003c")


def write(path, text):
    """Writes a page, whole or not at all."""
    with scripting.written(path) as file:
        file.write(text)


CAPTIONS = {"image": "The image and the outlines of the parts.",
            "surface": "The scan as its sensor sees it, lit from there, and the outlines of the parts: it has no image.",
            "map": "The scan from where it was seen, the nearer the brighter, and the outlines of the parts: its points are not organized."}


def summary(rows):
    """What was found, in a sentence or two."""
    if not rows:
        return "No part was found."
    if "place" not in rows[0]:
        return f"{len(rows)} pose{'s' * (len(rows) > 1)} came out; the method does not tell how likely a copy is there."
    likely = [row for row in rows if row["place"] >= markup.LIKELY]
    words = f"{len(likely)} of {len(rows)} poses {'is' if len(likely) == 1 else 'are'} more likely there than not"
    unsure = [str(row["rank"]) for row in likely if row["certainty"] < markup.LIKELY]
    if unsure:
        of = f"at rank {', '.join(unsure)}" if len(unsure) <= FEW else f"for {len(unsure)} of them"
        words += f"; how the part is turned is unsure {of}"
    return words + "."


def run(told, seen):
    """How it was found: the scan, times or numbers of the steps, settings, versions and the command."""
    facts = "".join(f"<li>{escape(fact)}</li>" for fact in [
        *told.facts, f"{len(seen.points)} of {seen.total} measured points are shown"])
    settings = rows_of((escape(name), escape(str(value))) for name, value in told.settings.items())
    versions = f"ppfmeam {VERSION}, VTK {vtkVersion.GetVTKVersion()}, made {datetime.datetime.now():%Y-%m-%d %H:%M}"
    return (f"<div><h3>Scan</h3><ul>{facts}</ul></div><div>{steps(told)}</div>"
            f"<div><h3>Settings that differ from the defaults</h3><table>{settings or 'none'}</table></div>"
            f'<div><h3>Find it again</h3><pre>{escape(told.command)}</pre><p class="quiet">{escape(versions)}</p></div>')


def steps(told):
    """A table of the steps' times, each with a bar, or of their numbers."""
    if told.diagnosis:
        numbers = rows_of((escape(step), escape(quantity), f"{value:.4g}" + ("" if math.isnan(of) else f" / {of:.4g}"))
                          for step, quantity, value, of in told.diagnosis.numbers)
        return f"<h3>Numbers of the steps</h3><table>{numbers}</table>"
    longest = max(told.seconds.values(), default=0) or 1
    times = rows_of((escape(stage), f"{seconds:.3f} s", f'<i style="width:{BAR * seconds / longest:.0f}px"></i>')
                    for stage, seconds in told.seconds.items())
    return f'<h3>Time</h3><table class="times">{times}</table>'


def rows_of(rows):
    """The rows of a table of texts."""
    return "".join("<tr>" + "".join(f'<td class="text">{cell}</td>' for cell in row) + "</tr>" for row in rows)
