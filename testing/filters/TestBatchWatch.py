# SPDX-License-Identifier: BSD-3-Clause
"""`ppfmeam batch --watch`: scans that are renamed into the folder, grow in it, are damaged or replaced, or crash the
process that searches them; Ctrl-C."""
import json
import os
import shutil
import signal
import subprocess
import time

import numpy
from vtkmodules.util.numpy_support import vtk_to_numpy

from batchtest import children, command, dataset, deadly
from meamtest import check, read, rows_of, write
from ppfmeam import scripting
from scripttest import refuses, script, works

W, H = 160, 120
model, scan = dataset("bins", 1, W, H)
scripting.write_model(model, "plate.meam")
os.makedirs("cell")
os.makedirs("scans")
points = vtk_to_numpy(scan.GetPoints().GetData())
grey = vtk_to_numpy(scan.GetPointData().GetArray("Intensity")).astype(numpy.float32)
HEAD = (f"VERSION .7\nFIELDS x y z intensity\nSIZE 4 4 4 4\nTYPE F F F F\nCOUNT 1 1 1 1\nWIDTH {W}\nHEIGHT {H}\n"
        f"POINTS {W * H}\nDATA binary\n")
whole = HEAD.encode() + numpy.ascontiguousarray(numpy.column_stack((points, grey)), dtype="<f4").tobytes()
write("scans/one.pcd", whole)
works("batch.py", "scans", "--model", "plate.meam", "--out", "poses.csv")
expected = [[float(word) for word in row["t"].split()] for row in rows_of("poses.csv")]
check(len(expected) > 1, "no poses to compare with")


def start(*options, command=command, **how):
    return subprocess.Popen(command("--watch", "cell", "--model", "plate.meam", *options, **how),
                            stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)


def arrives(name):
    """A scan, whole at once."""
    shutil.copy("scans/one.pcd", "cell/arriving.part")
    os.rename("cell/arriving.part", f"cell/{name}.pcd")


def line(process, *words):
    """The next line it prints, which has all the words."""
    text = process.stdout.readline()
    check(text and all(word in text for word in words), f"expected {words}: {text or process.stderr.read()}")


def end(process, *words):
    process.send_signal(signal.SIGINT)
    output, errors = process.communicate(timeout=30)
    check(process.returncode == 0 and not errors, f"{process.returncode}, {errors}")
    check(output.count("\n") == 1 and all(word in output for word in words), f"expected {words}: {output}")


def right(name):
    poses = json.loads(read(f"cell/{name}.poses.json"))["poses"]
    check([pose["translation"] for pose in poses] == expected, f"{name}: {poses}")


process = start()
line(process, "watching cell")
arrives("a")
line(process, f"a.pcd: {len(expected)} poses; ", " s (waited ", "read ", "found ")
right("a")

# One that grows gets its poses when it is whole, also where a busy machine made a pause so long that it was taken
# before.
with open("cell/b.pcd", "wb") as file:
    for part in range(4):
        file.write(whole[part * len(whole) // 4:(part + 1) * len(whole) // 4])
        file.flush()
        time.sleep(0.1)
early = 0
while "poses;" not in (text := process.stdout.readline()):
    check(text.startswith("b.pcd: "), text)
    early += 1
right("b")

# A damaged one has a reason beside it, until it is replaced.
write("cell/c.part", whole[:9000])
os.rename("cell/c.part", "cell/c.pcd")
line(process, "c.pcd: ", "c.pcd", " s\n")
check("c.pcd" in read("cell/c.poses.failed") and not os.path.exists("cell/c.poses.json"), "the reason")
arrives("c")
line(process, f"c.pcd: {len(expected)} poses; ")
right("c")
check(not os.path.exists("cell/c.poses.failed"), "the reason stays")
end(process, f"{4 + early} scans, {1 + early} failed; from arrival to poses ")
check(sorted(os.listdir("cell")) == [f"{name}.{kind}" for name in "abc" for kind in ("pcd", "poses.json")],
      f"{sorted(os.listdir('cell'))}")

# What has its poses already is left alone; CSV is another result.
os.rename("cell/b.poses.json", "b.json")
process = start()
line(process, "watching cell")
line(process, f"b.pcd: {len(expected)} poses; ")
right("b")
end(process, "1 scans, 0 failed")
process = start("--form", "csv")
line(process, "watching cell")
for name in "abc":
    line(process, f"{name}.pcd: {len(expected)} poses")
    check([[float(word) for word in row["t"].split()] for row in rows_of(f"cell/{name}.poses.csv")] == expected, "CSV")
end(process, "3 scans, 0 failed")

# A scan of the same name and another kind has a result of its own.
process = start()
line(process, "watching cell")
before = read("cell/a.poses.json")
write("cell/a.part", "1 2")
os.rename("cell/a.part", "cell/a.ply")
line(process, "a.ply: ")
end(process, "1 scans, 1 failed")
check(read("cell/a.ply.poses.failed") and read("cell/a.poses.json") == before, f"{sorted(os.listdir('cell'))}")

# A scan that crashes the process which searches it has the reason beside it, and the next one its poses; so has one that
# crashes it once, or during which it is killed.
shutil.rmtree("cell")
os.makedirs("cell")
process = start(command=deadly)
line(process, "watching cell")
for name, words in (("a", "poses; "), ("deadly", "it ended the process that searched it: SIGSEGV; "), ("b", "poses; ")):
    arrives(name)
    line(process, f"{name}.pcd: ", words)
check(read("cell/deadly.poses.failed") == "it ended the process that searched it: SIGSEGV\n", "the reason")
os.kill(*children(process.pid), signal.SIGKILL)
arrives("c")
line(process, f"c.pcd: {len(expected)} poses; ")
for name in "abc":
    right(name)
end(process, "4 scans, 1 failed")
os.remove("cell/deadly.poses.failed")
process = start(command=deadly, what="os.path.exists('crashed') or (open('crashed', 'w').close(), os.abort())")
line(process, "watching cell")
line(process, f"deadly.pcd: {len(expected)} poses; ")
end(process, "1 scans, 0 failed")

# Ctrl-C ends one without an end, and the process that searches it.
os.remove("cell/deadly.poses.json")
process = start(command=deadly, what="open('endless', 'w').close(), time.sleep(60)")
line(process, "watching cell")
while not os.path.exists("endless"):
    check(process.poll() is None, "the watch has ended")
    time.sleep(0.01)
searcher, = children(process.pid)
process.send_signal(signal.SIGINT)
output, errors = process.communicate(timeout=10)
check(process.returncode == 0 and not errors and output == "0 scans, 0 failed\n", f"{process.returncode}: {output}{errors}")
check(not os.path.exists(f"/proc/{searcher}"), "the process that searches is left")

# What cannot be watched.
refuses("cannot watch none: no such folder", "batch.py", "--watch", "none", "--model", "plate.meam")
for arguments in (("scans", "--watch", "cell", "--model", "plate.meam"), ("--watch", "cell"),
                  ("scans", "--model", "plate.meam")):
    result = script("batch.py", *arguments)
    check(result.returncode == 2 and "give " in result.stderr, f"{arguments}: {result.stderr}")
