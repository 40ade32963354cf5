# SPDX-License-Identifier: BSD-3-Clause
"""How ppfmeam.detect()'s result shows itself: in a notebook, and as a page in the browser."""
import html
import sys
import tempfile
import webbrowser

from .. import scripting
from . import content, markup, page
from .told import Told, title_of

PIXELS = 800  # along the picture's longer side
HEIGHT = 1000  # pixels of a page in a notebook
STYLE = """<style>
.ppfmeam svg { display: block; max-width: 640px; background: #1c1f24; }
.ppfmeam .outline.unlikely { display: none; }
.ppfmeam tr.unlikely { opacity: .6; }
.ppfmeam th, .ppfmeam td { text-align: right; padding: 2px 8px; }
.ppfmeam .rank { padding: 0 7px; border-radius: 9px; }
</style>"""


def parts_of(found):
    return [content.Part(model.name, model.shape) for model in found.models]


def cell(found):
    """The picture of the outlines and the table."""
    seen, parts, poses = content.Seen(found.scan()), parts_of(found), found.data
    rows = content.pose_rows(seen, parts, poses)
    return (f'<div class="ppfmeam">{STYLE}{markup.picture(seen.picture_content(PIXELS), rows)}'
            f'{markup.table(rows, [part.name for part in parts])}</div>')


def page_of(found, picks=None, command=None):
    """The page as text; of a command with its scan's name, the words that find the same again, and those that tell why a part was missed."""
    told = Told.of_python(found)
    if picks is not None:
        told.add_picks(picks)
    if command is not None:
        scan, told.command, told.why = command
        told.title = title_of(told.names, scan)
    return page.html(found.scan(), found.data, parts_of(found) if picks is None else picks.parts_shown(), told)


def save(found, path, picks=None, command=None):
    page.require(path)
    scripting.require_folder_of(path)
    page.write(path, page_of(found, picks, command))


class Frame:
    """A page that stands in a notebook."""

    def __init__(self, text):
        self.text = text

    def __repr__(self):
        return "<a page that a notebook shows>"

    def _repr_html_(self):
        return f'<iframe srcdoc="{html.escape(self.text)}" width="100%" height="{HEIGHT}" style="border: 0"></iframe>'


def show(found, picks=None):
    """In a notebook the page, elsewhere the name of the file that the browser opens."""
    text = page_of(found, picks)
    if "ipykernel" in sys.modules:
        return Frame(text)
    with tempfile.NamedTemporaryFile("w", encoding="utf-8", prefix="found_", suffix=".html", delete=False) as file:
        file.write(text)
    webbrowser.open("file://" + file.name)
    return file.name
