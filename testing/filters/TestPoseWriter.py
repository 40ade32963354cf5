# SPDX-License-Identifier: BSD-3-Clause
"""Poses in every form, read again; what cannot be written leaves nothing behind."""
import json
import os

from ppfmeam.filters import vtkMEAMPoseReader, vtkMEAMPoseWriter
from meamtest import Errors, Folder, box, check, cloud, connect, poses, run, set_fields, tuples, write

QUARTER = (0, -1, 0, 1.5, 1, 0, 0, -2, 0, 0, 1, 0.1, 0, 0, 0, 1)
IDENTITY = (1, 0, 0, 7, 0, 1, 0, 8, 0, 0, 1, 9, 0, 0, 0, 1)
path = Folder()
text = path.text


def reader(name):
    return connect(vtkMEAMPoseReader(), FileName=path(name))


def writer(data, name, **properties):
    return connect(vtkMEAMPoseWriter(), data, FileName=path(name), **properties)


def refuses(algorithm, *words):
    errors = Errors(algorithm)
    done = algorithm.Write()
    check(not done and all(w in str(errors) for w in words), f"Write() returned {done} and said: {errors}")


# Written as matrices, read again.
data = set_fields(poses(QUARTER, IDENTITY), SecondsTotal=0.25)
check(writer(data, "poses.txt").Write() == 1, "Write() succeeds")
read = run(reader("poses.txt"))
check(tuples(read, "Transform") == [QUARTER, IDENTITY], "the same matrices come back")

# The other forms. Arrays that are not there are left out.
check(writer(data, "poses.csv", SceneId=3, ImageId=4, ObjectId=5).Write() == 1, "Write() succeeds")
check(text("poses.csv") == "scene_id,im_id,obj_id,score,R,t,time\n"
      "3,4,5,0,0 -1 0 1 0 0 0 0 1,1.5 -2 0.1,0.25\n3,4,5,0,1 0 0 0 1 0 0 0 1,7 8 9,0.25\n", text("poses.csv"))
typed = cloud([(0, 0, 0)] * 2, Transform=[QUARTER, IDENTITY], PartId=[1, 0])
check(writer(typed, "typed.csv").Write() == 1, "Write() succeeds")
check([row.split(",")[2] for row in text("typed.csv").splitlines()[1:]] == ["2", "1"], text("typed.csv"))
full = cloud([(1.5, -2, 0.1)], Transform=[QUARTER], Score=[0.75], Votes=[12], ViewId=[2], VisibleFraction=[0.5])
check(writer(full, "poses.json", Time=2.0).Write() == 1, "Write() succeeds")
row, = json.loads(text("poses.json"))["poses"]
check((row["rank"], row["score"], row["votes"], row["view"], row["visible_fraction"], row["time"])
      == (1, 0.75, 12, 2, 0.5, 2), f"JSON has {row}")
check(row["translation"] == [1.5, -2, 0.1] and row["matrix"][0] == [0, -1, 0, 1.5], f"JSON has {row}")
check(writer(data, "bare.json").Write() == 1 and "votes" not in json.loads(text("bare.json"))["poses"][0],
      "what is not known is left out")
first = writer(data, "first.dat", MaximumNumberOfPoses=1)
first.SetFormatToMatrices()
check(first.Write() == 1 and tuples(run(reader("first.dat")), "Transform") == [QUARTER], "the best pose alone")
check(writer(poses(), "empty.csv").Write() == 1 and text("empty.csv").count("\n") == 1, "no poses: only the header")

# Detections of ROS 2, in metres: the covariance and the box with the part's extent, and nothing of them without.
fit = dict(Residual=[0.1], Iterations=[3], Covariance=[[0] * 21 + [4] + [0] * 14], ConstrainedDegreesOfFreedom=[6],
           ConstrainedAxes=[[1] * 6])
refined = cloud([(1.5, -2, 0.1)], Transform=[QUARTER], Score=[0.75], **fit)
check(writer(refined, "bare.detections.json").Write() == 1, "Write() succeeds")
detection, = json.loads(text("bare.detections.json"))["detections"]
check(detection["results"][0]["pose"]["covariance"] == [0] * 36 and detection["bbox"]["size"]["x"] == 0, f"{detection}")
set_fields(refined, PartBounds=(0, 20, 0, 40, 0, 60), PartMiddle=(10, 20, 30))
check(writer(refined, "poses.detections.json", ObjectId=4, FrameId="sensor", Stamp=2.5).Write() == 1, "Write() succeeds")
message = json.loads(text("poses.detections.json"))
check(message["header"] == {"stamp": {"sec": 2, "nanosec": 500000000}, "frame_id": "sensor"}, f"{message['header']}")
detection, = message["detections"]
result, = detection["results"]
check(result["hypothesis"] == {"class_id": "4", "score": 0.75}, f"{result}")
check(result["pose"]["pose"]["position"] == {"x": 0.0015, "y": -0.002, "z": 0.0001}, f"{result}")
check(abs(result["pose"]["covariance"][0] - 4e-6) < 1e-15 and detection["bbox"]["size"] == {"x": 0.02, "y": 0.04, "z": 0.06},
      f"{detection}")
refuses(writer(refined, "late.detections.json", Stamp=-1), "stamp")

# In the robot's frame: a quarter turn and a shift after that of the pose; the covariance turns with it.
path("robot.json", json.dumps({"T_robot_camera": [[0, -1, 0, 10], [1, 0, 0, 20], [0, 0, 1, 30], [0, 0, 0, 1]]}))
check(writer(data, "robot.txt", RobotFrameFile=path("robot.json")).Write() == 1, "Write() succeeds")
moved = tuples(run(reader("robot.txt")), "Transform")[0]
check(all(abs(a - b) < 1e-12 for a, b in zip(moved, (-1, 0, 0, 12, 0, -1, 0, 21.5, 0, 0, 1, 30.1, 0, 0, 0, 1))), f"{moved}")
check(writer(refined, "robot.detections.json", RobotFrameFile=path("robot.json")).Write() == 1, "Write() succeeds")
covariance = json.loads(text("robot.detections.json"))["detections"][0]["results"][0]["pose"]["covariance"]
check(abs(covariance[7] - 4e-6) < 1e-15 and abs(covariance[0]) < 1e-15, f"{covariance}")
refuses(writer(data, "robot.txt", RobotFrameFile=path("none.json")), "none.json")

# What goes to a file comes back, whatever its form; a rank that poses have, as after a threshold, is kept.
known = dict(Score=[0.5, 0.25], Probability=[0.9, 0.4], Certainty=[1, 0.5], VisibleFraction=[0.5, 0.75], Votes=[7, 3],
             ViewId=[2, 3], Rank=[2, 5])
data = set_fields(cloud([(0, 0, 0)] * 2, Transform=[QUARTER, IDENTITY], **known), SecondsTotal=0.25)
for name in ("all.bop", "all.json", "all.poses", "all.csv", "all.txt"):
    check(writer(data, name, SceneId=3, ImageId=4, ObjectId=5).Write() == 1, f"{name} is written")
    check(vtkMEAMPoseReader().CanReadFile(path(name)) == 1, f"{name} can be read")
    read = run(reader(name))
    check(tuples(read, "Transform") == [QUARTER, IDENTITY], f"{name}: the same poses")
    if name.endswith(("bop", "csv", "json")):
        check([tuples(read, key)[1] for key in ("SceneId", "ImageId", "ObjectId")] == [(3,), (4,), (5,)], f"{name}: of what")
        check(tuples(read, "Score") == [(0.9,), (0.4,)], f"{name}: the score is the probability")
for key in ("Probability", "Certainty", "VisibleFraction", "Votes", "ViewId", "Rank"):
    check([v for v, in tuples(run(reader("all.json")), key)] == known[key], f"JSON loses {key}")

# The scene and the image are those of the poses, each pose's or all poses', unless they are given.
check(writer(run(reader("all.bop")), "same.bop").Write() == 1 and text("same.bop").splitlines()[1].startswith("3,4,1,"), text("same.bop"))
check(writer(set_fields(data, SceneId=8, ImageId=9), "fields.bop").Write() == 1 and text("fields.bop").splitlines()[1].startswith("8,9,1,"),
      text("fields.bop"))
check(writer(set_fields(data, SceneId=8, ImageId=9), "given.bop", SceneId=0).Write() == 1 and
      text("given.bop").splitlines()[1].startswith("0,9,1,"), text("given.bop"))

# What a file does not know is not there, or is not a number where another pose of the file has it; the score then counts.
UNKNOWN = ("PlaceProbability", "Probability", "Certainty", "VisibleFraction", "Votes", "Evidence")
for name in ("all.bop", "all.txt"):
    read = run(reader(name))
    check(not any(read.GetPointData().HasArray(key) for key in UNKNOWN), f"{name} knows more than it has")
    check(writer(read, "again.json").Write() == 1 and not {"probability", "place_probability", "certainty", "visible_fraction"}
          & set(json.loads(text("again.json"))["poses"][0]), f"{name}: {text('again.json')}")
content = json.loads(text("all.json"))
del content["poses"][1]["probability"]
write(path("some.json"), json.dumps(content))
read = run(reader("some.json"))
(first,), (second,) = tuples(read, "Probability")
check(first == 0.9 and second != second, f"{first}, {second}")
check(writer(read, "again.csv").Write() == 1 and [row.split(",")[3] for row in text("again.csv").splitlines()[1:]] == ["0.9", "0.4"],
      "the score of a pose without a probability")

# What cannot be written leaves the old file, and no other.
before = sorted(os.listdir(path.name))
refuses(writer(data, "poses.xyz"), "poses.xyz", ".csv", "set Format")
refuses(writer(box(1, 1, 1), "poses.csv"), "Transform")
refuses(writer(poses((2,) + QUARTER[1:]), "poses.csv"), "not a rotation")
refuses(writer(data, "no/such/folder.csv"), "folder.csv")
refuses(vtkMEAMPoseWriter())
nameless = connect(vtkMEAMPoseWriter(), data)
refuses(nameless, "No file")
check(sorted(os.listdir(path.name)) == before, "no file was added")
check(text("poses.csv").count("\n") == 3, "the old file is still there")
