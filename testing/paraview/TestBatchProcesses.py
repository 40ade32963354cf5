# SPDX-License-Identifier: BSD-3-Clause
"""`ppfmeam batch` by two processes: the table of one, also after one of them or all were killed, and one sentence for
what goes wrong. Arguments: mpirun and pvbatch."""
import os
import subprocess
import sys
import tempfile

sys.path.append(os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "filters"))

from batchtest import BATCH, children, command, content, dataset, deadly, finished, killed, survives  # noqa: E402
from meamtest import check, rows_of, skip  # noqa: E402
from ppfmeam import scripting  # noqa: E402

try:
    import mpi4py  # noqa: F401
except ImportError:
    skip("there is no mpi4py")

SCENES = 4
MPIRUN, PVBATCH = sys.argv[1:]
TWO = (MPIRUN, "--allow-run-as-root", "--oversubscribe", "-n", "2")
folder = tempfile.TemporaryDirectory()
os.chdir(folder.name)
os.environ["HOME"] = folder.name
model, _ = dataset("bins", SCENES)
scripting.write_model(model, "plate.meam")
with open("bins/test/000003/depth/000000.png", "r+b") as file:
    file.truncate(1000)


def run(out):
    return "bins", "--model", "plate.meam", "--out", out


def pvbatch(out):
    return (*TWO, PVBATCH, "--symmetric", BATCH, *run(out))


def python(out):
    return (*TWO, *command(*run(out)))


text = finished(*command(*run("one.csv")))
check(text.startswith(f"one.csv: {SCENES} scans, 1 failed, "), text)
for start, name in ((pvbatch, "paraview.csv"), (python, "python.csv")):
    text = finished(*start(name))
    check(text.startswith(f"{name}: {SCENES} scans, 1 failed, ") and text.count("\n") == 1, text)
    check(content(name) == content("one.csv"), f"{name} is not the table of one process")
    check({row["process"] for row in rows_of(name.replace(".csv", ".scans.csv"))} == {"0", "1"}, "both processes work")

# Parts are trained once.
finished(*TWO, PVBATCH, "--symmetric", BATCH, "bins", "--cad", "bins/models/obj_000001.ply", "--out", "cad.csv")
check(len(rows_of("cad.csv")) == len(rows_of("one.csv")), "a part from its CAD file")

# kill -9 of one process, and of the one that has started them; then alone.
killed("killed.csv", lambda process: children(process)[1], *pvbatch("killed.csv"))
finished(*pvbatch("killed.csv"))
check(content("killed.csv") == content("one.csv"), "another table after a kill of one process")
killed("all.csv", lambda process: process, *python("all.csv"))
finished(*command(*run("all.csv")))
check(content("all.csv") == content("one.csv"), "another table after a kill of all")

# A scan that ends its process: the same row, and table, as of one process.
for out, start in (("deadly1.csv", ()), ("deadly2.csv", TWO)):
    survives(out, *start, *deadly(*run(out)))
check(content("deadly1.csv") == content("deadly2.csv"), "another table after a crash")

# One sentence, by the first process.
result = subprocess.run(pvbatch("none/x.csv"), capture_output=True, text=True)
lines = [line for line in result.stderr.splitlines() if line.startswith("batch.py: ")]
check(result.returncode != 0 and lines == ["batch.py: cannot write none/x.csv: no such folder"], result.stderr)
with open("cut.meam", "wb") as file:
    file.write(content("plate.meam")[:5000])
result = subprocess.run((*TWO, *command("bins", "--model", "cut.meam", "--out", "cut.csv")), capture_output=True, text=True)
lines = [line for line in result.stderr.splitlines() if line.startswith("batch.py: ")]
check(result.returncode != 0 and len(lines) == 1 and "'cut.meam'" in lines[0] and "cut off" in lines[0], result.stderr)
check(not os.path.exists("cut.csv.run"), "a run that did nothing leaves its folder")
