# SPDX-License-Identifier: BSD-3-Clause
"""The picture with its outlines and the table of poses as HTML, for the page and for notebooks."""
from html import escape

LIKELY = 0.5  # poses that are less likely to be there are hidden at first, as ParaView hides them

COLUMNS = (  # heading, what it means, of a row its text
    ("judged", "beside the true poses", lambda row: row["judged"]),
    ("likely", "place probability: how likely a copy is there, however it is turned", lambda row: f"{100 * row['place']:.0f} %"),
    ("rotation", "certainty: how likely it is turned like this, where a copy is there", lambda row: f"{100 * row['certainty']:.0f} %"),
    ("probability", "of the pose: the product of the two", lambda row: f"{100 * row['probability']:.0f} %"),
    ("score", "share of what should be seen of the part that the scan has", lambda row: f"{100 * row['score']:.0f} %"),
    ("visible", "share of its side towards the sensor that nothing hides", lambda row: f"{100 * row['visible']:.0f} %"),
    ("residual", "root mean square between part and scan, mm", lambda row: f"{row['residual']:.2f} mm"),
    *((axis, f"{axis} of the part's origin in the scan's coordinates, mm", lambda row, k=k: f"{row['transform'][4 * k + 3]:.2f}")
      for k, axis in enumerate("xyz")))


def picture(content, rows):
    """The picture, and over it a path for each pose, the best one on top."""
    width, height = content["width"], content["height"]
    paths = "".join(
        f'<path data-rank="{row["rank"]}" class="outline{faint(row)}" d="{row["outline"]}" '
        f'fill="{row["color"]}" stroke="{row["color"]}" fill-opacity=".12" stroke-width="2" vector-effect="non-scaling-stroke"><title>{row["rank"]}</title></path>'
        for row in reversed(rows) if row["outline"])
    return (f'<svg class="picture" viewBox="-0.5 -0.5 {width} {height}" role="img" '
            'aria-label="the scan with the outlines of the parts">'
            f'<image x="-0.5" y="-0.5" width="{width}" height="{height}" preserveAspectRatio="none" '
            f'href="data:image/jpeg;base64,{content["jpeg"]}"/>{paths}</svg>')


def table(rows, names):
    """A row for each pose; with the name of its part where there are several."""
    if not rows:
        return '<p class="none">no part found</p>'
    known = [column for column in COLUMNS if any(said(column, row) for row in rows)]
    part = '<th class="text">part</th>' if len(names) > 1 else ""
    head = "".join(f'<th title="{escape(meaning)}">{escape(name)}{" (mm)" * (name in "xyz")}</th>' for name, meaning, _ in known)
    body = "".join(
        f'<tr data-rank="{row["rank"]}" class="pose{faint(row)}" tabindex="0"><td><b class="rank" '
        f'style="background:{row["color"]};color:{ink(row["color"])}">{row.get("tag", row["rank"])}</b></td>' +
        (f'<td class="text">{escape(names[row["part"]])}</td>' if part else "") +
        "".join(f"<td>{said(column, row)}</td>" for column in known) + "</tr>" for row in rows)
    return f'<table class="poses"><thead><tr><th>rank</th>{part}{head}</tr></thead><tbody>{body}</tbody></table>'


def said(column, row):
    try:
        return column[2](row)
    except KeyError:  # poses of another program, and true ones, have no such number
        return ""


def faint(row):
    return " unlikely" if row.get("place", 1) < LIKELY else ""


def ink(color):
    """Black or white, whichever is read on a colour."""
    red, green, blue = (int(color[k:k + 2], 16) for k in (1, 3, 5))
    return "#fff" if 0.3 * red + 0.59 * green + 0.11 * blue < 140 else "#111"
