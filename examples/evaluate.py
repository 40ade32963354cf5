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
import sys

from vtkmodules.vtkCommonDataModel import vtkPolyData

from ppfmeam import evaluation, scripting


def run_part(part, options):
    """Trains, runs every scene and returns the row of the table, and how many scenes failed."""
    model = scripting.train(evaluation.tohoku_mesh(options.folder, part), options.preset)
    run = evaluation.Evaluation(model, options.preset, options.poses, options.threads)
    failed = 0
    if options.out:
        os.makedirs(os.path.join(options.out, f"Part_{part}"), exist_ok=True)
    for scene in options.scenes:
        out = options.out and os.path.join(options.out, f"Part_{part}", f"trans{scene}.txt")
        if out and os.path.exists(out):
            os.remove(out)  # of an earlier run
        truth, poses = vtkPolyData(), vtkPolyData()
        try:
            truth = evaluation.tohoku_truth(options.folder, part, scene)
            surface, edges = evaluation.tohoku_clouds(options.folder, part, scene)
            poses = run.find(surface, edges)
            truth = evaluation.with_visibility(truth, model, edges, surface)
            if out:
                scripting.write_poses(poses, out, "Matrices", MaximumNumberOfPoses=options.poses)
        except scripting.Failure as failure:
            print(f"part {part}, scene {scene}: {failure}", file=sys.stderr)
            failed += 1
        run.add(poses, truth)
    return {"part": part, "scenes": len(options.scenes), **run.figures()}, failed


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("dataset", choices=("tohoku",))
    parser.add_argument("folder", metavar="DIR", help="where the dataset is")
    parser.add_argument("--parts", type=evaluation.numbers, default=[1, 2, 3], help="such as 1,3 (default: 1,2,3)")
    parser.add_argument("--scenes", type=evaluation.numbers, default=list(range(20)), help="such as 0-4,7 (default: 0-19)")
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
    print("\nmedian ms of each stage\npart  " + "  ".join(f"{stage.lower():>12}" for stage in evaluation.STAGES))
    for row in rows:
        print(f"{row['part']:4d}  " + "  ".join(f"{row[stage + '_ms']:12.0f}" for stage in evaluation.STAGES))
    if options.out:
        with open(os.path.join(options.out, "tohoku.csv"), "w", newline="") as file:
            writer = csv.DictWriter(file, list(rows[0]))
            writer.writeheader()
            writer.writerows(rows)
    if failures:
        raise scripting.Failure(f"{failures} scenes failed; they count as scenes in which nothing was found")


scripting.run(main)
