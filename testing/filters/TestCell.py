# SPDX-License-Identifier: BSD-3-Clause
"""cell.py empties a small bin: a row for each trial, the table, a film and a strip of pictures that belong together; a run
that is done, or was torn, is gone on with and ends with the same files."""
import csv
import os
import re
import subprocess
import sys
import tempfile

from vtkmodules.vtkIOImage import vtkPNGReader
from vtkmodules.vtkIOXML import vtkXMLPolyDataReader

from meamtest import check, run, skip

if not os.environ.get("DISPLAY"):
    skip("no display")
EXAMPLES = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", "examples")
NAME = "ridged_disc_structured-light_cup_3_1"
folder = tempfile.TemporaryDirectory()
os.chdir(folder.name)


def cell(*arguments):
    return subprocess.run([sys.executable, os.path.join(EXAMPLES, "cell.py"), "--gripper", "cup", "--copies", "3", "--bins", "1",
                           *arguments], capture_output=True, text=True)


def content(path):
    with open(path, encoding="utf-8") as file:
        return file.read()


done = cell("--pictures", "--out", "out")
check(done.returncode == 0, done.stderr)
rows = list(csv.DictReader(content("out/cell.csv").splitlines()))
tried = [row for row in rows if row["outcome"]]
taken = sum(row["outcome"] == "success" for row in tried)
check(taken >= 2, f"of three discs that lie apart at least two come out: {done.stderr}")
left = 3
for number, row in enumerate(rows, 1):
    check(int(row["trial"]) == number and int(row["left"]) == left, f"trial {number} of {rows}")
    left -= row["outcome"] == "success"
table = content("out/table9.md")
check(f"| ridged_disc | structured-light | cup | 1 | {len(tried)} | {taken} | {len(tried) - taken} |" in table, table)
check(table.strip() == done.stdout.strip(), "what is printed is what is written")

steps = re.findall(r'timestep="(\d+)".*name="(\w+)" file="(.*)"', content(f"out/{NAME}.pvd"))
check(len(steps) == 2 * len(tried), f"{steps}")
reader = vtkXMLPolyDataReader()
sizes = []
for step, kind, path in steps:
    reader.SetFileName(os.path.join("out", path))
    sizes.append(run(reader).GetNumberOfPoints())
    check(sizes[-1] > 0, f"step {step} has {kind}")
check(sizes[0] % 3 == 0 and sizes[2] == sizes[0] // 3 * int(rows[1]["left"]), "the film has as many parts as are left")
picture = vtkPNGReader()
picture.SetFileName(f"out/{NAME}.png")
check(run(picture).GetDimensions() == (420 * len(tried), 420, 1), "a tile for each trial")

whole = content("out/cell.csv")
again = cell("--out", "out")
check(again.returncode == 0 and again.stderr == "" and again.stdout == done.stdout, f"nothing is left to do: {again.stderr}")
check(content("out/cell.csv") == whole, "and nothing is changed")
bins = content("out/bins.csv")
with open("out/bins.csv", "w", encoding="utf-8") as file:
    file.write(bins[:-3])  # as if the run had been killed while it noted that the bin is done
torn = cell("--out", "out")
check(torn.returncode == 0, torn.stderr)


def without_times(text):
    return [{name: value for name, value in row.items() if not name.endswith("_ms")} for row in csv.DictReader(text.splitlines())]


check(without_times(content("out/cell.csv")) == without_times(whole), "a bin that was interrupted starts anew and is the same")

os.mkdir("old")
with open("old/bins.csv", "w", encoding="utf-8") as file:
    file.write(bins.replace(",copies", ""))
old = cell("--out", "old")
check(old.returncode != 0 and "is not of this version" in old.stderr, f"columns of another version: {old.stderr}")
for word, arguments in (("1 or more", ("--bins", "0")), ("10000", ("--copies", "10001")), ("cannot write", ("--out", "/proc/no"))):
    wrong = cell("--out", "wrong", *arguments)
    check(wrong.returncode != 0 and word in wrong.stderr and not os.path.exists("wrong"), f"{arguments}: {wrong.stderr}")
