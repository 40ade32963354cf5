# SPDX-License-Identifier: BSD-3-Clause
"""`ppfmeam batch` by two processes: the table of one, also after one of them or all were killed, and one sentence for
what goes wrong. Arguments: mpirun and pvbatch."""
import fcntl
import glob
import os
import subprocess
import sys
import tempfile

sys.path.append(os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "filters"))

from batchtest import (BATCH, children, command, content, dataset, deadly, finished, killed,  # noqa: E402
                       rows, survives)  # noqa: E402
from meamtest import check, skip  # noqa: E402
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
    check({row["process"] for row in rows(name.replace(".csv", ".scans.csv"))} == {"0", "1"}, "both processes work")

# Parts are trained once.
finished(*TWO, PVBATCH, "--symmetric", BATCH, "bins", "--cad", "bins/models/obj_000001.ply", "--out", "cad.csv")
check(len(rows("cad.csv")) == len(rows("one.csv")), "a part from its CAD file")

# Models are read once from the disk: copies in memory, one on each machine, which go. Processes are of one machine
# ("together"), or each is taken for one of another machine; the memory of the second one, or of both, may be full; there may
# be none; or the first process is killed while it copies.
with open("listening.py", "w", encoding="utf-8") as file:
    file.write("""
import os, resource, signal, sys
from ppfmeam import scripting
from ppfmeam.batch import nearby, ranks
from ppfmeam.commands import batch

where = sys.argv[1]
nearby.MEMORY = os.path.abspath("none" if where == "no memory" else "memory")
read, pieces, copy = scripting.read_model, nearby.pieces, nearby.copy

def listen(path):
    said("read", path)
    return read(path)

def listen_to_pieces(path):
    if ranks_made.rank == 0:
        said("copied", path)
        if where == "killed":
            os.kill(os.getpid(), signal.SIGKILL)
    return pieces(path)

def copy_to_full_memory(ranks, *arguments):
    limits = resource.getrlimit(resource.RLIMIT_FSIZE)
    if where == "full" or where == "second full" and ranks.rank == 1:
        resource.setrlimit(resource.RLIMIT_FSIZE, (100000, limits[1]))
    whole = copy(ranks, *arguments)
    resource.setrlimit(resource.RLIMIT_FSIZE, limits)
    assert whole or not arguments[1] or not os.path.exists(arguments[1]), "what has no room stays"
    return whole

def said(what, path):
    with open(f"heard.{os.getpid()}", "a") as file:
        print(what, path, file=file)

class Apart(ranks.MPIRanks):
    def __init__(self, *arguments):
        super().__init__(*arguments)
        self.here, self.leads, self.leaders = self.comm.Split(self.rank), True, self.comm

if where in ("apart", "second full"):
    ranks.MPIRanks = Apart
scripting.read_model, nearby.pieces, nearby.copy = listen, listen_to_pieces, copy_to_full_memory
make = ranks.ranks

def ranks_of_run():
    global ranks_made
    ranks_made = make()
    return ranks_made

batch.ranks = ranks_of_run
sys.argv = ["batch.py", *sys.argv[2:]]
scripting.run(batch.main)
""")
scripting.write_model(model, "plate.vtpc")
os.mkdir("memory")
os.mkdir("memory/ppfmeam-models-used")
used = os.open("memory/ppfmeam-models-used", os.O_RDONLY)
fcntl.flock(used, fcntl.LOCK_EX)


def listening(where, form, out):
    return *TWO, sys.executable, "listening.py", where, "bins", "--model", f"plate.{form}", "--out", out


def left_in_memory():
    return sorted(set(os.listdir("memory")) - {"ppfmeam-models-used"})


check(subprocess.run(listening("killed", "meam", "left.csv"), capture_output=True).returncode != 0, "nothing was killed")
check(len(left_in_memory()) == 1 and left_in_memory()[0].startswith("ppfmeam-models-"), f"{os.listdir('memory')}")
os.remove(glob.glob("heard.*")[0])
for form, where, originals, copies in (
        ("meam", "together", 0, 1), ("vtpc", "together", 0, 1), ("meam", "apart", 0, 2), ("vtpc", "full", 2, 0),
        ("meam", "second full", 1, 1), ("meam", "no memory", 2, 0)):
    out = f"{form}.{where}.csv"
    finished(*listening(where, form, out))
    check(content(out) == content("one.csv"), f"{out}: another table")
    check(not left_in_memory() and os.path.isdir("memory/ppfmeam-models-used"), f"{out}: {os.listdir('memory')}")
    heard = []
    for name in glob.glob("heard.*"):
        with open(name, encoding="utf-8") as file:
            heard += [line.split() for line in file]
        os.remove(name)
    copied, read = ([path for what, path in heard if what == kind] for kind in ("copied", "read"))
    check(len(copied) == len(set(copied)) and f"plate.{form}" in copied, f"{out}: {heard}")
    of_memory = [path for path in read if path != f"plate.{form}"]
    check(len(read) == 2 and read.count(f"plate.{form}") == originals, f"{out}: {heard}")
    check(len(set(of_memory)) == copies and not any(map(os.path.exists, of_memory)), f"{out}: {heard}")
os.close(used)

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
