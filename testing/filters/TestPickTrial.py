# SPDX-License-Identifier: BSD-3-Clause
"""vtkMEAMPickTrial: planned picks played among true copies."""
from meamtest import box, check, cloud, connect, fails, poses, run, texts, tuples

from ppfmeam.filters import vtkMEAMPickPlanning, vtkMEAMPickTrial

PART = box(20, 40, 20, (-10, -20, -10))


def at(x, y, z=490.0):
    return (1, 0, 0, x, 0, 1, 0, y, 0, 0, 1, z, 0, 0, 0, 1)


above = cloud([(0, 0, 0), (0, 0, 0)], Transform=[(1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1),
                                                 (1, 0, 0, 0, 0, 0, -1, 0, 0, 1, 0, 0, 0, 0, 0, 1)], Width=[20, 20])
planning = connect(vtkMEAMPickPlanning(), poses(at(0, 0)), PART, above, BinPosition=(0, 0, 500), BinSize=(300, 300, 100))
planning.SetBinToGiven()


def outcomes(*truths):
    trial = connect(vtkMEAMPickTrial(), planning, PART, poses(*truths))
    data = run(trial)
    check(data.GetNumberOfPoints() == 2, "the picks stay")
    return texts(data, "OutcomeName"), [t[0] for t in tuples(data, "TrueInstance")]


check(outcomes(at(100, 0), at(0, 0)) == (["success", "not tried"], [2, 0]), outcomes(at(100, 0), at(0, 0)))
check(outcomes(at(5, 0)) == (["hits the part itself", "not tried"], [1, 0]), outcomes(at(5, 0)))
check(outcomes(at(100, 0)) == (["holds nothing", "not tried"], [0, 0]), outcomes(at(100, 0)))
check(outcomes(at(0, 0), at(26, 0))[0][0] == "hits another part", "a neighbour that was not found")

fails(connect(vtkMEAMPickTrial(), planning), "Part", "True poses")
trial = connect(vtkMEAMPickTrial(), planning, PART, poses(at(0, 0)), WayIn=-1)
fails(trial, "way in", "0 mm or more", "-1")
# A gripper of any shape is not forgotten.
finger = box(4, 4, 50, (-2, -2, -70))
planning.SetInputDataObject(4, finger)
trial = connect(vtkMEAMPickTrial(), planning, PART, poses(at(0, 0)))
fails(trial, "gripper's mesh")
trial.SetInputDataObject(3, finger)
check(run(trial).GetNumberOfPoints() == 2, "with its mesh they are tried")

fails(connect(vtkMEAMPickTrial(), above, PART, poses(at(0, 0))), "Gripper", "Pick Planning")
