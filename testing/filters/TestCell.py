# SPDX-License-Identifier: BSD-3-Clause
"""cell.py empties a small bin of a user's part: a row for each pick, a film and a strip of pictures that belong together; a run that is
done, or was stopped, is gone on with and ends with the same rows; and the paper's Table 9 is made of such rows."""
import json
import os
import re
import signal
import subprocess
import sys
import tempfile

from vtkmodules.vtkIOImage import vtkPNGReader
from vtkmodules.vtkIOXML import vtkXMLPolyDataReader

from ppfmeam import cell as cells_of_users
from meamtest import check, connect, read, rows_of, run, skip, write
import cells

if not os.environ.get("DISPLAY"):
    skip("no display")
EXAMPLES = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", "examples")
PART = os.path.join(EXAMPLES, "parts", "ridged_disc.stl")
COPIES = 2
folder = tempfile.TemporaryDirectory()
os.chdir(folder.name)


def command(*arguments):
    copies = () if "--copies" in arguments else ("--copies", str(COPIES))
    return [sys.executable, os.path.join(EXAMPLES, "cell.py"), "--cad", PART, "--cup", "8", *copies, *arguments]


def cell(*arguments):
    return subprocess.run(command(*arguments), capture_output=True, text=True)


done = cell("--out", "out", "--json", "out.json")
check(done.returncode == 0, done.stderr)
rows = rows_of("out/picks.csv")
tried = [row for row in rows if row["outcome"]]
taken = sum(row["outcome"] == "success" for row in tried)
check(taken == COPIES, f"discs that lie apart come out: {done.stderr}")
left = COPIES
told = json.loads(read("out.json"))
check(told["parts_taken"] == taken and [pick["reason"] for pick in told["picks"]] == [row["reason"] for row in rows], f"{told}")
for number, row in enumerate(rows, 1):
    check(int(row["pick"]) == number and int(row["left"]) == left, f"pick {number} of {rows}")
    left -= row["outcome"] == "success"
check(f"{int(left == 0)} of 1 bins were emptied; {taken} of {len(tried)} picks took a part; {left} parts were left" in done.stdout, done.stdout)
check(done.stdout.count("\n") == len(rows) + 2 and rows[-1]["reason"] in done.stdout, done.stdout)
check(re.search(rf"bin 1: 1 of {COPIES} left, pick 2: .*; \S+ \S+ left", done.stderr), done.stderr)

name, = (entry.removesuffix(".pvd") for entry in os.listdir("out") if entry.endswith(".pvd"))
steps = re.findall(r'timestep="(\d+)".*name="(\w+)" file="(.*)"', read(f"out/{name}.pvd"))
check(len(steps) == 2 * len(tried), f"{steps}")
reader = vtkXMLPolyDataReader()
sizes = []
for step, kind, path in steps:
    reader.SetFileName(os.path.join("out", path))
    sizes.append(run(reader).GetNumberOfPoints())
    check(sizes[-1] > 0, f"step {step} has {kind}")
check(sizes[0] % COPIES == 0 and sizes[2] == sizes[0] // COPIES * int(rows[1]["left"]), "the film has as many parts as are left")
picture = connect(vtkPNGReader(), FileName=f"out/{name}.png")
check(run(picture).GetDimensions() == (420 * len(tried), 420, 1), "a tile for each pick")

whole = read("out/picks.csv")
again = cell("--out", "out")
check(again.returncode == 0 and again.stderr == "" and again.stdout == done.stdout, f"nothing is left to do: {again.stderr}")
check(read("out/picks.csv") == whole, "and nothing is changed")


def without_times(path):
    return [{name: value for name, value in row.items() if not name.endswith("_ms")} for row in rows_of(path)]


# Ctrl-C after the first pick tells what is known; a bin that was interrupted starts anew and is the same.
process = subprocess.Popen(command("--out", "stopped"), stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
check("pick 1" in process.stderr.readline(), "the first pick")
process.send_signal(signal.SIGINT)
told, errors = process.communicate()
check(process.returncode == 130 and errors.endswith("cell.py: stopped\n"), f"{process.returncode}: {errors}")
check(told.splitlines()[1].split()[:3] == ["1", "1", str(COPIES)] and "no bin is done; " in told, told)
check(without_times("stopped/picks.csv") == without_times("out/picks.csv")[:told.count("\n") - 2], "the picks that were made")
check(cell("--out", "stopped").returncode == 0 and without_times("stopped/picks.csv") == without_times("out/picks.csv"), "the same picks")

# A bin of another size is another one, and as large as it has to be; a gripper of other lengths, too.
other = cell("--bin", "300", "200", "60", "--gripper", "cup_length=70", "--out", "out")
check(other.returncode == 0 and len(rows_of("out/picks.csv")) > len(rows), other.stderr)
row = rows_of("out/picks.csv")[-1]
check(row["bin"] == "300x200x60" and row["gripper"] == "cup-cup_diameter=8-cup_length=70", f"{row}")
source = cells_of_users.Bin(type("Station", (), {"mesh": None, "sensor": "structured-light"}), 1, 1, (300, 200, 60))
check(source.truth.GetFieldData().GetArray("Bin").GetTuple(0)[16:19] == (300, 200, 60), "the size of the bin")

# Table 9 counts picks, failures and what is left.
BIN = dict(part="disc", sensor="eye", gripper="cup", bin="0", copies="2", detect_ms="100", plan_ms="10", mm="1.00", degrees="2.0", reason="why")
picks = [{**BIN, "seed": seed, "pick": pick, "left": left, "outcome": outcome} for seed, pick, left, outcome in (
    ("1", "1", "2", "success"), ("1", "2", "1", "success"), ("2", "1", "2", "holds nothing"), ("2", "2", "2", "success"), ("2", "3", "1", ""))]
check(cells_of_users.summary(picks) == (2, 1, 4, 3, 1), "two bins, one empty, three of four picks, one part left")
line = cells.figures(picks)[1]
check((line["trials"], line["failure"], line["success rate"], line["left in the bins"], line["detection ms"]) == (4, 1, 75.0, 1, 100), f"{line}")
check(cells.failures(picks) == ["- disc, eye, bin 2, trial 1: holds nothing (why; the pose is 1.00 mm and 2.0 degrees off)",
                                "- disc, eye, bin 2, trial 3: 1 left: why"], f"{cells.failures(picks)}")

os.mkdir("old")
write("old/picks.csv", whole.replace(",copies", ""))
old = cell("--out", "old")
check(old.returncode != 0 and "is not of this version" in old.stderr, f"columns of another version: {old.stderr}")
for word, arguments in (("1 or more", ("--bins", "0")), ("10000", ("--copies", "10001")), ("cannot write", ("--out", "/proc/no")),
                        ("above 0", ("--bin", "0", "1", "1")), ("no length claw", ("--gripper", "claw=3")), ("NAME=MM", ("--gripper", "claw")),
                        ("no grasp", ("--gripper", "cup_diameter=500"))):
    wrong = cell(*(() if "--out" in arguments else ("--out", "wrong")), *arguments)
    check(wrong.returncode != 0 and word in wrong.stderr, f"{arguments}: {wrong.stderr}")
