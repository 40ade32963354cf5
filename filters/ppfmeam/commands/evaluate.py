# SPDX-License-Identifier: BSD-3-Clause
"""Runs the method on scenes with true poses and prints how many it finds.

bop: a dataset in the form of the BOP benchmark, DIR/{models, test/SSSSSS}, such as `simulate` writes; without true
poses only the results are written.
A pose is right when a true one is within 10 % of the part's diameter and 5 degrees. Rates in %:
  paper   right poses / poses that came out (duplicates count)
  strict  right poses / poses asked for: each true instance counts once, a missing pose is wrong
  top1    scenes whose first pose is right
  recall, AP  (average precision) of all poses that come out, over instances that are at least half visible
  AP2-20  the benchmark's for industrial parts: AP at MSSD less than 2, 4, ..., 20 mm, over instances at least a tenth visible
  R@99    recall by the likeliest poses of all scenes, as long as 99 % of them are right
  ADD, ADI    recall at a tenth of the diameter, over instances that are at least a tenth visible, by as many poses
  MSSD, MSPD, VSD  of the benchmark: recall over its ten thresholds; AR is the mean of the three. These are of all poses
  that come out; the file holds --poses of each object
Times are the median over the scenes, without reading files and training.
"""
import argparse
import contextlib
import math
import os
import sys

from vtkmodules.vtkCommonDataModel import vtkPolyData

from .. import choices, dataset, evaluation, instances, scripting
from ..report import page
from ..report.judged import Images
from ..report.told import sentences

COLUMNS = ("scenes  poses   paper  strict    top1  recall      AP  AP2-20    R@99  median error: mm  degrees (axis  roll)  ms/scene")
ROW = ("{part:4d}  {scenes:6d}  {poses:5d}  {paper:6.1f}  {strict:6.1f}  {top1:6.1f}  {recall:6.1f}  {AP:6.1f}  {AP_mm:6.1f}  {recall_99:6.1f}"
       "  {mm:16.3f}  {deg:7.3f} ({axis_deg:.3f} {roll_deg:.3f})  {ms:8.0f}")


def evaluation_of(model, mesh, options, features):
    """What finds and judges poses of a part, as the options have it."""
    return evaluation.Evaluation(model, options.preset, options.poses, options.threads, options.references, features, mesh)


def instances_of(options):
    """What collects the rows of --why, or None."""
    if options.why and options.found:
        raise scripting.Failure("--why tells of our own search: leave --found out")
    scripting.require_folder_of(options.why)
    return instances.Instances(references=options.references, features=options.features, preset=options.preset,
                               threads=options.threads) if options.why else None


@contextlib.contextmanager
def told(where, failed):
    """Says what fails there, and adds it to those that failed."""
    try:
        yield
    except scripting.Failure as failure:
        print(f"{where}: {failure}", file=sys.stderr)
        failed.add(where)


def told_rates(rows, benchmark):
    """The tables of the rates, of the benchmark's and of the stages' times."""
    lines = ["obj.  " + COLUMNS, *(ROW.format(**row) for row in rows)]
    lines.append("\nobj.  recall of " + "  ".join(f"{name:>6}" for name in (*dataset.BOP_FIGURES, "AR")))
    lines += [f"{row['part']:4d}            " + "  ".join(f"{r:6.1f}" for r in benchmark[row["part"]].recalls().values()) for row in rows]
    if not all(math.isnan(row["ms"]) for row in rows):  # another program's poses have no times
        lines.append("\nmedian ms of each stage\nobj.  " + "  ".join(f"{stage.lower():>12}" for stage in evaluation.STAGES))
        lines += [f"{row['part']:4d}  " + "  ".join(f"{row[stage + '_ms']:12.0f}" for stage in evaluation.STAGES) for row in rows]
    return "\n".join(lines)


def place_of(image, number):
    """What messages call an object in an image."""
    return f"scene {image.scene}, image {image.number}, object {number}"


def find_objects(image, runs, camera, stored, failed):
    """The poses of each object in an image, or those stored; those that fail are left out and added to `failed`."""
    found = {}
    for number, run in runs.items():
        with told(place_of(image, number), failed):
            found[number] = stored.poses(image, number) if stored else run.find(image.scan, None, image.beside, camera)
    return found


def judge(image, found, runs, benchmark, camera, lost, failed):
    """Judges the poses of each object in an image, but for one that is not in it; those that fail are added to `failed`. Returns by
    the object's number its poses and, with `lost`, the Diagnosis of each copy that was missed, by its place."""
    edges, judged = None, {}
    for number, run in runs.items():
        truth, poses, where = image.truth_of(number), vtkPolyData(), place_of(image, number)
        if not truth.GetNumberOfPoints():
            continue
        with told(where, failed):
            edges = edges or evaluation.scene_edges(image.scan, image.beside, camera)
            evaluation.with_visibility(evaluation.half_visible(truth), run.model, edges, image.scan)
            poses = found.get(number, poses)
        with told(where, failed):
            benchmark[number].add(poses, truth, image.scan)
        run.add(poses, truth)
        judged[number] = poses, {}
        if lost and where not in failed:
            beside = {"image": image.beside, "image_camera": camera} if image.beside else {}
            with told(where, failed):
                place = {"part": number, "scene": image.scene, "image": image.number}
                judged[number] = poses, lost.add(place, run, poses, truth, image.scan, **beside)
    return judged


def show(images, image, judged, runs, camera, failed, options):
    """Adds an image to those of the page."""
    shown = {}
    for number, (poses, missed) in judged.items():
        truth = image.truth_of(number)
        shown[number] = poses, truth, runs[number].judged_image(poses, truth), {k: sentences(why) for k, why in missed.items()}
    notes = [f"object {number} failed" for number in runs if place_of(image, number) in failed] + ["no true poses"] * (not judged)
    images.add(f"{image.scene:06d}/{image.number:06d}", image, camera, shown, notes, options)


def bop(options):
    """Image by image, all objects in each; returns how many of these failed."""
    scripting.require_folder_of(options.out, options.json, options.report)
    page.require(options.report)
    lost = instances_of(options)
    data = dataset.Dataset(options.folder, options.split)
    objects = options.objects or data.objects()
    stored = options.found and dataset.Found(options.found, objects)
    runs, benchmark = {}, {}
    for number in objects:
        model, mesh = data.train(number, options.preset, options.features), data.mesh(number)
        runs[number] = evaluation_of(model, mesh, options, options.features)
        benchmark[number] = dataset.BOPFigures(mesh, model)
    judged, failed, scenes = dict.fromkeys(runs, 0), set(), options.scenes or data.scenes()
    images = Images({number: run.mesh for number, run in runs.items()},
                    sum(len(data.scene(scene).steps) for scene in scenes)) if options.report else None
    with scripting.written(options.out, newline="") if options.out else contextlib.nullcontext() as file:
        results = dataset.Results(file) if file else None
        for scene in map(data.scene, scenes):
            for step in scene.steps:
                try:
                    image = scene.image(step)
                except scripting.Failure as failure:
                    print(failure, file=sys.stderr)
                    failed.add((scene.folder, step))
                    if images:
                        images.add_failed(f"{os.path.basename(scene.folder)}, image {step + 1}", str(failure))
                    continue
                found = find_objects(image, runs, data.beside(), stored, failed)
                if results:
                    results.add(image, found, options.poses)
                judged_here = judge(image, found, runs, benchmark, data.beside(), lost, failed)
                if images:
                    show(images, image, judged_here, runs, data.beside(), failed, options)
                for number in runs:
                    judged[number] += image.truth_of(number).GetNumberOfPoints() > 0
    rows = [{"part": number, "scenes": judged[number], **run.figures()} for number, run in runs.items() if judged[number]]
    text = told_rates(rows, benchmark) if rows else ""
    if text:
        print(text)
    if images:
        page.write(options.report, images.html(os.path.basename(os.path.abspath(options.folder)), text))
    if options.json:
        objects = [{**row, **benchmark[row["part"]].recalls()} for row in rows]
        scripting.write_json(options.json, {"objects": objects, "failed": len(failed)})
    if lost:
        lost.write(options.why)
    return len(failed)


def main():
    parser = scripting.Parser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    one = parser.add_subparsers(dest="dataset", required=True).add_parser("bop")
    one.add_argument("folder", metavar="DIR", help="where the dataset is")
    one.add_argument("--why", metavar="CSV",
                     help="write a row for each true instance: the pose that found it, or the stage that lost it and why, which takes "
                          "another search of each scene that misses one")
    scripting.add_method_options(one)
    choices.add_options(one, "detect", "features", "references", "threads")
    one.add_argument("--split", default="test", help="folder of the scenes (default: %(default)s)")
    one.add_argument("--objects", type=evaluation.numbers, help="such as 1,5-7 (default: all in models/)")
    one.add_argument("--scenes", type=evaluation.numbers, help="such as 0-4,7 (default: all)")
    one.add_argument("--poses", type=scripting.count, default=5,
                     help="poses wanted of each object in an image; 0: all (default: %(default)s)")
    one.add_argument("--json", metavar="FILE", help="write the rates as JSON")
    one.add_argument("--report", metavar="HTML",
                     help="write a page for any browser, in one file: the rates, the images, and their scans in 3D with right and wrong poses "
                          "and the copies that were missed; with --why also why")
    result = one.add_mutually_exclusive_group()
    result.add_argument("--out", metavar="CSV", help="write the poses as BOP results")
    result.add_argument("--found", metavar="PATH",
                        help="judge the poses that another program left instead of looking for them: a file of BOP results, or a "
                             "folder with PATH/obj_OOOOOO/SSSSSS_IIIIII.txt, best first, 16 numbers each")
    failures = bop(parser.parse_args())
    if failures:
        raise scripting.Failure(f"{failures} failed, see above; where the search or the check of the true poses failed nothing counts as found")
