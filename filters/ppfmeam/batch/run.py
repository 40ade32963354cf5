# SPDX-License-Identifier: BSD-3-Clause
"""A run over many scans."""
import os
import time
import warnings

from .. import finding, scripting
from ..report import told
from ..version import VERSION
from . import pages, parts, progress, scans, table
from .apart import Ended, apart
from .journal import Journal
from .ranks import SERVICE_PAUSE, together

ELSEWHERE = ("out", "threads", "watch", "form", "json", "report", "why")  # options that change no pose


class Plan:
    """What the first process finds out for all: the scans, those that are left to do, and the parts."""

    def __init__(self, options, journal):
        scripting.require_folder_of(options.out, table.path_of_scans(options.out), options.json)
        pages.require(options.report)
        self.scans = scans.source(options).list()
        wanted = parts.parts_of(options)
        journal.open({"version": VERSION, "parts": [part.digest() for part in wanted], "columns": list(table.POSES),
                      "scans": os.path.abspath(options.scans),
                      **{name: value for name, value in vars(options).items() if name not in ("scans", *ELSEWHERE)}})
        done, started = journal.lines()
        # Those come first that may have ended a process: before it has threads a process can be copied to search them.
        suspects = [scan for scan in self.scans if scan[0] in started]
        self.todo = suspects + [scan for scan in self.scans if scan[0] not in done and scan[0] not in started]
        self.suspects = len(suspects)
        self.objects = [part.number for part in wanted]
        self.models = parts.trained(wanted, journal.folder)
        self.shapes = [(part.files[0], part.train is not None) for part in wanted]

    def names(self):
        return [scan[0] for scan in self.scans]

    def done(self):
        """How many scans an earlier run has done."""
        return len(self.scans) - len(self.todo)


class Search:
    """Reads scans and finds the parts in them."""

    def __init__(self, options, plan):
        self.source, self.objects = scans.source(options), plan.objects
        models = [scripting.read_model(path) for path in plan.models]
        self.calibrations = list(map(scripting.calibration_of, models))
        self.finder = finding.Finder(models, options)
        self.pages = pages.Pages(options, plan.shapes, models)

    def line(self, scan, rank=0):
        """All that becomes known of a scan; what fails is a reason."""
        start = time.monotonic()
        rows, read, found, failure, advice = [], start, None, "", ""
        with warnings.catch_warnings(record=True) as heard:
            warnings.simplefilter("always", UserWarning)
            try:
                data = self.source.read(*scan)
                read = time.monotonic()
                poses = self.finder.find(data.scene, None, data.image, data.image_camera)
                found = time.monotonic()
                rows, advice = table.rows_of(poses, self.objects, self.calibrations), told.advice(poses)
                self.pages.write(scan[0], data, poses)
            except scripting.Failure as error:
                failure = str(error)
            except Exception as error:  # whatever is wrong with a scan, the others are not to wait for it
                failure = f"{type(error).__name__}: {error}"
        return self.told(scan, rank, read - start, (found or time.monotonic()) - read, failure, rows, heard, advice)

    def line_apart(self, scan, rank=0):
        """The same of a scan that may end the process which searches it."""
        start = time.monotonic()
        try:
            return apart(lambda: self.line(scan, rank))
        except Ended as how:
            return self.told(scan, rank, 0, time.monotonic() - start, f"it ended the process that searched it: {how}")

    @staticmethod
    def told(scan, rank, read, find, failure, rows=(), heard=(), advice=""):
        return {"scan": scan[0], "rows": list(rows), "failure": failure, "read_s": f"{read:.4f}", "find_s": f"{find:.4f}",
                "process": rank, "warning": "; ".join(dict.fromkeys(str(warning.message) for warning in heard)), "advice": advice}


def work(ranks, journal, search, plan):
    """Takes scan after scan until none is left; the first process tells how far all are."""
    total, failed = len(plan.todo), False
    shown = progress.Progress(len(plan.scans), plan.done()) if ranks.rank == 0 else None

    def show():
        if shown:
            taken, bad = ranks.state()
            shown.show(max(min(taken, total) - ranks.size + 1, 0), bad)
            return taken

    try:
        while ranks.serves and show() < total:
            time.sleep(SERVICE_PAUSE)
        while not ranks.serves and (place := ranks.take(failed)) < total:
            scan = plan.todo[place]
            journal.start(scan[0])
            line = (search.line_apart if place < plan.suspects else search.line)(scan, ranks.rank)
            journal.add(line)
            failed = line["failure"] != ""
            show()
    except scripting.Failure:
        ranks.add(total)  # nothing is left for the others
        raise
    finally:
        if shown:
            shown.end()


def finish(options, plan, journal):
    """Writes the result and says what is in it."""
    lines, _ = journal.lines()
    table.write(options.out, plan.names(), lines)
    if options.json:
        scripting.write_json(options.json, table.content_of(plan.names(), lines))
    journal.remove()
    lines = [lines[name] for name in plan.names()]
    if options.report:
        pages.write_index(options.report, lines)
    failed, poses = sum(line["failure"] != "" for line in lines), sum(len(line["rows"]) for line in lines)
    return f"{options.out}: {len(lines)} scans, {failed} failed, {poses} poses"


def run(options, ranks):
    """In every process; `ranks` are all of them."""
    start = time.monotonic()
    scripting.interruption.shows = False  # a run has a line of its own
    if ranks.size > 1 and not options.threads:
        options.threads = 1
    journal = Journal(options.out + ".run")
    try:
        plan = ranks.share(together(ranks, lambda: Plan(options, journal) if ranks.rank == 0 else None))
        if plan.todo:
            search = together(ranks, lambda: Search(options, plan))
            together(ranks, lambda: work(ranks, journal, search, plan))
    except scripting.Failure:
        journal.remove_unused()
        raise
    text = together(ranks, lambda: finish(options, plan, journal) if ranks.rank == 0 else None)
    if text:
        seconds = time.monotonic() - start
        rate = f", {len(plan.todo) / seconds:.2f} scans a second" if plan.todo else ""
        print(f"{text}; {seconds:.1f} s{rate}", flush=True)
