# SPDX-License-Identifier: BSD-3-Clause
"""Scans as they arrive in a folder: the poses of each stand beside it as soon as they are found."""
import os
import statistics
import time

from .. import finding, scripting
from . import parts, scans

PAUSE = 0.02  # seconds between two looks at the folder, or longer:
SHARE = 0.2   # of the time may go into looking, which takes long in a folder with many files
QUIET = 0.25  # seconds after which a file that nothing is written to is whole
FORMS = {"json": "JSON", "csv": "BOPCSV"}


class Arrivals:
    """The files of a folder that are whole and new, or that have changed since they were taken."""

    def __init__(self, folder, wanted):
        self.folder, self.wanted = folder, wanted
        self.taken, self.seen = {}, {}  # by name the state, and when it was first seen so

    @staticmethod
    def state(info):
        return info.st_ino, info.st_size, info.st_mtime_ns, info.st_ctime_ns

    def look(self):
        """Name, path and time of arrival (as time.time() has it) of each, those that came first before the others."""
        now, found = time.monotonic(), []
        for entry in os.scandir(self.folder):
            if not self.wanted(entry.name):
                continue
            try:
                info = entry.stat()
            except FileNotFoundError:  # it has gone
                continue
            state = self.state(info)
            if self.taken.get(entry.name) == state:
                continue
            if self.seen.get(entry.name, (None,))[0] != state:
                self.seen[entry.name] = state, now
            if self.whole(info, now - self.seen[entry.name][1]):
                found.append((info.st_ctime, entry.name, entry.path, state))
        for _, name, _, state in found:
            self.taken[name] = state
            del self.seen[name]
        return [(name, path, arrived) for arrived, name, path, _ in sorted(found)]

    @staticmethod
    def whole(info, unchanged):
        """Renaming changes the time of the entry alone, writing that of the content, too."""
        renamed = info.st_ctime_ns > info.st_mtime_ns and info.st_size > 0
        return renamed or unchanged >= QUIET or time.time() - info.st_ctime >= QUIET

    def changed(self, name, path):
        """Whether a file has changed since it was taken; it is taken again then."""
        try:
            return self.state(os.stat(path)) != self.taken[name]
        except FileNotFoundError:
            return True

    def skip(self, done):
        """Takes what is there and done(path)."""
        for entry in os.scandir(self.folder):
            if self.wanted(entry.name) and done(entry.path):
                self.taken[entry.name] = self.state(entry.stat())


class Watch:
    """Finds the parts in each scan that arrives, until Ctrl-C."""

    def __init__(self, options):
        self.options = options
        if not os.path.isdir(options.watch):
            raise scripting.Failure(f"cannot watch {options.watch}: no such folder")
        self.source = scans.Files(options)
        scripting.require_folder_of(os.path.join(options.watch, "poses"))
        wanted = parts.parts_of(options)
        models = [part.train() if part.train else scripting.read_model(part.files[0]) for part in wanted]
        self.finder = finding.Finder(models, options)
        self.arrivals = Arrivals(options.watch, self.source.is_scan)
        self.latencies, self.failed = [], 0

    def result(self, path, extension=None):
        """scan.pcd has scan.poses.json beside it, or scan.poses.failed with the reason."""
        return f"{os.path.splitext(path)[0]}.poses.{extension or self.options.form}"

    def is_done(self, path):
        """Whether there is a result that is not older than the scan."""
        results = filter(os.path.exists, (self.result(path), self.result(path, "failed")))
        return any(os.stat(result).st_mtime_ns >= os.stat(path).st_mtime_ns for result in results)

    def run(self):
        self.arrivals.skip(self.is_done)
        begin = time.time()
        print(f"watching {self.options.watch}; Ctrl-C ends it", flush=True)
        try:
            while True:
                start = time.monotonic()
                arrived = self.arrivals.look()
                for name, path, when in arrived:
                    self.take(name, path, max(when, begin))
                if not arrived:
                    time.sleep(max(PAUSE, (time.monotonic() - start) / SHARE))
        except KeyboardInterrupt:
            print(self.summary(), flush=True)

    def take(self, name, path, arrived):
        """A scan; says how long it was from its arrival until its poses were there."""
        clock = [time.time()]
        try:
            scan = self.source.read(name, path, "")
            clock.append(time.time())
            poses = self.finder.find(scan.scene, None, scan.image, scan.image_camera)
            clock.append(time.time())
            words = f"{poses.GetNumberOfPoints()} poses"
        except scripting.Failure as failure:
            poses, words = None, str(failure)
        except Exception as error:  # whatever is wrong with a scan, the next one is not to wait for it
            poses, words = None, f"{type(error).__name__}: {error}"
        if self.arrivals.changed(name, path):  # while it was read: it comes again, or has gone
            return
        self.write(path, poses, words, clock[-1] - clock[0])
        latency = time.time() - arrived
        self.latencies.append(latency)
        self.failed += poses is None
        steps = "" if poses is None else " (waited {:.2f}, read {:.2f}, found {:.2f})".format(
            clock[0] - arrived, clock[1] - clock[0], clock[2] - clock[1])
        print(f"{name}: {words}; {latency:.2f} s{steps}", flush=True)

    def write(self, path, poses, words, seconds):
        """The poses, or why there are none; what an earlier scan of that name has left goes."""
        failed = self.result(path, "failed")
        if poses is not None:
            scripting.write_poses(poses, self.result(path), FORMS[self.options.form], Time=seconds)
        else:
            with scripting.written(failed) as file:
                file.write(words + "\n")
        old = self.result(path) if poses is None else failed
        if os.path.exists(old):
            os.remove(old)

    def summary(self):
        text = f"{len(self.latencies)} scans, {self.failed} failed"
        if self.latencies:
            text += (f"; from arrival to poses {statistics.median(self.latencies):.2f} s, "
                     f"at most {max(self.latencies):.2f} s")
        return text
