# SPDX-License-Identifier: BSD-3-Clause
"""vtkMEAMPickPlanning: possible picks first, the reasons of the others, the gripper and the bin to look at, bad input."""
import os
import tempfile

from meamtest import box, check, close, cloud, connect, fails, poses, prints, run, set_fields, tuples

from vtkmodules.vtkCommonCore import vtkPoints
from vtkmodules.vtkCommonDataModel import vtkPolyData, vtkStructuredGrid

from ppfmeam.filters import vtkMEAMPickPlanning

PART = box(20, 40, 20, (-10, -20, -10))


def at(x, y, z=490.0):
    return (1, 0, 0, x, 0, 1, 0, y, 0, 0, 1, z, 0, 0, 0, 1)


def scan():
    """A floor 500 mm away with a rim of 60 mm around 160 x 120 mm, and a block on it."""
    coordinates = vtkPoints()
    for row in range(200):
        for column in range(240):
            x, y = column - 119.5, row - 99.5
            u, v = abs(x), abs(y)
            z = 500.0
            if u < 85 and v < 65 and (u > 80 or v > 60):
                z = 440.0
            if u < 10 and v < 20:
                z = 480.0
            coordinates.InsertNextPoint(x, y, z)
    grid = vtkStructuredGrid()
    grid.SetDimensions(240, 200, 1)
    grid.SetPoints(coordinates)
    return grid


def names(data, array="Reason"):
    array = data.GetPointData().GetAbstractArray(array)
    return [array.GetValue(i) for i in range(array.GetNumberOfValues())]


above = cloud([(0, 0, 0), (0, 0, 0)], Transform=[(1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1),
                                                 (1, 0, 0, 0, 0, 0, -1, 0, 0, 1, 0, 0, 0, 0, 0, 1)], Width=[20, 20])
found = poses(at(0, 0), at(32, 0))

planning = connect(vtkMEAMPickPlanning(), found, PART, above)
planning.SetBinToGiven()
planning.SetBinPosition(0, 0, 500)
planning.SetBinSize(300, 300, 100)
picks = run(planning)
check(picks.GetNumberOfPoints() == 4, "a pick for each pose and grasp")
check([t[0] for t in tuples(picks, "Possible")] == [0, 0, 0, 0], "the two copies are in each other's way")
check("collides with instance 2" in names(picks) and "collides with instance 1" in names(picks), names(picks))
check(sum("tilted by 90 degrees" == name for name in names(picks)) == 2, names(picks))
check(sorted(t[0] for t in tuples(picks, "Instance")) == [1, 1, 2, 2], "instances are counted from 1")


def said(picks, name):
    return picks.GetFieldData().GetAbstractArray(name).GetValue(0)


def answer():
    """In lines, as it stands in the view."""
    return planning.GetOutputDataObject(3).GetColumnByName("Text").GetValue(0)


report, advice = said(picks, "PickReport"), said(picks, "PickAdvice")
check(report == "0 of 2 copies can be picked, by 0 of 4 picks; the others: 2 too near to another copy.", report)
check(advice.startswith("Copies too near to another copy: pick the other copies first"), advice)
check(answer().replace("\n", " ") == f"{report} {advice}" and max(map(len, answer().split("\n"))) <= 66, answer())
planning.SetMaximumTilt(0)
planning.SetInputDataObject(2, cloud([(0, 0, 0)], Transform=[(1, 0, 0, 0, 0, 0, -1, 0, 0, 1, 0, 0, 0, 0, 0, 1)], Width=[20]))
slanted = run(planning)
check("2 without a grasp from above" in said(slanted, "PickReport"), said(slanted, "PickReport"))
check("raise the maximum tilt" in said(slanted, "PickAdvice"), said(slanted, "PickAdvice"))
planning.SetMaximumTilt(60)
planning.SetInputDataObject(2, above)

planning.SetSafetyMargin(0.5)
picks = run(planning)
check(said(picks, "PickAdvice") == "" and answer() == said(picks, "PickReport"), "where all can be picked nothing is advised")
check([t[0] for t in tuples(picks, "Possible")] == [1, 1, 0, 0], "with less margin both can be picked")
check([t[0] for t in tuples(picks, "Rank")] == [1, 2, 3, 4], "ranks")
check(abs(tuples(picks, "Clearance")[0][0] - 1.0) < 1e-3, tuples(picks, "Clearance"))
check(abs(tuples(picks, "Reach")[0][0] - 90.0) < 1e-6, tuples(picks, "Reach"))
check(tuples(picks, "Transform")[0][11] == 490.0, "the grasp is where the pose is")
gripper = planning.GetOutputDataObject(1)
check(gripper.GetNumberOfCells() == 2 * 36, "a gripper of three boxes at the best pick of each copy")
check(names(picks, "Label") == ["pick 1", "pick 2", "", ""], f"labels where a gripper is: {names(picks, 'Label')}")
check(set(gripper.GetCellData().GetArray("Possible").GetValue(i) for i in range(72)) == {1}, "both are possible")
check(planning.GetOutputDataObject(2).GetNumberOfCells() == 60, "the bin's floor and walls")
planning.SetShownGrippers(planning.AllPicks)
picks = run(planning)
check(planning.GetOutputDataObject(1).GetNumberOfCells() == 4 * 36, "a gripper at each pick")
check(names(picks, "Label") == ["pick 1", "pick 2", "tilted", "tilted"], f"labels at each pick: {names(picks, 'Label')}")

# A bin that is found, and without one.
alone = connect(vtkMEAMPickPlanning(), poses(at(0, 0)), PART, above, scan())
picks = run(alone)
check(tuples(picks, "Possible")[0][0] == 1, names(picks))
check(abs(tuples(picks, "Reach")[0][0] - 50.0) < 3.0, "from the rim that was found")
check(alone.GetOutputDataObject(2).GetNumberOfCells() == 60, "the bin that was found")
alone.SetBinToNone()
check(tuples(run(alone), "Possible")[0][0] == 1, "the floor is something measured")
check(alone.GetOutputDataObject(2).GetNumberOfCells() == 0, "no bin")

# A part that looks the same when it is turned by 180 degrees about its x: the grasp from the side may come from the other.
turned = connect(vtkMEAMPickPlanning(), poses(at(0, 0)), PART,
                 cloud([(0, 0, 0)], Transform=[(1, 0, 0, 0, 0, -1, 0, 0, 0, 0, -1, 0, 0, 0, 0, 1)], Width=[20]))
turned.SetBinToNone()
check(names(run(turned)) == ["tilted by 180 degrees"], names(run(turned)))
symmetric = vtkPolyData()
symmetric.ShallowCopy(PART)
set_fields(symmetric, SymmetriesDiscrete=(1, 0, 0, 0, 0, -1, 0, 0, 0, 0, -1, 0, 0, 0, 0, 1))
turned.SetInputDataObject(1, symmetric)
check(names(run(turned)) == ["possible"], names(run(turned)))

# A gripper of any shape, a cup, and no poses.
finger = connect(vtkMEAMPickPlanning(), poses(at(0, 0)), PART, above)
finger.SetInputDataObject(4, box(4, 4, 50, (-2, -2, -70)))
finger.SetBinToNone()
check(names(run(finger))[0] == "possible", names(run(finger)))
finger.SetInputDataObject(4, box(4, 4, 50, (-2, -2, -50)))
check("collides with the part itself" in names(run(finger)), names(run(finger)))
cup = connect(vtkMEAMPickPlanning(), poses(at(0, 0)), PART,
              cloud([(0, 0, -10)], Transform=[(1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, -10.2, 0, 0, 0, 1)], Kind=[1]))
cup.SetBinToNone()
check(names(run(cup)) == ["the grasp is for another kind of gripper"], names(run(cup)))
cup.SetGripperToSuctionCup()
check(names(run(cup)) == ["possible"], names(run(cup)))
check(run(connect(vtkMEAMPickPlanning(), poses(), PART, above, scan())).GetNumberOfPoints() == 0, "no poses, no picks")

# In the robot's frame.
with tempfile.TemporaryDirectory() as folder:
    file = os.path.join(folder, "robot.yaml")
    with open(file, "w", encoding="utf-8") as text:
        text.write("""%YAML:1.0
---
T_robot_camera: !!opencv-matrix
   rows: 4
   cols: 4
   dt: d
   data: [ 1., 0., 0., 1000., 0., -1., 0., 0., 0., 0., -1., 800., 0., 0., 0., 1. ]
""")
    alone.SetRobotFrameFile(file)
    check(close(tuples(run(alone), "RobotTransform")[0], (1, 0, 0, 1000, 0, -1, 0, 0, 0, 0, -1, 310, 0, 0, 0, 1), 1e-6),
          tuples(run(alone), "RobotTransform"))
    alone.SetRobotFrameFile(file + "x")
    fails(alone, "robot.yamlx")
    alone.SetRobotFrameFile(None)

for name, value, *words in (("MaximumTilt", 500.0, "maximum tilt", "0 to 180 degrees", "500"),
                            ("MinimumProbability", 1.5, "minimum probability", "0 to 1", "1.5"),
                            ("MaximumCovered", -1.0, "maximum covered", "0 to 100 %", "-1"),
                            ("SafetyMargin", -2.0, "safety margin", "0 mm or more", "-2"),
                            ("WayIn", -80.0, "way in", "0 mm or more", "-80"),
                            ("TurnStep", 0.0, "turn step", "1 to 360 degrees", "not 0"),
                            ("Tolerance", -1.0, "tolerance", "0 mm or more", "-1")):
    wrong = connect(vtkMEAMPickPlanning(), found, PART, above, **{name: value})
    wrong.SetBinToNone()
    fails(wrong, *words)
fails(connect(vtkMEAMPickPlanning(), found), "Part", "Grasps")
fails(connect(vtkMEAMPickPlanning(), found, PART, above), "organized scan", "Bin")
fails(connect(vtkMEAMPickPlanning(), found, PART, PART, scan()), "Transform", "GraspDefinition")
fails(connect(vtkMEAMPickPlanning(), found, PART, vtkPolyData(), scan()), "no grasp")
free = cloud([(0, 0, 0)], Transform=[(1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1)], FreeTurn=[1])
fails(connect(vtkMEAMPickPlanning(), free, PART, above, scan()), "poses are grasps")
far = connect(vtkMEAMPickPlanning(), found, PART, cloud([(0, 0, 0)], Transform=[at(900, 0)]), scan())
fails(far, "outside the part", "mm")
flat = connect(vtkMEAMPickPlanning(), found, PART, above)
flat.SetBinToGiven()
flat.SetBinSize(300, 0, 100)
fails(flat, "bin", "larger than 0")
flat.SetBinSize(10, 10, 100)
fails(flat, "does not go into the bin")
flat.SetOpening(-1)
fails(flat, "gripper's opening", "-1")
prints(planning, "Gripper", "Opening", "Bin", "BinPosition", "BinSize", "SafetyMargin", "WayIn", "MaximumTilt", "Tolerance")
