# SPDX-License-Identifier: BSD-3-Clause
"""One page of a dataset that was evaluated: the figures, a row for each image, and of the chosen one the page of its scan, with the
poses that are right, those that are wrong and the copies that were missed."""
import os
from html import escape

import numpy

from .. import inputs, scripting
from . import content, listing, markup, notebook, page
from .told import Told

ALL_POINTS = 3000000  # of all scans together: 30 MB
FEWEST_POINTS = 30000  # of a scan: with fewer a part is hardly seen
MOST_BYTES = 40e6  # of all scans together
PIXELS = 1000  # along a picture's longer side
FEW_OBJECTS = 2  # of more objects each has fewer triangles
COLORS = {"right": "#2a9d4a", "wrong": "#dc1e1e", "missed": "#f2b705"}
COLUMNS = ("image", "copies to find", "found", "missed", "wrong poses", "")
TOLD = "Copies to find are half visible and more; others count as right where they are found. Wrong poses are on no copy, turned, or second ones."
WRONG = {1: "A better pose has the same copy.", 2: "A copy is here, turned otherwise:", 3: "No copy is here: the nearest is"}  # by Outcome


class Images:
    """The images of an evaluation of `objects`, meshes by number; `count`: how many there will be at most. Where all scans together
    are too large, those stay in which the most is missed and wrong."""

    def __init__(self, objects, count):
        most = content.MOST_TRIANGLES * FEW_OBJECTS // max(FEW_OBJECTS, len(objects))
        self.numbers = list(objects)
        self.parts = [content.Part(f"object {number}", mesh, most) for number, mesh in objects.items()]
        self.most = min(max(ALL_POINTS // max(count, 1), FEWEST_POINTS), content.MOST_POINTS)
        self.rows, self.scans = [], {}  # scans: by the row's place how much is missed and wrong, and the slots of page.html

    def add_failed(self, name, failure):
        """An image that cannot be read."""
        self.rows.append((name, ["", "", "", ""], failure))

    def add(self, name, image, camera, judged, failures, options):
        """An image: `judged`, by the object's number, its poses, true poses, the columns of Evaluation.judged_image() and the reasons of
        missed copies, by their place; `options`: of the command."""
        seen = content.Seen(inputs.scan_of(image.scan, image=image.beside, image_camera=camera if image.beside else None), self.most)
        rows, counts = [], numpy.zeros(4, int)
        for number, (poses, truth, columns, reasons) in judged.items():
            part = self.numbers.index(number)
            new = rows_of(seen, self.parts[part], poses, truth, columns, reasons, len(rows))
            counts += counts_of(columns, new)
            rows += [{**row, "part": part, "rank": rank} for rank, row in enumerate(new, len(rows) + 1)]
        told = Told.of_evaluation(options, [self.parts[self.numbers.index(number)].name for number in judged], name,
                                  [poses for poses, *_ in judged.values()])
        wanted, *_, missed, wrong = counts.tolist()
        legend = [(f"{kind}: {sum(row['judged'] == kind and is_shown(row) for row in rows)}", color) for kind, color in COLORS.items()]
        words = f"{wanted - missed} of {wanted} copies that are visible enough were found; {wrong} likely poses are wrong."
        slots = page.slots_of(seen, rows, [part.name for part in self.parts], told, words, legend, PIXELS)
        self.scans[len(self.rows)] = missed + wrong, page.json_of(slots)
        self.rows.append((name, counts.tolist(), "; ".join(failures)))
        while sum(len(text) for _, text in self.scans.values()) > MOST_BYTES:
            del self.scans[min(self.scans, key=lambda place: (self.scans[place][0], -place))]

    def html(self, title, figures):
        """The page; `figures` is a text."""
        def cells(place):
            name, counts, note = self.rows[place]
            link = f'<a href="#image{place}">{escape(name)}</a>' if place in self.scans else escape(name)
            return [link, *map(str, counts), escape(note)], bool(note)

        left = sum(counts[0] != "" for _, counts, _ in self.rows) - len(self.scans)
        few = f"<p>Left out, for the page would be too large: the scans of {left} images with the fewest errors. --scenes chooses others.</p>"
        scans = "".join(f'<script type="application/json" id="image{place}">{text}</script>' for place, (_, text) in self.scans.items())
        shared = page.json_of({"page": page.filled({}), "parts": [part.content() for part in self.parts]})
        after = (f"{few if left else ''}<noscript><p>This browser runs no scripts, so the scans are missing.</p></noscript>"
                 f'<iframe height="{notebook.HEIGHT}"></iframe>'
                 f'{scans}<script type="application/json" id="shared">{shared}</script>'
                 f'<script>{page.text_of(os.path.join(page.HERE, "judged.js"))}</script>')
        before = f"<pre>{escape(figures)}</pre><p>{TOLD}</p>"
        return listing.html(title, COLUMNS, map(cells, range(len(self.rows))), before, after)


def is_shown(row):
    """At first: what is right or missed, and of what is wrong what claims to be likely."""
    return row["judged"] != "wrong" or row.get("place", 1) >= markup.LIKELY


def counts_of(columns, rows):
    """How many copies have to be found, were, were not, and how many likely poses are wrong."""
    wanted, by = columns[1]["HasToBeFound"] == 1, columns[1]["FoundBy"] > 0
    wrong = sum(row["judged"] == "wrong" and is_shown(row) for row in rows)
    return numpy.array((wanted.sum(), (wanted & by).sum(), (wanted & ~by).sum(), wrong))


def rows_of(seen, part, poses, truth, columns, reasons, before):
    """Those of content.pose_rows(), of the poses and of the copies that were missed, behind so many of other objects."""
    def off(of, k):
        return f"{of['TranslationError'][k]:.2f} mm and {of['RotationError'][k]:.2f} degrees off"

    of_poses, of_copies = columns
    rows = content.pose_rows(seen, [part], poses)
    for k, row in enumerate(rows):
        outcome = int(of_poses["Outcome"][k])
        if not poses.GetFieldData().HasArray("SecondsTotal"):  # poses of another program have scores alone
            row = rows[k] = {name: value for name, value in row.items() if name == "score" or name not in content.NUMBERS}
        row["judged"] = "wrong" if outcome else "right"
        row["why"] = WRONG[1] if outcome == 1 else f"{WRONG.get(outcome, 'Right:')} {off(of_poses, k)}."
    missed = numpy.flatnonzero((of_copies["HasToBeFound"] == 1) & (of_copies["FoundBy"] == 0))
    places = scripting.poses_of(scripting.column(truth, "Transform", 4, 4)[missed])
    for k, row in zip(missed.tolist(), content.pose_rows(seen, [part], places)):
        nearest = f"The nearest pose, rank {before + of_copies['NearestRank'][k]}, is {off(of_copies, k)}." if of_copies["NearestRank"][k] else ""
        rows.append({**row, "judged": "missed", "tag": "missed", "visible": float(of_copies["VisibleFraction"][k]),
                     "why": reasons.get(k) or nearest or "No pose came out."})
    return [{**row, "color": COLORS[row["judged"]]} for row in rows]
