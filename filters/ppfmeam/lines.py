# SPDX-License-Identifier: BSD-3-Clause
"""CSV files that grow by whole lines, so that a run that was stopped goes on from them."""
import csv
import io
import os

from . import scripting


class Lines:
    """A CSV file and its rows; of those that an earlier run left, the ones that `keep` takes. A line that is not whole is
    dropped."""

    def __init__(self, path, columns, keep=lambda row: True):
        self.path, self.rows, self.columns = path, [], columns
        if os.path.exists(path):
            whole = scripting.whole_lines(path)
            self.rows = [row for row in csv.DictReader(whole) if keep(row)]
            if whole and next(csv.reader(whole[:1])) != list(columns):
                raise scripting.Failure(f"{path} is not of this version: remove it, or choose another folder")
        with scripting.written(path, newline="") as file:
            self.write(file, self.rows, head=True)

    def write(self, file, rows, head=False):
        writer = csv.DictWriter(file, self.columns, lineterminator="\n")
        if head:
            writer.writeheader()
        writer.writerows(rows)

    def add(self, rows):
        text = io.StringIO()
        self.write(text, rows)
        with scripting.writing(self.path), open(self.path, "ab", buffering=0) as file:
            scripting.append(file, text.getvalue())
        self.rows += [{name: str(value) for name, value in row.items()} for row in rows]
