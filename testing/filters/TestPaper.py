# SPDX-License-Identifier: BSD-3-Clause
"""The paper's experiments: what they count, which scenes they need, that a stopped run goes on and what becomes of bad scenes;
with --long all of them by one command, short."""
import math
import os
import signal
import subprocess
import sys
import tempfile
import time

import numpy
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkDoubleArray, vtkPoints
from vtkmodules.vtkCommonDataModel import vtkPolyData, vtkStructuredGrid

from ppfmeam import paper, stage, world
from meamtest import check, close

# Two scenes, of which one returns three poses of five.
ROWS = [{"poses": "5", "right": "4", "asked": "5", "ms": "100"}, {"poses": "3", "right": "2", "asked": "5", "ms": "300"}]
check(close([paper.rate(ROWS), paper.strict(ROWS), paper.milliseconds(ROWS)], [75, 60, 200]), "rates of two scenes")
check(math.isnan(paper.rate([])) and math.isnan(paper.milliseconds([])), "nothing is no rate")

# Table 1 is four parts by three methods; 2 is of the same scenes; of 5 and 6 some are the same.
check(len(paper.planned([1], 30, 1)) == len(paper.planned([1, 2], 30, 1)) == 4 * 3 * 30, "scenes of tables 1 and 2")
check(len(paper.planned([3], 2, 1)) == 24 and len(paper.planned([3, 4, 5, 6], 2, 1)) == 24 + 8 + 4, "scenes of tables 3 to 6")
check(not {tuple(row[name] for name in paper.RUN) for row in paper.planned([1], 2, 1, 8)}
      & {tuple(row[name] for name in paper.RUN) for row in paper.planned([1], 2, 1)}, "bins of fewer copies are others")
check({row["seed"] for row in paper.planned([7], 2, 1)} == {"0", "1"}, "scenes of a dataset count from 0")

# A camera of 100 pixels at 100 mm: of four edge points one lies behind what is measured at its pixel, one beside the scan.
scan, truth = vtkStructuredGrid(), vtkPolyData()
scan.SetDimensions(3, 3, 1)
scan.SetPoints(vtkPoints())
for row in range(3):
    for column in range(3):
        scan.GetPoints().InsertNextPoint(column - 1, row - 1, 100 if column < 2 else math.nan)
for data, name, values in ((scan, "CameraMatrix", [100, 0, 1, 0, 100, 1, 0, 0, 1]), (truth, "Diameter", [50])):
    array = vtkDoubleArray()
    array.SetName(name)
    array.SetNumberOfComponents(len(values))
    array.InsertNextTuple(values)
    data.GetFieldData().AddArray(array)
truth.SetPoints(vtkPoints())
truth.GetPoints().InsertNextPoint(0, 0, 100)
transform = numpy_to_vtk(numpy.array([[1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 100, 0, 0, 0, 1]], dtype=float), deep=True)
transform.SetName("Transform")
truth.GetPointData().AddArray(transform)
edges = numpy.array([(0, 0, 0.4), (0, 0, 0.6), (1, 0, 30), (9, 0, 0)], dtype=float)
kept = vtk_to_numpy(paper.seen(edges, truth, scan).GetPoints().GetData())
check(numpy.allclose(kept, [(0, 0, 100.4), (1, 0, 130)]), f"of four edge points these are seen: {kept}")

# A step of 10 mm that is found as 10.5, a turn of 20 degrees found as 19.
still = numpy.eye(4)
check(close([stage.errors(still, stage.moved(still, 10.5), numpy.array([3.0, 0, 0]), distance=10)], [0.5], 1e-9), "the error of a move")
middle = numpy.array([3.0, 4.0, 5.0])
turned = stage.turned(still, middle, 19)
check(close([stage.errors(still, turned, middle, degrees=20)], [1.0], 1e-6), "the error of a turn")
check(numpy.allclose(turned[:3, :3] @ middle + turned[:3, 3], middle), "a turn moves the middle")

# A search, the table of it, and a run that has nothing left to do.
with tempfile.TemporaryDirectory() as folder:
    rows = [row for row in paper.planned([6], 1, 1, 4) if row["method"] == "recommended"]
    check(len(rows) == 1, f"{rows}")
    done = world.Lines(os.path.join(folder, "paper.csv"), paper.ROW)
    paper.measure(rows, done, paper.Scenes(folder, 4, None), 0)
    check(len(done.rows) == 1 and done.rows[0]["failure"] == "" and int(done.rows[0]["right"]) >= 3, f"{done.rows}")
    text = paper.written(6, done.rows, folder)
    line = next(line for line in text.splitlines() if line.startswith("| PPF-MEAM, recommended |"))
    right, poses = int(done.rows[0]["right"]), int(done.rows[0]["poses"])
    check(line.endswith(f"| {100 * right / poses:.1f} % |") and "| 91.0 % |" in text, text)
    check(os.path.exists(os.path.join(folder, "table6.csv")) and os.path.exists(os.path.join(folder, "table6.md")), "files")
    again = world.Lines(os.path.join(folder, "paper.csv"), paper.ROW)
    paper.measure(rows, again, None, 0)  # looks at no scene
    check(again.rows == done.rows, "the same rows")


class Stopped(world.Lines):
    """A file of a run that is stopped in its third search, and killed while it writes."""

    def add(self, rows):
        if len(self.rows) == 2:
            with open(self.path, "a", encoding="utf-8") as file:
                file.write("image,hole_pl")
            raise KeyboardInterrupt
        super().add(rows)


def without_times(rows):
    return [{**row, "ms": ""} for row in rows]


# A run that was stopped writes the same as one that was not; a bin that cannot be read is a row with its reason, and wrong.
TABLE = paper.Figure("A table", "image", paper.by_part([("D", "hole_plate")]), ("ppf", "recommended"), {}, paper.rate)
with tempfile.TemporaryDirectory() as folder:
    os.makedirs(os.path.join(folder, "stopped"))
    paper.TABLES[0] = TABLE
    rows, scenes = paper.planned([0], 2, 1, 3), paper.Scenes(folder, 3, None)
    whole = world.Lines(os.path.join(folder, "paper.csv"), paper.ROW)
    paper.measure(rows, whole, scenes, 0)
    check([row["failure"] for row in whole.rows] == [""] * 4, f"{whole.rows}")
    check(all(int(row["poses"]) == sum(int(row[name]) for name in paper.OUTCOMES) for row in whole.rows), f"{whole.rows}")
    check(all(0 <= float(row["AP2-20"]) <= 100 and int(row["targets"]) >= 1 for row in whole.rows), f"{whole.rows}")
    path = os.path.join(folder, "stopped", "paper.csv")
    try:
        paper.measure(rows, Stopped(path, paper.ROW), scenes, 0)
        check(False, "it was not stopped")
    except KeyboardInterrupt:
        pass
    resumed = world.Lines(path, paper.ROW)
    check(len(resumed.rows) == 2, "what was done is known")
    paper.measure(rows, resumed, scenes, 0)
    check(without_times(resumed.rows) == without_times(whole.rows), f"{resumed.rows} {whole.rows}")
    texts = [[make(0, lines.rows, place) for make in (paper.written, paper.details)]
             for lines, place in ((whole, folder), (resumed, os.path.dirname(path)))]
    check(texts[0] == texts[1], f"{texts}")
    share = [sum(int(row["right"]) for row in whole.rows if row["method"] == "recommended") / 10 * 100]
    line = next(line for line in texts[0][1].splitlines() if line.startswith("| PPF-MEAM, recommended |"))
    check(float(line.split("|")[2].strip(" %")) == round(share[0], 1), f"{line}, {share}")

    for extension in (".vts", ".vtp"):
        with open(os.path.join(folder, "bins", "hole_plate_structured-light_3_1" + extension), "w", encoding="utf-8") as file:
            file.write("nothing")
    broken = world.Lines(os.path.join(folder, "broken.csv"), paper.ROW)
    paper.measure(rows[:1], broken, paper.Scenes(folder, 3, None), 0)
    check("hole_plate_structured-light_3_1" in broken.rows[0]["failure"] and paper.strict(broken.rows) == 0, f"{broken.rows}")
    del paper.TABLES[0]

EVALUATE = [sys.executable, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", "examples", "evaluate.py"), "paper"]


def refuses(words, *arguments):
    done = subprocess.run([*EVALUATE, *arguments], capture_output=True, text=True, check=False)
    check(done.returncode == 1 and done.stderr.count("\n") == 1 and words in done.stderr, f"expected '{words}': {done.stderr}")


with tempfile.TemporaryDirectory() as folder:
    refuses("table 7 needs the Tohoku dataset", "--table", "7", "--out", folder)
    refuses("cannot read nowhere/Part_1", "--table", "7", "--tohoku", "nowhere", "--out", folder)
    refuses("there is no table 10", "--table", "10", "--out", folder)
    with open(os.path.join(folder, "paper.csv"), "w", encoding="utf-8") as file:
        file.write("something,else\n")
    refuses("is not of this version", "--table", "6", "--out", folder)

# All of it, stopped once on the way.
if "--long" in sys.argv:
    with tempfile.TemporaryDirectory() as folder:
        start, command = time.time(), [*EVALUATE, "--all", "--quick", "--out", folder]
        stopped = subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
        while "5 of " not in stopped.stderr.readline():
            pass
        stopped.send_signal(signal.SIGINT)
        stopped.communicate()
        check(stopped.returncode == 128 + signal.SIGINT, f"status {stopped.returncode}")
        done = subprocess.run(command, capture_output=True, text=True, check=False)
        check(done.returncode == 0 and "\n1 of " not in "\n" + done.stderr, done.stderr)
        files = set(os.listdir(folder))
        expected = {f"table{number}.{form}" for number in (1, 2, 3, 4, 5, 6) for form in ("md", "csv")} | {"table9.md", "figure13.md", "figure13.csv"}
        check(expected <= files, f"{expected - files} are missing")
        check("84 of 84: " in done.stderr and "Table 9." in done.stdout and "Figure 13." in done.stdout, done.stderr)
        print(f"{time.time() - start:.0f} s")
