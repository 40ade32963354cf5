# SPDX-License-Identifier: BSD-3-Clause
"""How ppfmeam.detect()'s result shows itself: in a notebook, and as a page in the browser."""
import html
import sys
import tempfile
import webbrowser

from .. import scripting
from . import content, markup, page
from .told import Told

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


def page_of(found):
    """The page as text."""
    return page.html(found.scan(), found.data, parts_of(found), Told.of_python(found))


def save(found, path):
    page.require(path)
    scripting.require_folder_of(path)
    page.write(path, page_of(found))


class Frame:
    """A page that stands in a notebook."""

    def __init__(self, text):
        self.text = text

    def __repr__(self):
        return "<a page that a notebook shows>"

    def _repr_html_(self):
        return f'<iframe srcdoc="{html.escape(self.text)}" width="100%" height="{HEIGHT}" style="border: 0"></iframe>'


def show(found):
    """In a notebook the page, elsewhere the name of the file that the browser opens."""
    text = page_of(found)
    if "ipykernel" in sys.modules:
        return Frame(text)
    with tempfile.NamedTemporaryFile("w", encoding="utf-8", prefix="found_", suffix=".html", delete=False) as file:
        file.write(text)
    webbrowser.open("file://" + file.name)
    return file.name
