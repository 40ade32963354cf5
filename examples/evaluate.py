#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Runs the method on a dataset with true poses and prints how many it finds.

tohoku: the Tohoku University 6D Pose Estimation Dataset (simulation), DIR/Part_P/{Part_P.STL, Scenes, Results}.
bop: a dataset in the form of the BOP benchmark, DIR/{models, test/SSSSSS}, such as simulate.py writes; without true
poses only the results are written.
A pose is right when a true one is within 10 % of the part's diameter and 5 degrees. Rates in %:
  paper   right poses / poses that came out (duplicates count)
  strict  right poses / poses asked for: each true instance counts once, a missing pose is wrong
  top1    scenes whose first pose is right
  recall, AP  (average precision) of all poses that come out, over instances that are at least half visible
  ADD, ADI    recall at a tenth of the diameter, over instances that are at least a tenth visible, by as many poses
  MSSD, MSPD, VSD  of the benchmark: recall over its ten thresholds; AR is the mean of the three. These are of all poses
  that come out; the file holds --poses of each object
Times are the median over the scenes, without reading files and training.
"""
import argparse
import csv
import os
import sys

from vtkmodules.vtkCommonDataModel import vtkPolyData

from ppfmeam import dataset, evaluation, scripting

COLUMNS = ("scenes  poses   paper  strict    top1  recall      AP  median error: mm  degrees (axis  roll)  ms/scene")
ROW = ("{part:4d}  {scenes:6d}  {poses:5d}  {paper:6.1f}  {strict:6.1f}  {top1:6.1f}  {recall:6.1f}  {AP:6.1f}"
       "  {mm:16.3f}  {deg:7.3f} ({axis_deg:.3f} {roll_deg:.3f})  {ms:8.0f}")


def run_part(part, options):
    """Trains, runs every scene and returns the row of the table, and how many scenes failed."""
    model = scripting.train(evaluation.tohoku_mesh(options.folder, part), options.preset, options.features)
    run = evaluation.Evaluation(
        model, options.preset, options.poses, options.threads, options.references, options.features)
    deviation = options.noise(scripting.field(model, "Diameter"))
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
            poses = run.find(*evaluation.with_noise((surface, edges), deviation, scene))
            truth = evaluation.with_visibility(truth, model, edges, surface)
            if out:
                scripting.write_poses(poses, out, "Matrices", MaximumNumberOfPoses=options.poses)
        except scripting.Failure as failure:
            print(f"part {part}, scene {scene}: {failure}", file=sys.stderr)
            failed += 1
        run.add(poses, truth)
    return {"part": part, "scenes": len(options.scenes), **run.figures()}, failed


def print_stages(rows):
    print("\nmedian ms of each stage\npart  " + "  ".join(f"{stage.lower():>12}" for stage in evaluation.STAGES))
    for row in rows:
        print(f"{row['part']:4d}  " + "  ".join(f"{row[stage + '_ms']:12.0f}" for stage in evaluation.STAGES))


def tohoku(options):
    """Part by part; returns how many scenes failed."""
    rows, failures = [], 0
    print("part  " + COLUMNS)
    for part in options.parts:
        row, failed = run_part(part, options)
        rows.append(row)
        failures += failed
        print(ROW.format(**row), flush=True)
    print_stages(rows)
    if options.out:
        with open(os.path.join(options.out, "tohoku.csv"), "w", newline="") as file:
            writer = csv.DictWriter(file, list(rows[0]))
            writer.writeheader()
            writer.writerows(rows)
    return failures


def find_objects(image, runs, camera):
    """The poses of each object in an image; says which objects fail and leaves them out."""
    found = {}
    for number, run in runs.items():
        try:
            found[number] = run.find(image.scan, None, image.beside, camera)
        except scripting.Failure as failure:
            print(f"scene {image.scene}, image {image.number}, object {number}: {failure}", file=sys.stderr)
    return found


def bop(options):
    """Image by image, all objects in each; returns how many of these failed."""
    scripting.require_folder_of(options.out)
    data = dataset.Dataset(options.folder, options.split)
    runs, benchmark = {}, {}
    for number in options.objects or data.objects():
        model = data.train(number, options.preset, options.features)
        runs[number] = evaluation.Evaluation(
            model, options.preset, options.poses, options.threads, options.references, options.features)
        benchmark[number] = dataset.BOPFigures(data.mesh(number), model)
    judged, failures = dict.fromkeys(runs, 0), 0
    with open(options.out, "w", encoding="utf-8", newline="") as file:
        results = dataset.Results(file)
        for scene in map(data.scene, options.scenes or data.scenes()):
            for step in scene.steps:
                try:
                    image = scene.image(step)
                except scripting.Failure as failure:
                    print(failure, file=sys.stderr)
                    failures += 1
                    continue
                found = find_objects(image, runs, data.beside())
                failures += len(runs) - len(found)
                results.add(image, found, options.poses)
                for number, run in runs.items():
                    truth = image.truth_of(number)
                    if truth.GetNumberOfPoints():  # an object that is not in an image is not judged
                        poses = found.get(number, vtkPolyData())
                        run.add(poses, truth)
                        try:
                            benchmark[number].add(poses, image, truth)
                        except scripting.Failure as failure:
                            print(f"scene {image.scene}, image {image.number}, object {number}: {failure}", file=sys.stderr)
                            failures += 1
                        judged[number] += 1
    rows = [{"part": number, "scenes": judged[number], **run.figures()} for number, run in runs.items() if judged[number]]
    if rows:
        print("obj.  " + COLUMNS)
        for row in rows:
            print(ROW.format(**row))
        print("\nobj.  recall of " + "  ".join(f"{name:>6}" for name in (*dataset.BOP_FIGURES, "AR")))
        for row in rows:
            print(f"{row['part']:4d}            " + "  ".join(f"{r:6.1f}" for r in benchmark[row["part"]].recalls().values()))
        print_stages(rows)
    return failures


def main():
    shared = argparse.ArgumentParser(add_help=False)
    shared.add_argument("folder", metavar="DIR", help="where the dataset is")
    shared.add_argument("--method", choices=("meam",), default="meam", help="(default: %(default)s)")
    shared.add_argument("--preset", choices=("paper", "recommended"), default="recommended",
                        help="parameters of all steps (default: %(default)s)")
    scripting.add_features_argument(shared)
    scripting.add_reference_argument(shared)
    shared.add_argument("--threads", type=scripting.count, default=0, help="threads to work with; 0: all cores (default)")
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    datasets = parser.add_subparsers(dest="dataset", required=True)

    one = datasets.add_parser("tohoku", parents=[shared])
    one.set_defaults(run=tohoku)
    one.add_argument("--parts", type=evaluation.numbers, default=[1, 2, 3], help="such as 1,3 (default: 1,2,3)")
    one.add_argument("--scenes", type=evaluation.numbers, default=list(range(20)), help="such as 0-4,7 (default: 0-19)")
    one.add_argument("--poses", type=scripting.count, default=5, help="poses wanted of a scene (default: %(default)s)")
    one.add_argument("--noise", type=evaluation.noise, default="0", help=evaluation.NOISE_HELP)
    one.add_argument("--out", metavar="OUTDIR",
                     help="write OUTDIR/Part_P/transI.txt, 4x4 matrices best first, and OUTDIR/tohoku.csv")

    one = datasets.add_parser("bop", parents=[shared])
    one.set_defaults(run=bop)
    one.add_argument("--split", default="test", help="folder of the scenes (default: %(default)s)")
    one.add_argument("--objects", type=evaluation.numbers, help="such as 1,5-7 (default: all in models/)")
    one.add_argument("--scenes", type=evaluation.numbers, help="such as 0-4,7 (default: all)")
    one.add_argument("--poses", type=scripting.count, default=5,
                     help="poses wanted of each object in an image; 0: all (default: %(default)s)")
    one.add_argument("--out", metavar="CSV", required=True, help="write the poses as BOP results")
    options = parser.parse_args()
    failures = options.run(options)
    if failures:
        raise scripting.Failure(f"{failures} failed, see above; where the true poses could be read nothing counts as found")


scripting.run(main)
