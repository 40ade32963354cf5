# SPDX-License-Identifier: BSD-3-Clause
"""A model that says too much, or turns its part wrongly, is told so by judged poses: by the filter, by the program from a
table and from a dataset, and from Python; and says so in the next scan. Bad tables are told apart."""
import csv
import json
import math
import os

import numpy
from vtkmodules.util.numpy_support import vtk_to_numpy

import ppfmeam
from ppfmeam.filters import vtkMEAMModelCalibration, vtkMEAMPoseEstimation
from batchtest import dataset
from meamtest import check, close, cloud, connect, fails, field, read, run, write
from scripttest import H, W, refuses, scan_of_bin, works, write_pcd, write_stl

scan, truth, mesh = scan_of_bin()
write_stl("part.stl", mesh)
works("train.py", "--cad", "part.stl", "--out", "part.meam")
model = ppfmeam.load("part.meam")

# Of each scan four poses that say 1 of 2: three are there, of which one is turned wrongly.
SCENES, PLACE = 10, 0.5
rows = [(scene, PLACE, certainty, is_there, outcome) for scene in range(SCENES)
        for certainty, is_there, outcome in ((0.5, 1, 0), (0.5, 1, 0), (0.5, 1, 2), (0.5, 0, 3))]
names = ("Scene", "PlaceProbability", "Certainty", "CopyIsThere", "PoseOutcome")
judged = cloud([(0, 0, 0)] * len(rows), **{name: [float(row[k]) for row in rows] for k, name in enumerate(names)})
data = model.data
filter = connect(vtkMEAMModelCalibration(), data, judged)
calibrated = run(filter)
numbers = [value for value, in field(calibrated, "Calibration")]
check(not data.GetFieldData().HasArray("Calibration"), "the model that came in is not changed")
place, rotation = numbers[0], numbers[2]
check(math.isclose(40 * (1 / (1 + math.exp(-place)) - 0.75) + place / 4, 0, abs_tol=1e-6), f"3 of 4 are there: {numbers}")
check(math.isclose(30 * (1 / (1 + math.exp(-rotation)) - 2 / 3) + rotation / 4, 0, abs_tol=1e-6), f"2 of 3 of these: {numbers}")
check(numbers[4] == 40, "of so many poses")
table = filter.GetOutputDataObject(1)
column = {name: [table.GetColumnByName(name).GetValue(k) for k in range(table.GetNumberOfRows())]
          for name in ("Claim", "Poses", "Right", "Before", "After")}
check(column["Claim"] == ["place", "pose"] and column["Poses"] == [40, 40], f"{column}")
check(close(column["Right"], (0.75, 0.5)) and close(column["Before"], (0.5, 0.25)), f"{column}")
check(abs(column["After"][0] - 0.75) < 0.05 and abs(column["After"][1] - 0.5) < 0.05, f"{column}")
check(field(table, "LossAfter")[0][0] < field(table, "LossBefore")[0][0], "it is worth something")
judged.GetPointData().RemoveArray("CopyIsThere")
fails(connect(vtkMEAMModelCalibration(), data, judged), "CopyIsThere", "Pose Evaluation")
fails(connect(vtkMEAMModelCalibration(), data), "Judged Poses")


# The next scan is told by it, and a file of the model holds it.
def found_by(model):
    poses = run(connect(vtkMEAMPoseEstimation(), model, scan))
    arrays = [vtk_to_numpy(poses.GetPointData().GetArray(name)) for name in ("PlaceProbability", "Certainty", "Transform")]
    order = numpy.lexsort(arrays[2].T)  # ranks follow what is said
    return [array[order] for array in arrays]


(places, certainties, before), (new_places, new_certainties, after) = found_by(data), found_by(calibrated)
log_odds = numpy.log(places / (1 - places))
check((before == after).all(), "the poses stay where they are")
check(numpy.allclose(new_places, 1 / (1 + numpy.exp(-log_odds * numbers[1] - place)), atol=1e-9), "their places are as calibrated")
check(((new_certainties == 1) == (certainties == 1)).all(), "of the one rotation that there is nothing is taught")
ppfmeam.Model(calibrated).save("calibrated.meam")
again = [value for value, in field(ppfmeam.load("calibrated.meam").data, "Calibration")]
check(again == numbers, f"a file holds {again}")

# The program, from a table of `batch` that somebody judged.
with open("judged.csv", "w", newline="") as file:
    writer = csv.writer(file)
    writer.writerow(("scan", "obj_id", "rank", "score", "place_probability", "probability", "R", "t", "failure", "right"))
    words = {0: "1", 2: "turned", 3: "0"}
    for scene, place_said, certainty, _, outcome in rows:
        writer.writerow((f"scan{scene}", 1, 1, 0.9, place_said, place_said * certainty, "", "", "", words[outcome]))
    writer.writerow(("scan0", 1, 5, 0.9, 0.1, 0.1, "", "", "", ""))
    writer.writerow(("scan11", "", "", "", "", "", "", "", "no edges", ""))
text = works("calibrate.py", "judged.csv", "--model", "part.meam", "--out", "told.meam", "--json", "told.json")
written = json.loads(read("told.json"))
check(written["poses"] == 40 and [*written["places"], *written["rotations"]] == numbers[:4] and
      sum(row["poses"] for row in written["classes"] if row["claim"] == "place") == 40, f"{written}")
check("calibrated on 40 poses" in text and "75.0%" in text, text)
check([value for value, in field(ppfmeam.load("told.meam").data, "Calibration")] == numbers, "as by the filter")
for name, change in (("none", lambda text: text.replace(",right", "")), ("word", lambda text: text.replace(",turned", ",perhaps")),
                     ("number", lambda text: text.replace(",0.25,", ",much,")), ("nan", lambda text: text.replace(",0.25,", ",nan,")), ("few", lambda text: "".join(text.splitlines(True)[:9]))):
    write(f"{name}.csv", change(read("judged.csv")))
with open("judged.csv", newline="") as file, open("spreadsheet.csv", "w", newline="", encoding="utf-8-sig") as other:
    lines = list(csv.reader(file))
    column = lines[0].index("right")
    for line in lines[1:]:
        line[column] = {"1": "TRUE", "0": "0,0"}.get(line[column], line[column])
    csv.writer(other, delimiter=";").writerows([lines[0], *([cell.replace(".", ",") for cell in line] for line in lines[1:])])
check(works("calibrate.py", "spreadsheet.csv", "--model", "part.meam", "--out", "told.meam").split("\n")[:-2] == text.split("\n")[:-2],
      "a table of a spreadsheet")
# The table says by which calibration it was written: the same poses teach the same again, whichever model they are given to.
with open("judged.csv", newline="") as file, open("noted.csv", "w", newline="") as other:
    header, *lines = csv.reader(file)
    csv.writer(other).writerows([[*header, "calibration"], *([*line, "0.0 1.0 0.0 1.0"] for line in lines)])
again = works("calibrate.py", "noted.csv", "--model", "told.meam", "--out", "again.meam")
check("they stay as they are" in again, again)
check([value for value, in field(ppfmeam.load("again.meam").data, "Calibration")] == numbers, "nothing is added")
for odd in ("0.0 1.0", "0.0 1.0 0.0 1.0 0.0", "0.0 inf 0.0 1.0", "0.0 1.0 0.0 -1.0", "none"):
    write("odd.csv", read("noted.csv").replace("0.0 1.0 0.0 1.0", odd))
    refuses("four numbers", "calibrate.py", "odd.csv", "--model", "part.meam", "--out", "no.meam")
write("two.csv", read("judged.csv").replace("scan1,1,", "scan1,2,"))
refuses("objects 1, 2", "calibrate.py", "two.csv", "--model", "part.meam", "--out", "no.meam")
check("on 36 poses" in works("calibrate.py", "two.csv", "--model", "part.meam", "--out", "one.meam", "--object", "1"), "of one object")
write("exchanged.csv", "scan,place_probability,probability,right\n" +
      "".join(f"scan{k % 8},{said},{said},{int(said < 0.5)}\n" for k in range(40) for said in (0.02, 0.98)))
check("exchanged" in works("calibrate.py", "exchanged.csv", "--model", "part.meam", "--out", "exchanged.meam"), "1 for 0")
refuses("no column right", "calibrate.py", "none.csv", "--model", "part.meam", "--out", "no.meam")
refuses("'perhaps'", "calibrate.py", "word.csv", "--model", "part.meam", "--out", "no.meam")
refuses("not a number", "calibrate.py", "number.csv", "--model", "part.meam", "--out", "no.meam")
refuses("not a number", "calibrate.py", "nan.csv", "--model", "part.meam", "--out", "no.meam")
refuses("20 judged poses in 5 scans", "calibrate.py", "few.csv", "--model", "part.meam", "--out", "no.meam")
refuses("ends in .meam", "calibrate.py", "judged.csv", "--model", "part.stl", "--out", "no.meam")
refuses("nowhere.csv", "calibrate.py", "nowhere.csv", "--model", "part.meam", "--out", "no.meam")

# From true poses: six bins of a dataset.
dataset("data", 6, copies=4)
text = works("calibrate.py", "data", "--model", "part.meam", "--out", "true.meam")
check("mean logarithmic loss of a pose" in text and os.path.exists("true.meam"), text)

# Python.
write_pcd("scan.pcd", numpy.column_stack((vtk_to_numpy(scan.GetPoints().GetData()),
                                          vtk_to_numpy(scan.GetPointData().GetArray("Intensity")))), W, H, "x y z intensity")
found = ppfmeam.detect(model, "scan.pcd", poses=0, probability=0)
told, report = ppfmeam.calibrate(model, [(found, [False] * len(found))] * 20)
check(report.loss_after < report.loss_before and report.classes[0].right == 0, "none is right")
less = ppfmeam.detect(told, "scan.pcd", poses=0, probability=0)
check(less.place_probabilities.max() < found.place_probabilities.max() - 0.2, "and the model says so")
for judged in ([(found, [True])], [(found, ["yes"] * len(found))], [(found, [True] * len(found))]):
    try:
        ppfmeam.calibrate(model, judged)
        check(False, f"{judged} are refused")
    except ppfmeam.Error:
        pass
