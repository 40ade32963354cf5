#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Runs the method on a dataset with true poses and prints how many it finds.

tohoku: the Tohoku University 6D Pose Estimation Dataset (simulation), DIR/Part_P/{Part_P.STL, Scenes, Results}.
A pose is right when a true one is within 10 % of the part's diameter and 5 degrees. Rates in %:
  paper   right poses / poses that came out (duplicates count)
  strict  right poses / poses asked for: each true instance counts once, a missing pose is wrong
  top1    scenes whose first pose is right
  recall, AP  (average precision) of all poses that come out, over instances that are at least half visible
Times are the median over the scenes, without reading files and training.
"""
import argparse
import csv
import os
import statistics
import sys

from vtkmodules.vtkCommonDataModel import vtkPolyData

from ppfmeam import filters, scripting

# mm. Part 3's STL is in another frame than its true poses.
OFFSETS = {3: (-20.9645, -17.4974, -9.3144)}
FIGURES = {"paper": "PaperRate", "strict": "StrictRate", "top1": "Top1Rate", "recall": "Recall",
           "AP": "AveragePrecision", "mm": "MedianTranslationError", "deg": "MedianRotationError",
           "axis_deg": "MedianAxisError", "roll_deg": "MedianRollError", "mean_mm": "MeanTranslationError",
           "mean_deg": "MeanRotationError"}
STAGES = scripting.STAGES[2:-1]


def numbers(text):
    """1,2,5-7 as a list."""
    result = []
    for item in text.split(","):
        first, _, last = item.partition("-")
        result += range(int(first), int(last or first) + 1)
    return result


def with_visibility(truth, model, edges, surface):
    """The true poses with the share of each instance that nothing hides."""
    tangents = filters.vtkMEAMTangentEstimation()
    tangents.SetInputDataObject(edges)
    tangents.SetInputDataObject(1, model)
    verification = filters.vtkMEAMPoseVerification()
    for port, data in enumerate((truth, model, scripting.update(tangents).GetOutputDataObject(0), surface)):
        verification.SetInputDataObject(port, data)
    verification.SetMaximumNumberOfPoses(0)
    verification.SetClusterDistance(1e-6)  # every pose stays
    return scripting.update(verification).GetOutput()


def run_part(part, options):
    """Trains, runs every scene and returns the row of the table, and how many scenes failed."""
    folder = os.path.join(options.folder, f"Part_{part}")
    mesh = scripting.read_mesh(os.path.join(folder, f"Part_{part}.STL"), OFFSETS.get(part, (0, 0, 0)))
    model = scripting.train(mesh, options.preset)
    estimation = filters.vtkMEAMPoseEstimation()
    estimation.SetInputDataObject(model)
    scripting.set_choice(estimation, "Preset", options.preset)
    estimation.SetMaximumNumberOfPoses(0)  # those beyond the poses asked for matter for recall and AP
    estimation.SetNumberOfThreads(options.threads)
    evaluation = filters.vtkMEAMPoseEvaluation()
    evaluation.SetDiameter(scripting.field(model, "Diameter"))
    evaluation.SetPosesAskedFor(options.poses)
    evaluation.SetInputDataObject(2, model)  # its symmetries
    times, failed = [], 0
    if options.out:
        os.makedirs(os.path.join(options.out, f"Part_{part}"), exist_ok=True)
    for scene in options.scenes:
        out = options.out and os.path.join(options.out, f"Part_{part}", f"trans{scene}.txt")
        if out and os.path.exists(out):
            os.remove(out)  # of an earlier run
        truth, poses = vtkPolyData(), vtkPolyData()
        try:
            results = os.path.join(folder, "Results", f"trans{scene}.txt")
            truth = scripting.read_with(filters.vtkMEAMPoseReader(), results)
            surface = scripting.read(os.path.join(folder, "Scenes", f"Scene{scene}.pcd"))
            edges = scripting.read(os.path.join(folder, "Scenes", f"Scene_boundary{scene}.pcd"))
            estimation.SetInputDataObject(1, surface)
            estimation.SetInputDataObject(2, edges)
            poses.ShallowCopy(scripting.update(estimation).GetOutput())
            times.append({stage: 1000 * scripting.field(poses, "Seconds" + stage) for stage in scripting.STAGES})
            truth = with_visibility(truth, model, edges, surface)
            if out:
                scripting.write_poses(poses, out, "Matrices", MaximumNumberOfPoses=options.poses)
        except scripting.Failure as failure:
            print(f"part {part}, scene {scene}: {failure}", file=sys.stderr)
            failed += 1
        evaluation.AddInputDataObject(0, poses)
        evaluation.AddInputDataObject(1, truth)
    table = scripting.update(evaluation).GetOutput()
    row = {"part": part, "scenes": len(options.scenes), "poses": int(scripting.field(table, "Poses"))}
    row.update((name, scripting.field(table, array)) for name, array in FIGURES.items())
    row["ms"] = statistics.median(t["Total"] - t["Training"] for t in times) if times else float("nan")
    row.update((f"{stage}_ms", statistics.median(t[stage] for t in times) if times else float("nan"))
               for stage in STAGES)
    return row, failed


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("dataset", choices=("tohoku",))
    parser.add_argument("folder", metavar="DIR", help="where the dataset is")
    parser.add_argument("--parts", type=numbers, default=[1, 2, 3], help="such as 1,3 (default: 1,2,3)")
    parser.add_argument("--scenes", type=numbers, default=list(range(20)), help="such as 0-4,7 (default: 0-19)")
    parser.add_argument("--poses", type=scripting.count, default=5, help="poses wanted of a scene (default: %(default)s)")
    parser.add_argument("--method", choices=("meam",), default="meam", help="(default: %(default)s)")
    parser.add_argument("--preset", choices=("paper", "recommended"), default="recommended",
                        help="parameters of all steps (default: %(default)s)")
    parser.add_argument("--threads", type=scripting.count, default=0, help="threads to work with; 0: all cores (default)")
    parser.add_argument("--out", metavar="OUTDIR",
                        help="write OUTDIR/Part_P/transI.txt, 4x4 matrices best first, and OUTDIR/tohoku.csv")
    options = parser.parse_args()
    rows, failures = [], 0
    print("part  scenes  poses   paper  strict    top1  recall      AP  median error: mm  degrees (axis  roll)  ms/scene")
    for part in options.parts:
        row, failed = run_part(part, options)
        rows.append(row)
        failures += failed
        print("{part:4d}  {scenes:6d}  {poses:5d}  {paper:6.1f}  {strict:6.1f}  {top1:6.1f}  {recall:6.1f}  {AP:6.1f}"
              "  {mm:16.3f}  {deg:7.3f} ({axis_deg:.3f} {roll_deg:.3f})  {ms:8.0f}".format(**row), flush=True)
    print("\nmedian ms of each stage\npart  " + "  ".join(f"{stage.lower():>12}" for stage in STAGES))
    for row in rows:
        print(f"{row['part']:4d}  " + "  ".join(f"{row[stage + '_ms']:12.0f}" for stage in STAGES))
    if options.out:
        with open(os.path.join(options.out, "tohoku.csv"), "w", newline="") as file:
            writer = csv.DictWriter(file, list(rows[0]))
            writer.writeheader()
            writer.writerows(rows)
    if failures:
        raise scripting.Failure(f"{failures} scenes failed; they count as scenes in which nothing was found")


scripting.run(main)
