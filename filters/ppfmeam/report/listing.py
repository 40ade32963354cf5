# SPDX-License-Identifier: BSD-3-Clause
"""The list of many scans as a page: a row for each."""
from html import escape

STYLE = """body { font: 14px/1.5 system-ui, "DejaVu Sans", Arial, sans-serif; color: #1d2127; padding: 18px 22px; }
table { border-collapse: collapse; } td, th { text-align: left; padding: 3px 14px 3px 0; border-bottom: 1px solid #dadee3; }
th, td:nth-child(-n+5) { white-space: nowrap; } tr.chosen { background: #e8f0fe; } .failed td { color: #b3261e; } pre { overflow-x: auto; }
iframe { border: 0; width: 100%; margin-top: 14px; }"""


def html(title, columns, rows, before="", after=""):
    """The page. Of each row the cells, HTML, and whether the scan failed; before and after the table HTML, too."""
    head = "".join(f"<th>{escape(name)}</th>" for name in columns)
    body = "".join(f"<tr{' class=failed' * failed}>" + "".join(f"<td>{cell}</td>" for cell in cells) + "</tr>" for cells, failed in rows)
    return (f'<!DOCTYPE html><html lang="en"><meta charset="utf-8"><title>{escape(title)}</title><style>{STYLE}</style>'
            f"<h1>{escape(title)}</h1>{before}<table><tr>{head}</tr>{body}</table>{after}</html>\n")
