# SPDX-License-Identifier: BSD-3-Clause
"""Rates and errors of a handful of poses, over one scene and over two."""
import math

from ppfmeam.filters import vtkMEAMPoseEvaluation
from meamtest import Errors, box, check, close, cloud, connect, field, poses, run, set_fields, tuples


def at(x, degrees=0.0):
    """Shifted along x, turned about z."""
    c, s = math.cos(math.radians(degrees)), math.sin(math.radians(degrees))
    return (c, -s, 0, x, s, c, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1)


def evaluation(estimates, truths, diameter=50.0, **properties):
    return connect(vtkMEAMPoseEvaluation(), estimates, truths, Diameter=diameter, **properties)


def column(table, name):
    return [table.GetColumnByName(name).GetValue(i) for i in range(table.GetNumberOfRows())]


def figure(table, name):
    return field(table, name)[0][0]


# A right one, the same again, a wrong one, one that is turned too far.
truths = poses(at(0), at(100), at(200))
filter = evaluation(poses(at(1), at(2, 3), at(50), at(100, 90)), truths)
table = run(filter)
check(column(table, "Rank") == [1, 2, 3, 4] and column(table, "Scene") == [0] * 4, "a row for each pose")
check(column(table, "Right") == [1, 1, 0, 0] and column(table, "Duplicate") == [0, 1, 0, 0], "two are right")
check(column(table, "Instance") == [0, 0, -1, -1], f"instances: {column(table, 'Instance')}")
check(column(table, "NearestInstance")[3] == 1, "the turned one lies at the second")
check(column(table, "Outcome") == [0, 1, 3, 2], f"hit, duplicate, wrong place, wrong turn: {column(table, 'Outcome')}")
found = filter.GetOutputDataObject(1)
check(column(found, "FoundBy") == [1, 0, 0] and column(found, "NearestRank") == [1, 4, 4], "the first is found")
check(column(found, "HasToBeFound") == [1, 1, 1] and close(column(found, "TranslationError"), (1, 0, 100)), "its error")
judged = filter.GetOutputDataObject(2)
check([outcome for outcome, in tuples(judged, "PoseOutcome")] == [0, 1, 3, 2] and judged.GetPointData().HasArray("Transform"),
      "the poses with what they are")
check(math.isclose(figure(table, "RecallAtPrecision99"), 100 / 3), "the likeliest alone, of three")
check(close(column(table, "TranslationError")[:2], (1, 2)), "distances in mm")
check(close(column(table, "RotationError"), (0, 3, 0, 90)), "angles in degrees")
check(close(column(table, "RollError"), (0, 3, 0, 90)) and close(column(table, "AxisError"), (0,) * 4), "all is roll")
check((figure(table, "PaperRate"), figure(table, "StrictRate"), figure(table, "Top1Rate")) == (50, 20, 100), "rates")
check(math.isclose(figure(table, "Recall"), 100 / 3), "one of three is found")
check(math.isclose(figure(table, "MeanTranslationError"), 1.5), "errors of the right ones")

# About another axis the turn is a swing; with wider tolerances all are right.
filter.SetAxis(1, 0, 0)
filter.SetRotationTolerance(91)
filter.SetTranslationTolerance(101)
filter.SetPosesAskedFor(2)
table = run(filter)
check(close(column(table, "AxisError")[3:], (90,)) and close(column(table, "RollError")[3:], (0,)), "all is swing")
check((figure(table, "PaperRate"), figure(table, "StrictRate"), figure(table, "Poses")) == (100, 50, 2), "rates of two")

# Of a part 1 m from its origin a turn by 1 degree about its own middle displaces the origin, but not the part.
away = connect(vtkMEAMPoseEvaluation(), poses(at(0, 1)), poses((*at(0)[:3], 1000 * math.cos(math.radians(1)) - 1000, *at(0)[4:7],
                                                                1000 * math.sin(math.radians(1)), *at(0)[8:])))
away.SetDiameter(50)
check(column(run(away), "TranslationError")[0] > 17, "the origin")
away.SetInputDataObject(2, cloud([(990, -5, 0), (1010, 5, 0)]))
check(close(column(run(away), "TranslationError"), (0,)), "the middle")

# A second scene in which nothing was found; the diameter comes with the poses.
filter = evaluation(set_fields(poses(at(0)), Diameter=50.0), poses(at(0)), 0.0)
filter.AddInputDataObject(0, poses())
filter.AddInputDataObject(1, poses(at(0)))
table = run(filter)
check((figure(table, "PaperRate"), figure(table, "StrictRate"), figure(table, "Top1Rate")) == (100, 10, 50), "rates")
check(figure(table, "Scenes") == 2, "two scenes")

# With the mesh AP at MSSD of 2 to 20 mm: 3 mm off one of two copies, precision 1 up to a recall of 1/2 at all but 2 mm.
check(not table.GetFieldData().HasArray("AveragePrecisionMSSD"), "a figure that needs the mesh")
benchmark = evaluation(poses(at(3)), poses(at(0), at(100)))
benchmark.SetInputDataObject(3, box(40, 40, 10))
check(math.isclose(figure(run(benchmark), "AveragePrecisionMSSD"), 90 * 51 / 101), "51 of 101 recalls at 9 of 10 thresholds")

# Instances that are too hidden need not be found.
hidden = cloud([(0, 0, 0)] * 2, Transform=[at(0), at(100)], VisibleFraction=[0.9, 0.2])
check(figure(run(evaluation(poses(at(0)), hidden)), "Recall") == 100, "the hidden one does not count")
check(figure(run(evaluation(poses(at(0)), hidden, MinimumVisibleFraction=0.1)), "Recall") == 50, "now it does")


def fails(filter, *words):
    errors = Errors(filter)
    filter.Update()
    check(str(errors) and all(word in str(errors) for word in words), f"expected {words}: {errors}")
    check(filter.GetOutput().GetNumberOfRows() == 0, "the output is empty")


fails(evaluation(poses(at(0)), poses(at(0)), 0.0), "diameter")
fails(evaluation(box(1, 1, 1), poses(at(0))), "Transform")
fails(evaluation(poses(at(0)), poses(at(0)), Axis=(0, 0, 0)), "axis")
lonely = evaluation(poses(at(0)), poses(at(0)))
lonely.AddInputDataObject(0, poses())
fails(lonely, "2 scenes")
fails(connect(vtkMEAMPoseEvaluation(), poses(at(0))))
