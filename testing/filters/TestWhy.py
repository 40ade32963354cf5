# SPDX-License-Identifier: BSD-3-Clause
"""`ppfmeam why` and ppfmeam.why(): of a true pose, of all, of a picked point; bad input."""
import json

import numpy
from vtkmodules.util.numpy_support import vtk_to_numpy

import ppfmeam
from meamtest import check, read, tuples
from scripttest import H, W, refuses, scan_of_bin, works, write_pcd, write_stl

scan, truth, mesh = scan_of_bin()
write_stl("part.stl", mesh)
columns = numpy.column_stack((vtk_to_numpy(scan.GetPoints().GetData()),
                              vtk_to_numpy(scan.GetPointData().GetArray("Intensity"))))
write_pcd("scan.pcd", columns, W, H, "x y z intensity")
transforms = numpy.array(tuples(truth, "Transform")).reshape(-1, 4, 4)
numpy.savetxt("truth.txt", transforms.reshape(-1, 4))
works("train.py", "--cad", "part.stl", "--out", "part.meam")
lines = works("why.py", "part.meam", "scan.pcd", "--truth", "truth.txt", "--poses", "0").splitlines()
check(len(lines) == len(transforms) + 1 and lines[-1].endswith(f"of {len(transforms)} were found"), f"{lines}")
stages = [line[6:32].strip() for line in lines[:-1]]
found = stages.count("found")
check(found >= 2 and lines[-1].startswith(f"{found} of"), f"{lines}")
row = stages.index("found")
arguments = ("why.py", "part.meam", "scan.pcd", "--pose", f"truth.txt:{row + 1}", "--poses", "0")
brief, report = works(*arguments, "--json", "why.json"), works(*arguments, "--more").splitlines()
check(brief.startswith("Found as rank ") and "Most for it: " in brief and brief.count("\n") == 1 and report[0] + "\n" == brief,
      f"the answer comes first: {brief}")
by_rank = works("why.py", "part.meam", "scan.pcd", "--rank", "1", "--poses", "0")
check(by_rank.startswith("Found as rank 1, ") and "Most for it: " in by_rank, f"of a pose that came out: {by_rank}")
refuses("there is no pose of rank 99", "why.py", "part.meam", "scan.pcd", "--rank", "99")
check(report[1].startswith("For it, ") and any(line.startswith("voting ") for line in report), f"{report}")
written = json.loads(read("why.json"))
check(" ".join(filter(None, (written[name] for name in ("verdict", "main_reason", "advice")))) + "\n" == brief and len(written["numbers"]) > 10 and written["lost_in"] == "",
      f"{written}")
few = works("why.py", "part.meam", "scan.pcd", "--truth", "truth.txt", "--poses", "1")
check(few.count("only the best 1 are wanted. Raise --poses to ") >= found - 1, few)

# In Python; the point is one of the part's that the scan shows.
model = ppfmeam.load("part.meam")
diagnosis = ppfmeam.why(model, "scan.pcd", pose=transforms[row], poses=0)
check(diagnosis.rank >= 1 and diagnosis.lost_in == "" and diagnosis.verdict.startswith("Found"), diagnosis.verdict)
check(diagnosis.reasons.startswith("For it, in the logarithm of the odds: ") and "\nAgainst it: " in diagnosis.reasons,
      diagnosis.reasons)
check(len(diagnosis.points) == len(diagnosis.states) > 50, "points and states")
on = diagnosis.points[diagnosis.states.index("explained")]
report = works("why.py", "part.meam", "--at", *map(str, on), "--poses", "0", "scan.pcd").splitlines()
check(report[0].startswith(f"Found as rank {diagnosis.rank},"), f"{report}")
# Of Detections: of the pose that came out, by its rank and by a point on it; the surface that goes on beside a pose that is shifted.
detections = ppfmeam.detect(model, "scan.pcd", poses=2)
for k in range(2):
    told = detections.why(rank=k + 1)
    again = detections.why(at=told.points[told.states.index("explained")])
    by_translation = ppfmeam.why(model, "scan.pcd", at=numpy.round(detections.poses[k, :3, 3], 1), poses=2)
    check(all(each.rank == k + 1 and numpy.allclose(each.pose, detections.poses[k], atol=1e-6) for each in (told, again, by_translation)),
          f"{k + 1}: {told.verdict} {again.verdict} {by_translation.verdict}")
for arguments in ({}, {"rank": 1, "at": on}, {"rank": 3}):
    try:
        detections.why(**arguments)
        check(False, f"{arguments} are refused")
    except ppfmeam.Error:
        pass
shifted = transforms[row].copy()
shifted[:3, 3] += 0.1 * model.diameter * shifted[:3, 0]
numpy.savetxt("shifted.txt", shifted)
beside = ppfmeam.why(model, "scan.pcd", pose=shifted).unexplained
check(beside.shape[1] == 3 and len(beside) > len(diagnosis.unexplained) + 20, f"{len(beside)} and {len(diagnosis.unexplained)} unexplained")
works("why.py", "part.meam", "scan.pcd", "--pose", "shifted.txt", "--json", "beside.json")
check(numpy.shape(json.loads(read("beside.json"))["unexplained"])[1:] in ((3,), ()), "unexplained points in JSON")
nothing = works("why.py", "part.meam", "scan.pcd", "--at", "0", "0", "5")
check(nothing.startswith("No part there") and nothing.endswith("Take a point of the scan that lies on the part.\n"), nothing)
floor = numpy.zeros_like(columns)
floor[:, 0], floor[:, 1], floor[:, 2] = numpy.arange(W * H) % W - W / 2, numpy.arange(W * H) // W - H / 2, 600
write_pcd("floor.pcd", floor, W, H, "x y z intensity")
nothing = works("why.py", "part.meam", "floor.pcd", "--at", "0", "0", "600")
check(nothing.startswith("Nothing was found: the scan shows no part. The scan shows no edges"), nothing)
for arguments in ({}, {"at": (0, 0, 1), "pose": transforms[0]}, {"at": (1, 2)}, {"pose": numpy.eye(3)}):
    try:
        ppfmeam.why(model, "scan.pcd", **arguments)
        check(False, f"{arguments} are refused")
    except ppfmeam.Error:
        pass

refuses("no row 99", "why.py", "part.meam", "scan.pcd", "--pose", "truth.txt:99")
refuses("nowhere.txt", "why.py", "part.meam", "scan.pcd", "--truth", "nowhere.txt")
refuses("nowhere.pcd", "why.py", "part.meam", "nowhere.pcd", "--at", "0", "0", "1")
refuses("nopart.stl", "why.py", "nopart.stl", "scan.pcd", "--at", "0", "0", "1")
