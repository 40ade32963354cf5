# SPDX-License-Identifier: BSD-3-Clause
"""`ppfmeam batch` in one process: datasets, folders and lists, broken scans, a killed run, what cannot be read or
written."""
import contextlib
import fcntl
import glob
import io
import os
import re
import resource
import shutil
import signal
import subprocess
import time
from unittest import mock

from ppfmeam import scripting
from ppfmeam.batch import progress
from ppfmeam.batch.apart import Ended, apart
from batchtest import H, W, command, content, dataset, deadly, killed, survives
from meamtest import check, rows_of, write
from scripttest import refuses, script, works, write_pcd
from vtkmodules.util.numpy_support import vtk_to_numpy
import numpy

SCENES = 4
model, scan = dataset("bins", SCENES)
scripting.write_model(model, "plate.meam")
names = [f"{scene:06d}/000000" for scene in range(SCENES)]


def batch(*arguments):
    """Runs to the end, in a process that has loaded VTK already. Returns the output."""
    result = script("batch.py", *arguments)
    check(result.returncode == 0, f"{arguments}: {result.returncode}, {result.stderr}")
    return result.stdout


# A dataset: the poses of `detect`, in the order of the scenes; nothing else is left behind.
terminal = os.openpty()
text = subprocess.run(command("bins", "--model", "plate.meam", "--out", "poses.csv"), stdout=subprocess.PIPE, stderr=terminal[1],
                      text=True, check=True).stdout
check(text.startswith(f"poses.csv: {SCENES} scans, 0 failed, "), text)
poses = rows_of("poses.csv")
check(list(dict.fromkeys(row["scan"] for row in poses)) == names, "the scans in their order")
check(all(row["obj_id"] == "1" and not row["failure"] for row in poses), "rows of object 1")
check([int(row["rank"]) for row in poses if row["scan"] == names[0]] == list(range(1, 1 + sum(
    row["scan"] == names[0] for row in poses))), "ranks from 1")
place = "bins/test/000002"
works("detect.py", "--model", "plate.meam", "--depth", f"{place}/depth/000000.png", "--camera", "bins/camera.json",
      "--depth-scale", str(scripting.read_json(f"{place}/scene_camera.json")["0"]["depth_scale"]),
      "--image", f"{place}/gray/000000.png", "--out", "one.csv")
ours = [(row["probability"], row["R"], row["t"]) for row in poses if row["scan"] == names[2]]
check([(row["score"], row["R"], row["t"]) for row in rows_of("one.csv")] == ours, "the poses are not those of detect")
works("detect.py", "1", f"{place}/000000", "--out", "image.csv")
check([(row["score"], row["R"], row["t"]) for row in rows_of("image.csv")] == ours, "of an image and an object of the dataset other poses")
refuses("has no object 5: its objects are 1", "calibrate.py", "bins", "--model", "plate.meam", "--out", "x.meam", "--object", "5")
refuses("leave --camera and --image out", "detect.py", "1", f"{place}/000000", "--camera", "bins/camera.json")
of_scans = rows_of("poses.scans.csv")
check([row["scan"] for row in of_scans] == names and all(float(row["find_s"]) > 0 for row in of_scans), "the times")
check(not os.path.exists("poses.csv.run"), "what is done is left behind")

# How far it is, and how long it takes yet, of what this run has done; in a terminal the line is written over itself.
heard = io.StringIO()
with contextlib.redirect_stderr(heard), mock.patch.object(progress.time, "monotonic", side_effect=[0, 5, 30, 35, 60]):
    shown = progress.Progress(1000, 20)
    for done, failed in ((2, 0), (10, 2), (11, 2), (960, 3)):
        shown.show(done, failed)
    shown.end()
check(heard.getvalue() == "30 of 1000 scans, 2 failed, 0.33 a second, 48 min left\n980 of 1000 scans, 3 failed, 16.00 a second, "
      "1 s left\n", heard.getvalue())
lines = os.read(terminal[0], 100000).decode().split("\r\x1b[K")[1:]
check(lines and all(re.fullmatch(rf"[1-{SCENES}] of {SCENES} scans, 0 failed, \d+\.\d\d a second, \d+ s left(\r\n)?", line)
                    for line in lines) and lines[-1].endswith("\r\n"), f"{lines}")

# The dataset's own objects, which are trained, and any number of threads.
batch("bins", "--threads", "1", "--out", "own.csv", "--json", "own.json")
check(content("own.csv") == content("poses.csv"), "another table with one thread and the dataset's own object")
told = scripting.read_json("own.json")["scans"]
check([each["scan"] for each in told] == names and [(each["scan"], pose["t"]) for each in told for pose in each["poses"]] ==
      [(row["scan"], list(map(float, row["t"].split()))) for row in poses], "the same poses as JSON")

# A killed run is taken up; with other options it is not.
killed("killed.csv", lambda process: process, *command("bins", "--model", "plate.meam", "--out", "killed.csv"))
result = script("batch.py", "bins", "--model", "plate.meam", "--poses", "1", "--out", "killed.csv")
check(result.returncode == 1 and "had other parts, scans or options" in result.stderr, result.stderr)
name = next(name for name in sorted(os.listdir("killed.csv.run")) if name.endswith(".jsonl"))
with open(f"killed.csv.run/{name}", "a", encoding="utf-8") as file:
    file.write('{"scan": "000004/000000", "rows": [[1, 1, "0.')  # what a process leaves that is killed as it writes
batch("bins", "--model", "plate.meam", "--out", "killed.csv")
check(content("killed.csv") == content("poses.csv"), "another table after a kill")

# A scan that ends the process, as a crash in a library does, is a row when the run is taken up; the others are as they were.
survives("deadly.csv", *deadly("bins", "--model", "plate.meam", "--threads", "2", "--out", "deadly.csv"))
check([row for row in rows_of("deadly.csv") if not row["failure"]] == [row for row in poses if row["scan"] != names[2]],
      "the others are not as they were")
check([row["scan"] for row in rows_of("deadly.scans.csv")] == names, "the scans in their order")
for number, word in ((signal.SIGKILL, "SIGKILL"), (signal.SIGRTMIN + 6, f"signal {signal.SIGRTMIN + 6}")):
    try:
        apart(lambda: os.kill(os.getpid(), number))
        raise AssertionError(f"{word} has ended nothing")
    except Ended as how:
        check(str(how) == word, f"{how} instead of {word}")


# A scan without an end: a run is killed in it, and again when a copy of its process searches it. The copy ends, too.
def killed_in_scan():
    """The numbers of the run's process and of the one that searched."""
    arguments = ("bins", "--model", "plate.meam", "--threads", "1", "--out", "endless.csv")
    process = subprocess.Popen(deadly(*arguments, what="open(f'in.{os.getpid()}', 'w').close(), time.sleep(60)"),
                               stderr=subprocess.DEVNULL)
    while not (found := glob.glob("in.*")):
        check(process.poll() is None, f"the run has ended: {process.returncode}")
        time.sleep(0.01)
    os.remove(found[0])
    process.kill()
    process.wait()
    return process.pid, int(found[0][3:])


def is_free(path):
    with open(path, encoding="utf-8") as file, contextlib.suppress(BlockingIOError):
        fcntl.flock(file, fcntl.LOCK_EX | fcntl.LOCK_NB)
        return True


process, searcher = killed_in_scan()
check(process == searcher, "a copy searches what no run was killed in")
process, searcher = killed_in_scan()
check(process != searcher, "what a run was killed in is searched by no copy")
end = time.monotonic() + 5
while not is_free("endless.csv.run/lock"):
    check(time.monotonic() < end, "a copy of a process that was killed holds the lock")
    time.sleep(0.01)
batch("bins", "--model", "plate.meam", "--out", "endless.csv")
check(content("endless.csv") == content("poses.csv"), "another table after a scan without an end")

# A scan that cannot be read, and a scene, is a row with its reason.
with open(f"bins/test/{names[1][:6]}/depth/000000.png", "r+b") as file:
    file.truncate(1000)
write(f"bins/test/{names[3][:6]}/scene_camera.json", "{")
text = batch("bins", "--model", "plate.meam", "--out", "broken.csv")
check(", 2 failed, " in text, text)
broken = {row["scan"]: row["failure"] for row in rows_of("broken.csv") if row["failure"]}
check(list(broken) == [names[1], "000003"] and "000000.png" in broken[names[1]] and "JSON" in broken["000003"],
      f"{broken}")
check([row for row in rows_of("broken.csv") if not row["failure"]]
      == [row for row in poses if row["scan"] not in (names[1], names[3])], "the others are not as they were")

# A folder and a list, with images beside; a scan without any copy of the part has an empty row.
os.makedirs("folder")
points = vtk_to_numpy(scan.GetPoints().GetData())
grey = vtk_to_numpy(scan.GetPointData().GetArray("Intensity")).astype(numpy.float32)
write_pcd("folder/b.pcd", numpy.column_stack((points, grey)), W, H, "x y z intensity")
shutil.copy("folder/b.pcd", "folder/a.pcd")
shutil.copy(f"bins/test/{names[-1][:6]}/gray/000000.png", "folder/image.png")
flat = numpy.column_stack((points[:, :2], numpy.full(W * H, 700.0)))
flat[numpy.isnan(points).any(axis=1)] = numpy.nan
write_pcd("folder/c.pcd", numpy.column_stack((flat, 0 * grey)), W, H, "x y z intensity")
batch("folder", "--model", "plate.meam", "--probability", "0.3", "--out", "folder.csv")
found = {}
for row in rows_of("folder.csv"):
    found.setdefault(row["scan"], []).append(row["R"] + row["t"])
check(list(found) == ["a.pcd", "b.pcd", "c.pcd"], f"the folder's scans by name: {list(found)}")
check(found["a.pcd"] == found["b.pcd"] != [""] and found["c.pcd"] == [""], f"{found}")
write_pcd("bare.pcd", points, W, H, "x y z")
write("list.txt", "# scan and image\nbare.pcd\tfolder/image.png\nnone.pcd\nfolder/a.pcd\n")
batch("list.txt", "--model", "plate.meam", "--probability", "0.3", "--out", "list.csv")
found = {row["scan"]: row for row in rows_of("list.csv")}
check(list(found) == ["bare.pcd", "none.pcd", "folder/a.pcd"], f"the list's scans in its order: {list(found)}")
check(found["none.pcd"]["failure"].startswith("cannot read none.pcd"), f"{found}")
check(found["bare.pcd"]["R"] and found["folder/a.pcd"]["R"], f"{found}")

write("marked.txt", "\ufeffbare.pcd\n")
check("1 scans, 0 failed" in batch("marked.txt", "--model", "plate.meam", "--out", "marked.csv"), "a list with a byte order mark")

# A name that is no UTF-8 costs nothing; a .csv, which may be no scan, is named.
os.makedirs("odd")
for name in (b"odd/b\xe4d.pcd", b"odd/c.csv", b"odd/d.txt"):
    shutil.copy("folder/a.pcd", name)
told = batch("odd", "--model", "plate.meam", "--probability", "0.3", "--out", "odd/odd.csv", "--json", "odd.json", "--report", "odd_pages")
check("odd: c.csv and 1 more are not taken for scans; a list" in told and "1 scans, 0 failed" in told, told)
check({(row["scan"], row["failure"]) for row in rows_of("odd/odd.csv")} == {("b\\udce4d.pcd", "")}, f"{rows_of('odd/odd.csv')}")
check(len(os.listdir("odd_pages")) == 2 and scripting.read_json("odd.json")["scans"][0]["poses"], "its page")

# Two parts: no two poses explain the same surface.
write("one.txt", "bare.pcd\n")
batch("one.txt", "--model", "plate.meam", "--model", "plate.meam", "--out", "two.csv")
check({row["obj_id"] for row in rows_of("two.csv")} <= {"1", "2", ""}, "the numbers of two parts")

# What cannot be read or written is a sentence, and nothing is left behind.
os.makedirs("empty")
write("cut.meam", content("plate.meam")[:5000])
write("old.meam", content("plate.meam")[:8] + b"\x63\0\0\0" + content("plate.meam")[12:])
write("twice.txt", "bare.pcd\nbare.pcd\n")
for word, name in (("has no scans", "empty"), ("cannot read none", "none"), ("twice", "twice.txt"),
                   ("not a list", "plate.meam")):
    refuses(word, "batch.py", name, "--model", "plate.meam", "--out", "x.csv")
refuses("give the parts", "batch.py", "folder", "--out", "x.csv")
for option in (("--camera", "bins/camera.json"), ("--scene-scale", "10"), ("--image-camera", "bins/camera.json")):
    refuses(f"leave {option[0]} out", "batch.py", "bins", "--model", "plate.meam", "--out", "x.csv", *option)
refuses("no such folder", "batch.py", "bins", "--model", "plate.meam", "--out", "none/x.csv")
for word, name in (("cut off", "cut.meam"), ("version 99", "old.meam")):
    refuses(word, "batch.py", "bins", "--model", name, "--out", "x.csv")


# A full disk: it takes no file beyond so many bytes. What is done stays, and the run goes on when there is room.
def small():
    resource.setrlimit(resource.RLIMIT_FSIZE, (1500, resource.RLIM_INFINITY))


FULL = ("folder", "--model", "plate.meam", "--probability", "0.3", "--out", "full.csv")
result = subprocess.run(command(*FULL), preexec_fn=small, capture_output=True, text=True)
check(result.returncode == 1 and result.stderr.startswith("batch.py: cannot write full.csv.run: "), result.stderr)
check(not [name for name in os.listdir() if name.startswith("full") and name != "full.csv.run"], f"{os.listdir()}")
batch(*FULL)
check(content("full.csv") == content("folder.csv"), "another table after a full disk")
