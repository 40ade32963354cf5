# SPDX-License-Identifier: BSD-3-Clause
"""vtkMEAMPickPlanning: possible picks first, the reasons of the others, the gripper and the bin to look at, bad input."""

from meamtest import Folder, box, check, close, cloud, connect, fails, grid, poses, run, set_fields, text, texts, tuples

from vtkmodules.vtkCommonCore import vtkStringArray
from vtkmodules.vtkCommonDataModel import vtkPolyData

from ppfmeam.filters import vtkMEAMPickPlanning

PART = box(20, 40, 20, (-10, -20, -10))


def at(x, y, z=490.0):
    return (1, 0, 0, x, 0, 1, 0, y, 0, 0, 1, z, 0, 0, 0, 1)


def scan():
    """A floor 500 mm away with a rim of 60 mm around 160 x 120 mm, and a block on it."""
    places = []
    for row in range(200):
        for column in range(240):
            x, y = column - 119.5, row - 99.5
            u, v = abs(x), abs(y)
            z = 500.0
            if u < 85 and v < 65 and (u > 80 or v > 60):
                z = 440.0
            if u < 10 and v < 20:
                z = 480.0
            places.append((x, y, z))
    return grid(240, 200, places)


above = cloud([(0, 0, 0), (0, 0, 0)], Transform=[(1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1),
                                                 (1, 0, 0, 0, 0, 0, -1, 0, 0, 1, 0, 0, 0, 0, 0, 1)], Width=[20, 20])
found = poses(at(0, 0), at(32, 0))

planning = connect(vtkMEAMPickPlanning(), found, PART, above, BinPosition=(0, 0, 500), BinSize=(300, 300, 100))
planning.SetBinToGiven()
picks = run(planning)
check(picks.GetNumberOfPoints() == 4, "a pick for each pose and grasp")
check([t[0] for t in tuples(picks, "Possible")] == [0, 0, 0, 0], "the two copies are in each other's way")
check("collides with instance 2" in texts(picks, "Reason") and "collides with instance 1" in texts(picks, "Reason"), texts(picks, "Reason"))
check(sum("tilted by 90 degrees" == name for name in texts(picks, "Reason")) == 2, texts(picks, "Reason"))
check(sorted(t[0] for t in tuples(picks, "Instance")) == [1, 1, 2, 2], "instances are counted from 1")


def answer():
    """In lines, as it stands in the view."""
    return planning.GetOutputDataObject(3).GetColumnByName("Text").GetValue(0)


report, advice = text(picks, "PickReport"), text(picks, "PickAdvice")
check(report == "0 of 2 copies can be picked, by 0 of 4 picks; the others: 2 too near to another copy.", report)
check(advice.startswith("Copies too near to another copy: pick the other copies first"), advice)
check(answer().replace("\n", " ") == f"{report} {advice}" and max(map(len, answer().split("\n"))) <= 66, answer())
planning.SetMaximumTilt(0)
planning.SetInputDataObject(2, cloud([(0, 0, 0)], Transform=[(1, 0, 0, 0, 0, 0, -1, 0, 0, 1, 0, 0, 0, 0, 0, 1)], Width=[20]))
slanted = run(planning)
check("2 without a grasp from above" in text(slanted, "PickReport"), text(slanted, "PickReport"))
check("raise MaximumTilt" in text(slanted, "PickAdvice"), text(slanted, "PickAdvice"))
planning.SetMaximumTilt(60)
planning.SetInputDataObject(2, above)

planning.SetSafetyMargin(0.5)
picks = run(planning)
check(text(picks, "PickAdvice") == "" and answer() == text(picks, "PickReport"), "where all can be picked nothing is advised")
check([t[0] for t in tuples(picks, "Possible")] == [1, 1, 0, 0], "with less margin both can be picked")
check([t[0] for t in tuples(picks, "Rank")] == [1, 2, 3, 4], "ranks")
check(abs(tuples(picks, "Clearance")[0][0] - 1.0) < 1e-3, tuples(picks, "Clearance"))
check(abs(tuples(picks, "Reach")[0][0] - 90.0) < 1e-6, tuples(picks, "Reach"))
check(tuples(picks, "Transform")[0][11] == 490.0, "the grasp is where the pose is")
gripper = planning.GetOutputDataObject(1)
check(gripper.GetNumberOfCells() == 2 * 36, "a gripper of three boxes at the best pick of each copy")
check(texts(picks, "Label") == ["pick 1", "pick 2", "", ""], f"labels where a gripper is: {texts(picks, 'Label')}")
check(set(gripper.GetCellData().GetArray("Possible").GetValue(i) for i in range(72)) == {1}, "both are possible")
check(planning.GetOutputDataObject(2).GetNumberOfCells() == 60, "the bin's floor and walls")


def widths():
    """mm, across the grippers at the first two picks, along y."""
    data = planning.GetOutputDataObject(1)
    ends = [data.GetPoint(k)[1] for k in range(data.GetNumberOfPoints())]
    half = len(ends) // 2
    return [max(of) - min(of) for of in (ends[:half], ends[half:])]


whole = widths()[0]
check(widths()[1] < 0.2 * whole, f"the gripper is thin lines where it is not the best: {widths()}")
for rank, thin in ((2, [0]), (0, [])):
    planning.SetWholeGripper(rank)
    run(planning)
    check([k for k in (0, 1) if widths()[k] < whole - 1e-3] == thin, f"whole at pick {rank}: {widths()}")
planning.SetShownGrippers(planning.AllPicks)
picks = run(planning)
check(planning.GetOutputDataObject(1).GetNumberOfCells() == 4 * 36, "a gripper at each pick")
check(texts(picks, "Label") == ["pick 1", "pick 2", "tilted", "tilted"], f"labels at each pick: {texts(picks, 'Label')}")

# The best of each copy, of poses that are not shown only where it is possible.
planning.SetShownGrippers(planning.BestOfEachInstance)
ranks = vtkStringArray()
ranks.SetName("Label")
for label in ("1: 90 %", ""):
    ranks.InsertNextValue(label)
for margin, labels in ((0.5, ["pick 1", "pick 2"]), (1.5, ["hits 2"])):
    shown = poses(at(0, 0), at(32, 0))
    shown.GetPointData().AddArray(ranks)
    planning.SetInputDataObject(0, shown)
    planning.SetSafetyMargin(margin)
    drawn = [label for label in texts(run(planning), "Label") if label]
    check(drawn == labels, f"with a margin of {margin} mm: {drawn}")

# A bin that is found, and without one.
alone = connect(vtkMEAMPickPlanning(), poses(at(0, 0)), PART, above, scan())
picks = run(alone)
check(tuples(picks, "Possible")[0][0] == 1, texts(picks, "Reason"))
check(abs(tuples(picks, "Reach")[0][0] - 50.0) < 3.0, "from the rim that was found")
check(alone.GetOutputDataObject(2).GetNumberOfCells() == 60, "the bin that was found")
alone.SetBinToNone()
check(tuples(run(alone), "Possible")[0][0] == 1, "the floor is something measured")
check(alone.GetOutputDataObject(2).GetNumberOfCells() == 0, "no bin")

# A part that looks the same when it is turned by 180 degrees about its x: the grasp from the side may come from the other.
turned = connect(vtkMEAMPickPlanning(), poses(at(0, 0)), PART,
                 cloud([(0, 0, 0)], Transform=[(1, 0, 0, 0, 0, -1, 0, 0, 0, 0, -1, 0, 0, 0, 0, 1)], Width=[20]))
turned.SetBinToNone()
check(texts(run(turned), "Reason") == ["tilted by 180 degrees"], texts(run(turned), "Reason"))
symmetric = vtkPolyData()
symmetric.ShallowCopy(PART)
set_fields(symmetric, SymmetriesDiscrete=(1, 0, 0, 0, 0, -1, 0, 0, 0, 0, -1, 0, 0, 0, 0, 1))
turned.SetInputDataObject(1, symmetric)
check(texts(run(turned), "Reason") == ["possible"], texts(run(turned), "Reason"))

# A gripper of any shape, a cup, and no poses.
finger = connect(vtkMEAMPickPlanning(), poses(at(0, 0)), PART, above, None, box(4, 4, 50, (-2, -2, -70)))
finger.SetBinToNone()
check(texts(run(finger), "Reason")[0] == "possible", texts(run(finger), "Reason"))
finger.SetInputDataObject(4, box(4, 4, 50, (-2, -2, -50)))
check("collides with the part itself" in texts(run(finger), "Reason"), texts(run(finger), "Reason"))
cup = connect(vtkMEAMPickPlanning(), poses(at(0, 0)), PART,
              cloud([(0, 0, -10)], Transform=[(1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, -10.2, 0, 0, 0, 1)], Kind=[1]))
cup.SetBinToNone()
check(texts(run(cup), "Reason") == ["the grasp is for another kind of gripper"], texts(run(cup), "Reason"))
cup.SetGripperToSuctionCup()
check(texts(run(cup), "Reason") == ["possible"], texts(run(cup), "Reason"))
check(run(connect(vtkMEAMPickPlanning(), poses(), PART, above, scan())).GetNumberOfPoints() == 0, "no poses, no picks")

# In the robot's frame.
folder = Folder()
file = folder("robot.yaml", """%YAML:1.0
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
flat = connect(vtkMEAMPickPlanning(), found, PART, above, BinSize=(300, 0, 100))
flat.SetBinToGiven()
fails(flat, "bin", "larger than 0")
flat.SetBinSize(10, 10, 100)
fails(flat, "does not go into the bin")
flat.SetOpening(-1)
fails(flat, "gripper's opening", "-1")
