# SPDX-License-Identifier: BSD-3-Clause
"""Fits the probabilities of a model's poses to scans of one's own in which it is known which poses are right, and shows
how they hold, before and after. A few dozen scans; 20 poses in 5 scans at least.

SCANS is a dataset in the form of the BOP benchmark with true poses, in which the part is looked for now; or a table that
`batch` wrote with that model, to which you have added a column `right`: 1 where a pose is right, `turned` where a copy is
there and the pose is turned wrongly, 0 where it is wrong, and nothing where you do not know.

`said` is the mean of what the model says of the poses of a class now. `calibrated` is what it says when it is calibrated on
other scans: every fifth scan is left out in turn. Places and rotations are each changed only where that is better for the
scans left out. A calibration takes the place of the one before."""
import argparse
import csv
import math
import os

import numpy

from .. import dataset, evaluation, filters, scripting

MOST = 1e6  # constants and slopes of calibrations are a few
VERDICTS = {"1": (1, 0), "turned": (1, 2), "0": (0, 3)}  # CopyIsThere and PoseOutcome
WRITTEN = {"1.0": "1", "0.0": "0", "true": "1", "false": "0"}  # by spreadsheets, and by pandas where some are empty
CLASSES = ("Claim", "Least", "Most", "Poses", "Right", "Before", "After")
ARRAYS = ("PlaceProbability", "Certainty", "Scene", "CopyIsThere", "PoseOutcome")


def in_dataset(options, model):
    """The poses in a dataset beside the true ones."""
    data = dataset.Dataset(options.scans, options.split)
    objects = data.objects()
    if options.object is None and len(objects) > 1:
        raise scripting.Failure(f"{options.scans} has the objects {', '.join(map(str, objects))}: name the model's by --object")
    if options.object is not None and options.object not in objects:
        raise scripting.Failure(f"{options.scans} has no object {options.object}: its objects are {', '.join(map(str, objects))}")
    number = options.object or objects[0]
    run = evaluation.Evaluation(model, options.preset, 0, options.threads, 0, options.features)
    for scene in map(data.scene, options.scenes or data.scenes()):
        for step in scene.steps:
            image = scene.image(step)
            run.add(run.find(image.scan, None, image.beside, data.beside()), image.truth_of(number))
    scripting.update(run.judge)
    return run.judge.GetOutputDataObject(2)


def said_by(probability, line, before):
    """What a model with this line says, where one with another said this."""
    if tuple(line) == tuple(before) or not 0 < probability < 1:
        return probability
    counted = (math.log(probability / (1 - probability)) - before[0]) / before[1]
    return float(1 / (1 + numpy.exp(-line[0] - line[1] * counted)))


def numbers_of(words, least, most):
    """Of cells, which spreadsheets may have written with decimal commas."""
    values = [float(word.replace(",", ".")) for word in words]
    if not all(least <= value <= most for value in values):
        raise ValueError
    return values


def written_by(cell):
    """Constant and slope of places and of rotations; none of an empty cell, as of a table of an older version."""
    words = (cell or "").split()
    constant, slope, turned_constant, turned_slope = numbers_of(words, -MOST, MOST) if words else (0, 1, 0, 1)
    if min(slope, turned_slope) <= 0:
        raise ValueError
    return (constant, slope, turned_constant, turned_slope) if words else None


def judged_lines(path, number):
    """Of the table the lines with a verdict on poses of one object: of each its place in the file, its cells and the verdict."""
    with open(path, newline="", encoding="utf-8-sig") as file:
        is_of_semicolons = ";" in file.readline()  # as spreadsheets write it where the comma is decimal
        file.seek(0)
        table = csv.DictReader(file, delimiter=";" if is_of_semicolons else ",")
        missing = {"scan", "place_probability", "probability", "right"}.difference(table.fieldnames or ())
        if missing:
            raise scripting.Failure(f"{path} has no column {', '.join(sorted(missing))}: give a table that `batch` wrote, and add "
                                    "the column `right` with 1, `turned` or 0")
        objects, lines = set(), []
        for line in table:
            verdict = (line["right"] or "").strip().lower().replace(",", ".")
            verdict = WRITTEN.get(verdict, verdict)
            if not verdict or not line["probability"]:
                continue
            if verdict not in VERDICTS:
                raise scripting.Failure(f"{path}, line {table.line_num}: right is '{line['right']}', not 1, `turned` or 0")
            objects.add(line.get("obj_id") or "1")
            if number is None or line.get("obj_id") in (None, "", str(number)):
                lines.append((table.line_num, line, verdict))
    if number is None and len(objects) > 1:
        raise scripting.Failure(f"{path} has poses of the objects {', '.join(sorted(objects))}: name the model's by --object")
    return lines


def confirmed(path, number, calibration):
    """The poses of a table that somebody has judged, as a model with this calibration tells them."""
    scenes, rows = {}, []
    for at, line, verdict in judged_lines(path, number):
        try:
            place, probability = numbers_of((line["place_probability"], line["probability"]), 0, 1)
        except ValueError:
            raise scripting.Failure(f"{path}, line {at}: a probability is not a number from 0 to 1") from None
        certainty = min(probability / place, 1.0) if place > 0 else 1.0
        try:
            before = written_by(line.get("calibration")) or calibration
            place, certainty = (said_by(said, calibration[k:k + 2], before[k:k + 2]) for k, said in ((0, place), (2, certainty)))
        except ValueError:
            raise scripting.Failure(f"{path}, line {at}: calibration is '{line['calibration']}', not the four numbers that `batch` "
                                    "wrote") from None
        rows.append((place, certainty, scenes.setdefault(line["scan"], len(scenes)), *VERDICTS[verdict]))
    values = numpy.array(rows, float).reshape(-1, len(ARRAYS))
    poses = scripting.poses_of(numpy.tile(numpy.eye(4), (len(rows), 1, 1)))
    for name, column in zip(ARRAYS, values.T):
        poses.GetPointData().AddArray(scripting.vtk_array(column, name))
    return poses


def classes_of(table):
    """Of each class of poses a row of CLASSES."""
    columns = [table.GetColumnByName(name) for name in CLASSES]
    return [[column.GetValue(row) for column in columns] for row in range(table.GetNumberOfRows())]


def print_classes(classes):
    said = {"place": "that a copy is there", "pose": "that the pose is right, with its rotation"}
    last = None
    for claim, least, most, poses, right, before, after in classes:
        if claim != last:
            print(f"\n{said[claim]:44} poses   right    said  calibrated")
            last = claim
        print(f"  {100 * least:3.0f} to {100 * most:3.0f} % {poses:35d} {100 * right:6.1f}% {100 * before:6.1f}% {100 * after:10.1f}%")


def line_words(what, constant, slope):
    if (constant, slope) == (0, 1):
        return f"{what} as before"
    return f"of {what} {constant:.2f} + {slope:.2f} times the log odds"


def main():
    parser = scripting.Parser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("scans", metavar="SCANS", help="a BOP dataset with true poses, or a table of `batch` with a column `right`")
    parser.add_argument("--model", required=True, help="the trained model, calibrated before or not")
    parser.add_argument("--out", required=True, help="the calibrated model to write: NAME.meam or NAME.vtpc; may be that of --model")
    parser.add_argument("--object", type=scripting.count, help="the number of the model's object, where SCANS has several")
    parser.add_argument("--split", default="test", help="of a dataset: folder of the scenes (default: %(default)s)")
    parser.add_argument("--scenes", type=evaluation.numbers, help="of a dataset: such as 0-4,7 (default: all)")
    parser.add_argument("--json", metavar="FILE", help="write what is printed as JSON")
    parser.add_argument("--threads", type=scripting.count, default=0, help="0: all cores (default)")
    options = parser.parse_args()
    options.preset, options.features = "recommended", "both"

    scripting.require_model_name(options.out)
    scripting.require_folder_of(options.out, options.json)
    if not os.path.isdir(options.scans):
        scripting.require_file(options.scans)
    model = scripting.read_model(options.model)
    calibration = filters.vtkMEAMModelCalibration()
    calibration.SetInputDataObject(0, model)
    calibration.SetInputDataObject(1, in_dataset(options, model) if os.path.isdir(options.scans)
                                   else confirmed(options.scans, options.object, scripting.calibration_of(model)))
    calibrated = scripting.update(calibration).GetOutputDataObject(0)
    table = calibration.GetOutputDataObject(1)
    classes = classes_of(table)
    print_classes(classes)
    before, after = (scripting.field(table, name) for name in ("LossBefore", "LossAfter"))
    print(f"\nmean logarithmic loss of a pose: {before:.4f}, calibrated {after:.4f}")
    numbers = table.GetFieldData().GetArray("Calibration")
    constant, slope, turned_constant, turned_slope, poses = (numbers.GetValue(k) for k in range(5))
    if math.isclose(before, after, abs_tol=1e-12):
        print("the probabilities hold in these scans as well as calibrated ones would: they stay as they are")
    if warning := table.GetFieldData().GetAbstractArray("Warning").GetValue(0):
        print(f"warning: {warning}")
    scripting.write_model(calibrated, options.out)
    print(f"{options.out}: calibrated on {poses:.0f} poses; {line_words('places', constant, slope)}, "
          f"{line_words('rotations', turned_constant, turned_slope)}")
    if options.json:
        names = [name.lower() for name in CLASSES]
        scripting.write_json(options.json, {
            "model": options.out, "poses": int(poses), "loss_before": before, "loss_after": after, "places": [constant, slope],
            "rotations": [turned_constant, turned_slope], "classes": [dict(zip(names, row)) for row in classes]})
