# SPDX-License-Identifier: BSD-3-Clause
"""Scans as they arrive in a folder: the poses of each stand beside it as soon as they are found."""
import os
import statistics
import tempfile
import time

from .. import finding, scripting
from . import parts, scans
from .apart import Copy, Ended, apart

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

    @classmethod
    def changed(cls, path, state):
        """Whether a file has changed since it was taken; it is taken again then."""
        try:
            return cls.state(os.stat(path)) != tuple(state)
        except FileNotFoundError:
            return True

    def skip(self, done):
        """Takes what is there and done(path)."""
        for entry in os.scandir(self.folder):
            if self.wanted(entry.name) and done(entry.path):
                self.taken[entry.name] = self.state(entry.stat())


class Watch:
    """Finds the parts in each scan that arrives, until Ctrl-C. A copy of this process searches them, so that a scan that
    crashes it ends no watch."""

    def __init__(self, options):
        self.options = options
        if not os.path.isdir(options.watch):
            raise scripting.Failure(f"cannot watch {options.watch}: no such folder")
        self.source = scans.Files(options)
        scripting.require_folder_of(os.path.join(options.watch, "poses"))
        with tempfile.TemporaryDirectory() as folder:
            models = apart(lambda: parts.trained(parts.parts_of(options), folder))
            self.finder = finding.Finder([scripting.read_model(path) for path in models], options)
        self.arrivals = Arrivals(options.watch, self.source.is_scan)
        self.latencies, self.failed = [], 0

    def result(self, path, extension=None):
        """scan.pcd has scan.poses.json beside it, or scan.poses.failed with the reason; where there is a scan.ply, too, it has
        scan.pcd.poses.json."""
        stem, kind = os.path.splitext(path)
        twins = any(other != kind.lower() and self.source.is_scan(stem + other) and os.path.exists(stem + other)
                    for other in (*scripting.CLOUDS, *scripting.DEPTH_IMAGES))
        return f"{path if twins else stem}.poses.{extension or self.options.form}"

    def is_done(self, path):
        """Whether there is a result that is not older than the scan."""
        results = filter(os.path.exists, (self.result(path), self.result(path, "failed")))
        return any(os.stat(result).st_mtime_ns >= os.stat(path).st_mtime_ns for result in results)

    def run(self):
        self.arrivals.skip(self.is_done)
        self.searcher = Copy(self.search)
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
        finally:
            self.searcher.close()

    def take(self, name, path, arrived):
        """A scan; says how long it was from its arrival until its poses were there."""
        answer = self.searched(name, path, self.arrivals.taken[name])
        if not answer:
            return
        words, clock = answer
        latency = time.time() - arrived
        self.latencies.append(latency)
        self.failed += not clock
        steps = "" if not clock else " (waited {:.2f}, read {:.2f}, found {:.2f})".format(
            clock[0] - arrived, clock[1] - clock[0], clock[2] - clock[1])
        print(f"{name}: {words}; {latency:.2f} s{steps}", flush=True)

    def searched(self, name, path, state):
        """What search() returns, of a scan that may end the process which searches it."""
        for _ in range(2):  # the first may have been ended by what an earlier scan has left
            try:
                return self.searcher(name, path, state)
            except Ended as how:
                self.searcher = Copy(self.search)
                reason = f"it ended the process that searched it: {how}"
        return self.write(path, state, None, reason) and (reason, None)

    def search(self, name, path, state):
        """Writes the poses in a scan, or why there are none. Returns this in words, and the times before and after it was
        read and searched; of a scan that has changed meanwhile, and comes again or has gone, nothing."""
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
        return self.write(path, state, poses, words, clock[-1] - clock[0]) and (words, None if poses is None else clock)

    def write(self, path, state, poses, words, seconds=0):
        """The poses, or why there are none; what an earlier scan of that name has left goes. False of a scan that has
        changed."""
        if self.arrivals.changed(path, state):
            return False
        failed = self.result(path, "failed")
        if poses is not None:
            scripting.write_poses(poses, self.result(path), FORMS[self.options.form], Time=seconds)
        else:
            with scripting.written(failed) as file:
                file.write(words + "\n")
        old = self.result(path) if poses is None else failed
        if os.path.exists(old):
            os.remove(old)
        return True

    def summary(self):
        text = f"{len(self.latencies)} scans, {self.failed} failed"
        if self.latencies:
            text += (f"; from arrival to poses {statistics.median(self.latencies):.2f} s, "
                     f"at most {max(self.latencies):.2f} s")
        return text
