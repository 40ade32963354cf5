# SPDX-License-Identifier: BSD-3-Clause
"""Results as rows, which are dictionaries: what failed on the way, tables in Markdown, CSV files, and programs made of functions
that return rows."""
import argparse
import contextlib
import csv
import inspect
import sys
import time

import numpy

from ppfmeam import scripting

failed = []  # what failed so far


@contextlib.contextmanager
def told(where):
    """Says on stderr what fails there, and remembers it."""
    try:
        yield
    except scripting.Failure as failure:
        print(f"{where}: {failure}", file=sys.stderr)
        failed.append(where)


def require_whole():
    """Raises a Failure when something has failed."""
    if failed:
        raise scripting.Failure(f"{len(failed)} failed, see above; where the search or the check of the true poses failed "
                                "nothing counts as found")


class Progress:
    """A line on stderr for each of what is to be done."""

    def __init__(self, total, todo):
        self.total, self.todo, self.done, self.start = total, todo, 0, time.monotonic()

    def tell(self, words):
        self.done += 1
        left = (time.monotonic() - self.start) / self.done * (self.todo - self.done)
        print(f"{self.total - self.todo + self.done} of {self.total}: {words}; {left / 60:.0f} min left", file=sys.stderr,
              flush=True)


def values(rows, name):
    """A column as numbers, without what is empty."""
    return numpy.array([float(row[name]) for row in rows if row[name] not in ("", None)])


def median(rows, name):
    column = values(rows, name)
    return float(numpy.median(column)) if column.size else None


def words_of(value, digits=1):
    """Numbers rounded; what is not known is a dash."""
    if value is None or value != value:
        return "-"
    return f"{value:.{digits}f}" if isinstance(value, float) else str(value)


def markdown(head, rows):
    """A table of lists of words."""
    return "\n".join("| " + " | ".join(map(str, row)) + " |" for row in (head, ["---"] * len(head),
                                                                         *rows)).replace("| --- ", "|---")


def table(rows):
    """The rows in Markdown, floats with three digits."""
    return markdown(list(rows[0]), [[words_of(value, 3) for value in row.values()]
                                    for row in rows]) if rows else "nothing was measured"


def write(path, rows):
    """The rows as CSV: what is not known is empty."""
    with scripting.written(path, newline="") as file:
        writer = csv.DictWriter(file, list(rows[0]), lineterminator="\n")
        writer.writeheader()
        writer.writerows({name: "" if value is None or value != value else f"{value:.6g}" if isinstance(value, float) else value
                          for name, value in row.items()} for row in rows)


def read(path):
    """The rows of such a file, all values as text."""
    with open(path, encoding="utf-8", newline="") as file:
        return list(csv.DictReader(file))


def names_of(known):
    """For argparse: some of the known names, with commas between them."""
    def chosen(text):
        names = text.split(",")
        unknown = [name for name in names if name not in known]
        if unknown:
            raise argparse.ArgumentTypeError(f"there is no {unknown[0]}; known are {', '.join(known)}")
        return names
    return chosen


def command(measure, **helps):
    """Runs a program that is a function. Its parameters are arguments, or options where they have a default; a tuple is what an
    option may choose from, all by default, and an annotation reads the words. Prints the rows that it returns; --out CSV writes
    them."""
    parser = argparse.ArgumentParser(description=inspect.getmodule(measure).__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    for name, parameter in inspect.signature(measure).parameters.items():
        required, read_words, default = parameter.default is parameter.empty, parameter.annotation, parameter.default
        if read_words is parameter.empty:
            read_words = str if required or default is None else names_of(default) if isinstance(default, tuple) \
                else scripting.count if isinstance(default, int) else type(default)
        shown = ",".join(map(str, default)) if isinstance(default, (tuple, list)) else default
        parser.add_argument(name if required else "--" + name.replace("_", "-"), type=read_words, help=" ".join(filter(None, (
            helps.get(name), "" if required or default is None else f"(default: {shown})"))).replace("%", "%%"),
                            **({} if required else {"default": default}))
    parser.add_argument("--out", metavar="CSV", help="write the rows")

    def main():
        options = vars(parser.parse_args())
        out = options.pop("out")
        scripting.require_folder_of(out)
        rows = measure(**options)
        print(table(rows))
        if out:
            write(out, rows)
        require_whole()
    scripting.run(main)
